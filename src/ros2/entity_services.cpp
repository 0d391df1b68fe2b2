// See entity_services.h.
#include "ros2/entity_services.h"

#include <algorithm>
#include <array>

#include "ros2_types/messages/simulation_services_v1.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;
namespace v1 = simulation_interfaces_v1;

namespace {

constexpr std::size_t kLongestText = 10'000, kLongestTag = 200, kMostTags = 100;  // of notes about an entity

si::Result no_entity(const std::string& name) {
    return result_of(si::Result::kNotFound, "there is no entity '" + name.substr(0, 200) + "'");
}

Vec3 vec_of(const Vector3& v) {
    return {v.x, v.y, v.z};
}

bool is_zero(const Vector3& v) {
    return v.x == 0 && v.y == 0 && v.z == 0;
}

/// A request for one entity by its name: `serve(robot, response)` fills the response.
template <Service S, class Serve>
void add_for_entity(const SimulationContext& c, const char* name, Serve serve) {
    c.table.add<S>(c.name(name), [c, serve](const typename S::Request& request, const Reply<S>& reply) {
        typename S::Response response;
        response.result = fine();
        if (const auto robot = c.entities.find(request.entity))
            serve(request, *robot, response);
        else
            response.result = no_entity(request.entity);
        reply(response);
    });
}

void add_queries(const SimulationContext& c) {
    c.table.add<si::GetEntities>(c.name("get_entities"), [c](const si::GetEntities::Request& request,
                                                             const Reply<si::GetEntities>& reply) {
        si::GetEntities::Response response;
        std::vector<RobotId> found;
        response.result = c.entities.matching(request.filters, found);
        for (const RobotId robot : found) response.entities.push_back(c.entities.name(robot));
        reply(response);
    });
    c.table.add<si::GetEntitiesStates>(
        c.name("get_entities_states"),
        [c](const si::GetEntitiesStates::Request& request, const Reply<si::GetEntitiesStates>& reply) {
            si::GetEntitiesStates::Response response;
            std::vector<RobotId> found;
            response.result = c.entities.matching(request.filters, found);
            for (const RobotId robot : found) {
                response.entities.push_back(c.entities.name(robot));
                response.states.push_back(c.entities.state(robot));
            }
            reply(response);
        });
    add_for_entity<si::GetEntityState>(
        c, "get_entity_state", [c](const auto&, RobotId robot, si::GetEntityState::Response& response) {
            response.state = c.entities.state(robot);
        });
    add_for_entity<si::GetEntityBounds>(
        c, "get_entity_bounds", [c](const auto&, RobotId robot, si::GetEntityBounds::Response& response) {
            response.bounds = c.entities.bounds(robot);
        });
    add_for_entity<si::GetEntityInfo>(c, "get_entity_info",
                                      [c](const auto&, RobotId robot, si::GetEntityInfo::Response& response) {
                                          response.info = c.entities.info(robot);
                                      });
}

void set_info(const SimulationContext& c, const si::EntityInfo& info, RobotId robot, si::Result& result) {
    static constexpr std::array<std::uint8_t, 5> kCategories{
        si::EntityCategory::kObject, si::EntityCategory::kRobot, si::EntityCategory::kHuman,
        si::EntityCategory::kDynamicObject, si::EntityCategory::kStaticObject};
    const auto is_long = [](const std::string& tag) { return tag.size() > kLongestTag; };
    if (std::ranges::find(kCategories, info.category.category) == kCategories.end())
        result = result_of(si::Result::kOperationFailed, "there is no such category");
    else if (info.description.size() > kLongestText || info.tags.size() > kMostTags ||
             std::ranges::any_of(info.tags, is_long))
        result = result_of(si::Result::kOperationFailed, "the description or the tags are too long");
    else
        c.entities.set_info(robot, info);
}

/// Velocities of the SDF model frame, in the axes of a frame, as those of the base's origin in world axes.
Result<SetVelocity> velocity_of(const SimulationContext& c, RobotId robot, const si::EntityState& state) {
    const Result<Pose> X_WF = c.entities.frame(state.header.frame_id);
    if (!X_WF) return X_WF.error();
    const Quat& q = X_WF.value().q;
    const Vec3 angular = rotate(q, vec_of(state.twist.angular));
    const Vec3 arm = base_pose(c.run.states()[robot.index()]).p - c.entities.pose(robot).p;
    return SetVelocity{rotate(q, vec_of(state.twist.linear)) + cross(angular, arm), angular};
}

}  // namespace

si::Result set_entity_state(const SimulationContext& c, const si::SetEntityState::Request& wanted) {
    const auto robot = c.entities.find(wanted.entity);
    if (!robot) return no_entity(wanted.entity);
    const RobotType& type = c.run.model().type_of(*robot);
    const si::EntityState& state = wanted.state;
    const bool moves = !is_zero(state.twist.linear) || !is_zero(state.twist.angular);
    const bool speeds_up = !is_zero(state.acceleration.linear) || !is_zero(state.acceleration.angular);
    if (!type.free_base && ((wanted.set_twist && moves) || (wanted.set_acceleration && speeds_up)))
        return result_of(si::Result::kOperationFailed, "its base is fixed: it has no velocity");
    std::vector<Action> actions;
    if (wanted.set_pose) {
        const Result<Pose> X_WR = c.entities.pose_in_world(state.header.frame_id, state.pose);
        if (!X_WR) return result_of(si::SetEntityState::Response::kInvalidPose, X_WR.error().message);
        actions.push_back(SetPose{X_WR.value()});
    }
    if (wanted.set_twist && type.free_base) {
        const Result<SetVelocity> velocity = velocity_of(c, *robot, state);
        if (!velocity) return result_of(si::Result::kOperationFailed, velocity.error().message);
        actions.push_back(velocity.value());
    }
    for (const Action& action : actions)
        if (const Result<> given = c.run.order(*robot, action); !given)
            return result_of(si::Result::kOperationFailed, given.error().message);
    return fine();
}

void add_entity_services(const SimulationContext& c) {
    add_queries(c);
    c.table.add<si::SetEntityInfo>(c.name("set_entity_info"), [c](const si::SetEntityInfo::Request& request,
                                                                  const Reply<si::SetEntityInfo>& reply) {
        si::SetEntityInfo::Response response{fine()};
        if (const auto robot = c.entities.find(request.entity))
            set_info(c, request.info, *robot, response.result);
        else
            response.result = no_entity(request.entity);
        reply(response);
    });
    // 2.1 appended three flags; without them it is a request of 1.x, which sets everything.
    c.table.add_raw<si::SetEntityState>(
        c.name("set_entity_state"), c.type<v1::SetEntityState, si::SetEntityState>(),
        [c](const Incoming& call, const Reply<si::SetEntityState>& reply) {
            if (const auto request = from_cdr<si::SetEntityState::Request>(call.bytes))
                return reply({set_entity_state(c, request.value())});
            const auto older = from_cdr<v1::SetEntityState::Request>(call.bytes);
            if (!older) return c.table.notice("set_entity_state: " + older.error().message);
            reply({set_entity_state(c, {older.value().entity, older.value().state, true, true, false})});
        });
}

}  // namespace roboss::ros2
