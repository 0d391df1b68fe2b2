// Finds the sensor that a query names, and the function of its kind.
#include <algorithm>

#include "core/float_env.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/readings.h"

namespace roboss {

Transform sensor_pose(const SensorQuery& query) {
    return link_pose(query.type(), query.state, query.info().link) * to_transform(query.info().spec.X_LS);
}

Result<Sample> measure(const SensorQuery& query) {
    const Model& model = query.model;
    if (query.robot.index() >= model.robots.size())
        return Error{"there is no robot number " + std::to_string(query.robot.value),
                     "the world has " + std::to_string(model.robots.size()) + " robots, counted from 0"};
    const std::string robot = "robot '" + model.robots[query.robot.index()].name + "'";
    if (query.sensor >= query.type().sensors.size())
        return Error{robot + " has no sensor number " + std::to_string(query.sensor),
                     "it has " + std::to_string(query.type().sensors.size()) + ", counted from 0"};
    const SensorSpec& spec = query.info().spec;
    const ExactFloatScope exact;
    return std::visit(
        [&]<class Kind>(const Kind& parameters) -> Result<Sample> {
            if constexpr (requires { typename Kind::Reading; }) {
                auto reading = read(parameters, query);
                if (!reading) return reading.error();
                reading.value().tick = query.tick;
                return Sample(std::move(reading).value());
            } else {
                return Error{"sensor " + std::to_string(query.sensor) + " '" + spec.name + "' of " + robot +
                                 " is of a kind that measures nothing (" + spec.sdf_type + ")",
                             "`roboss check` lists the sensors that measure"};
            }
        },
        spec.parameters);
}

std::vector<Result<Sample>> measure_all(std::span<const SensorQuery> queries) {
    std::vector<Result<Sample>> samples(queries.size(), Result<Sample>(Sample{}));
    const auto measure_one = [&](std::size_t i) { samples[i] = measure(queries[i]); };
    const bool by_rays = std::ranges::all_of(queries, [](const SensorQuery& query) {
        return query.robot.index() < query.model.robots.size() &&
               query.sensor < query.type().sensors.size() && query.info().spec.kind().by_rays;
    });
    RayScene* const scene = by_rays && !queries.empty() ? &queries.front().sources.ray_scene() : nullptr;
    if (scene != nullptr)
        scene->share_out(queries.size(), measure_one);
    else
        for (std::size_t i = 0; i < queries.size(); ++i) measure_one(i);
    return samples;
}

}  // namespace roboss
