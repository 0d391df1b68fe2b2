// What the message board of a world watches besides contacts and regions: supplies of breadcrumbs, sensors
// whose readings start triggers, what controllers report, and models that actors follow.
#include <algorithm>

#include "sdf/board_builder.h"

namespace roboss::sdf_import {
namespace {

/// Calls visit(spec, number among its kind) for each controller of this kind.
template <class Spec, class Visit>
void for_each_controller(const ModelSpec& model, Visit&& visit) {
    int number = 0;
    for (const OnboardSpec& onboard : model.onboard)
        if (const auto* spec = std::get_if<Spec>(&onboard.parameters)) visit(*spec, number++);
}

std::string reached_topic(const std::string& model) {
    return "/model/" + model + "/reached_pose";
}

/// Whether it needs nothing but the state of its robot, so that it may be read at every observation.
bool is_cheap(const SensorSpec& sensor) {
    return sensor.measures() && sensor.as<LaserSpec>() == nullptr && sensor.as<ForceTorqueSpec>() == nullptr;
}

}  // namespace

const ModelInstance* BoardBuilder::find_model(const std::string& name) const {
    const auto found = std::ranges::find(world_.instances, name, &ModelInstance::name);
    return found == world_.instances.end() ? nullptr : &*found;
}

bool BoardBuilder::has_input(const std::string& topic) const {
    return std::ranges::any_of(board_.triggers,
                               [&](const BoardTrigger& trigger) { return trigger.topic == topic; });
}

/// Topics at which the world's sensors and controllers publish.
void BoardBuilder::find_outputs() {
    for (const ModelInstance& instance : world_.instances) {
        const ModelSpec& model = world_.prototypes[instance.prototype];
        for (const LinkSpec& link : model.links)
            for (const SensorSpec& sensor : link.sensors)
                if (!sensor.topic.empty() && is_cheap(sensor))
                    outputs_.insert(with_model(absolute(sensor.topic), instance.name));
        for_each_controller<DriveToPoseSpec>(
            model, [&](const auto&, int) { outputs_.insert(reached_topic(instance.name)); });
    }
}

void BoardBuilder::add_supply(const CrumbSupply& supply) {
    const ModelInstance* carrier = find_model(supply.carrier);
    if (carrier == nullptr) return;
    BoardSupply added;
    added.carrier = supply.carrier, added.supply = supply.supply;
    added.X_MC = supply.X_MC, added.limit = supply.limit;
    added.is_static = world_.prototypes[carrier->prototype].is_static;
    added.X_WM = carrier->X_WM;
    for (const std::string& name : supply.names) added.crumbs.push_back({name});
    BoardTopic& told = add_topic(absolute(supply.topic) + "/remaining", supply.carrier);
    told.values.push_back({"data"});
    added.told = told.name;
    board_.supplies.push_back(std::move(added));
}

void BoardBuilder::add_report(const ModelInstance& model, const OnboardKind& kind, int controller, int place,
                              const std::string& topic, const std::vector<BoardValue>& values) {
    BoardTopic& told = add_topic(absolute(topic), model.name);
    told.values = values;
    board_.reports.push_back({model.name, static_cast<int>(kind.number), controller, place, told.name});
}

void BoardBuilder::add_elevators() {
    for (const ModelInstance& instance : world_.instances)
        for_each_controller<ElevatorSpec>(
            world_.prototypes[instance.prototype], [&](const ElevatorSpec& elevator, int number) {
                if (!elevator.fault().empty()) return;
                const Channel state = channel_of(elevator.state_topic, "state", {});
                add_report(instance, ElevatorSpec::kKind, number, ElevatorSpec::kFloor,
                           with_model(state.topic, instance.name), {{"data"}});
            });
}

std::vector<std::string> BoardBuilder::add_followers() {
    std::vector<std::string> faults;
    for (const ModelInstance& instance : world_.instances) {
        for_each_controller<FollowActorSpec>(
            world_.prototypes[instance.prototype], [&](const FollowActorSpec& follower, int) {
                const ModelInstance* target = find_model(follower.target);
                if (target == nullptr) {
                    faults.push_back("actor '" + instance.name + "' follows '" + follower.target +
                                     "', which is not in the world; it stands");
                    return;
                }
                board_.followers.push_back({instance.name, target->name,
                                            world_.prototypes[target->prototype].is_static, target->X_WM});
            });
    }
    return faults;
}

/// Those of which a trigger waits for messages.
void BoardBuilder::add_sensors() {
    for (const ModelInstance& instance : world_.instances) {
        for (const LinkSpec& link : world_.prototypes[instance.prototype].links) {
            for (const SensorSpec& sensor : link.sensors) {
                if (sensor.topic.empty() || !is_cheap(sensor)) continue;
                const std::string topic = with_model(absolute(sensor.topic), instance.name);
                if (has_input(topic))
                    board_.sensors.push_back(
                        {topic, instance.name, sensor.name, link.name, sensor.update_rate_hz});
            }
        }
    }
}

/// The drives that come to a pose of which a trigger wants to know.
void BoardBuilder::add_arrivals() {
    for (const ModelInstance& instance : world_.instances) {
        const std::string topic = reached_topic(instance.name);
        if (!has_input(topic)) continue;
        for_each_controller<DriveToPoseSpec>(
            world_.prototypes[instance.prototype], [&](const DriveToPoseSpec&, int number) {
                add_report(instance, DriveToPoseSpec::kKind, number, DriveToPoseSpec::kDone, topic,
                           {{"command_tick"},
                            {"position_x"},
                            {"position_y"},
                            {"position_z"},
                            {"orientation_w"},
                            {"orientation_x"},
                            {"orientation_y"},
                            {"orientation_z"}});
            });
    }
}

}  // namespace roboss::sdf_import
