// See board_watch.h.
#include "client/triggers/board_watch.h"

#include <algorithm>
#include <type_traits>

#include "model/topics.h"

namespace roboss {
namespace {

/// The controller number `wanted` of those of a kind; nullptr: there is none.
const OnboardInfo* find_controller(const RobotType& type, int kind, int wanted) {
    for (const OnboardInfo& info : type.onboard)
        if (static_cast<int>(info.spec.kind().number) == kind && wanted-- == 0) return &info;
    return nullptr;
}

Pose pose_of(const Client& client, RobotId robot) {
    const RobotType& type = client.model().type_of(robot);
    return to_pose(robot_pose(type, base_pose(client.state(robot))));
}

/// A reading as the fields of a message, with Gazebo's names where they differ.
class MessageOfReading {
  public:
    explicit MessageOfReading(std::vector<BoardValue>& values) : values_(values) {}

    template <class Value>
    void operator()(const ReadingField& field, const Value& value) const {
        const std::string name = gazebos(field.name);
        if constexpr (std::is_arithmetic_v<Value>) {
            add(name, static_cast<double>(value));
        } else if constexpr (std::is_same_v<Value, Vec3>) {
            add(name + "_x", value.x), add(name + "_y", value.y), add(name + "_z", value.z);
        } else if constexpr (std::is_same_v<Value, Quat>) {
            add(name + "_w", value.w), add(name + "_x", value.x);
            add(name + "_y", value.y), add(name + "_z", value.z);
        }
    }

  private:
    static std::string gazebos(const std::string& name) {
        if (name == "reference") return "vertical_reference";
        if (name == "field") return "field_tesla";
        return name;
    }
    void add(std::string name, double value) const { values_.push_back({std::move(name), value}); }

    std::vector<BoardValue>& values_;
};

/// Whether there is something to say.
bool says_something(const Sample& sample) {
    const auto* contact = std::get_if<ContactReading>(&sample);
    return contact == nullptr || contact->count() > 0;
}

}  // namespace

BoardWatch::BoardWatch(const Model& model, RobotId board, const MessageBoardSpec& spec)
    : model_(&model), board_(board) {
    for (const BoardSupply& supply : spec.supplies) add_supply(supply);
    for (const BoardSensor& sensor : spec.sensors) add_sensor(sensor);
    for (const BoardReport& report : spec.reports) add_report(report);
    for (const BoardFollower& follower : spec.followers) add_follower(follower);
}

void BoardWatch::add_supply(const BoardSupply& supply) {
    const auto carrier = model_->find_robot(supply.carrier);
    if (!carrier) return;
    const OnboardInfo* info = find_controller(model_->type_of(*carrier),
                                              static_cast<int>(BreadcrumbsSpec::kKind.number), supply.supply);
    if (info == nullptr) return;
    const auto index = static_cast<std::size_t>(info->memory_index) + BreadcrumbsSpec::kCount;
    supplies_.push_back({&supply, {*carrier, index}, *carrier, {}});
    for (const BoardWord& crumb : supply.crumbs) supplies_.back().crumbs.push_back(parts_of(crumb.text));
}

/// The robots of a crumb; none: it was taken out of the world.
std::vector<BoardWatch::Part> BoardWatch::parts_of(const std::string& crumb) const {
    std::vector<Part> parts;
    const auto main = model_->find_robot(crumb);
    if (!main) return parts;
    const Pose X_CW = inverse(model_->robots[main->index()].X_WR);
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const Robot& robot = model_->robots[r];
        if (robot.name != crumb && !robot.name.starts_with(crumb + "::")) continue;
        const RobotType& type = model_->type_of(RobotId(r));
        const auto dropped = type.find_channel(CrumbSpec::kDropped);
        if (!dropped) continue;
        parts.push_back({RobotId(r), static_cast<std::uint32_t>(*dropped),
                         static_cast<std::size_t>(type.channels[*dropped].index), X_CW * robot.X_WR});
    }
    return parts;
}

void BoardWatch::add_sensor(const BoardSensor& sensor) {
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const std::string& name = model_->robots[r].name;
        // Parts of a model that no joint connects are robots "model::link".
        if (name != sensor.model && !name.starts_with(sensor.model + "::")) continue;
        const RobotType& type = model_->type_of(RobotId(r));
        for (std::size_t s = 0; s < type.sensors.size(); ++s)
            if (type.sensors[s].spec.name == sensor.sensor &&
                type.links[type.sensors[s].link.index()].name == sensor.link)
                sensors_.push_back({&sensor, RobotId(r), s});
    }
}

void BoardWatch::add_report(const BoardReport& report) {
    const auto robot = model_->find_robot(report.model);
    const auto told = model_->type_of(board_).find_channel(report.told);
    if (!robot || !told) return;
    const OnboardInfo* info = find_controller(model_->type_of(*robot), report.kind, report.controller);
    if (info == nullptr) return;
    const auto index = static_cast<std::size_t>(info->memory_index) + static_cast<std::size_t>(report.place);
    const ChannelInfo& channel = model_->type_of(board_).channels[*told];
    reports_.push_back({&report,
                        {*robot, index},
                        static_cast<std::size_t>(channel.index),
                        channel.channel.values.size() > 1});
}

void BoardWatch::add_follower(const BoardFollower& follower) {
    const auto actor = model_->find_robot(follower.actor);
    const auto target = model_->find_robot(follower.target);
    if (!actor || (!target && !follower.is_static)) return;
    const RobotType& type = model_->type_of(*actor);
    const auto channel = type.find_channel(FollowActorSpec::kTargetAt);
    if (!channel) return;
    followers_.push_back({*actor, static_cast<std::uint32_t>(*channel),
                          static_cast<std::size_t>(type.channels[*channel].index), &follower,
                          target.value_or(RobotId())});
}

void BoardWatch::read_sensors(Client& client, const Publish& publish) const {
    for (const Sensor& sensor : sensors_) {
        const auto read = [&](const auto& parameters) {
            using Kind = std::decay_t<decltype(parameters)>;
            if constexpr (requires { typename Kind::Reading; }) {
                const auto reading = client.reading<typename Kind::Reading>(sensor.robot, sensor.sensor);
                if (reading.tick != client.tick() || !says_something(Sample(reading))) return;
                std::vector<BoardValue> values;
                reading.fields(MessageOfReading(values), reading);
                publish(sensor.spec->topic, std::move(values));
            }
        };
        std::visit(read, model_->type_of(sensor.robot).sensors[sensor.sensor].spec.parameters);
    }
}

void BoardWatch::report(Client& client, const Tell& tell) const {
    for (const Report& report : reports_) {
        const double number = report.number.in(client);
        const std::vector<double>& board = client.state(board_).onboard;
        const bool is_told = board[report.told] >= 0 && board[report.told + 1] == number;
        if (number < 0 || is_told) continue;
        if (!report.with_pose) {
            tell(report.spec->told, {{"data", number}});
            continue;
        }
        const Pose X = pose_of(client, report.number.robot);
        tell(report.spec->told, {{"command_tick", number},
                                 {"position_x", X.p.x},
                                 {"position_y", X.p.y},
                                 {"position_z", X.p.z},
                                 {"orientation_w", X.q.w},
                                 {"orientation_x", X.q.x},
                                 {"orientation_y", X.q.y},
                                 {"orientation_z", X.q.z}});
    }
}

void BoardWatch::guide_actors(Client& client) const {
    for (const Follower& f : followers_) {
        const Pose X = f.target.valid() ? pose_of(client, f.target) : f.spec->X_WM;
        const std::vector<double>& known = client.state(f.actor).onboard;
        if (known[f.at] >= 0 && known[f.at + 1] == X.p.x && known[f.at + 2] == X.p.y) continue;
        (void)client.order(f.actor, Command{f.channel, {X.p.x, X.p.y}});
    }
}

void BoardWatch::drop_crumbs(Client& client, const Tell& tell) const {
    for (const Supply& supply : supplies_) {
        const auto is_dropped = [&](const std::vector<Part>& parts) {
            return parts.empty() || client.state(parts.front().robot).onboard[parts.front().at] >= 0;
        };
        const auto wanted = static_cast<std::size_t>(
            std::min(supply.count.in(client), static_cast<double>(supply.crumbs.size())));
        const Pose X_WM = supply.spec->is_static ? supply.spec->X_WM : pose_of(client, supply.carrier);
        bool any = false;
        for (std::size_t i = 0; i < wanted; ++i) {
            if (is_dropped(supply.crumbs[i])) continue;
            drop(client, supply.crumbs[i], X_WM * supply.spec->X_MC);
            any = true;
        }
        if (any)
            tell(supply.spec->told,
                 {{"data", static_cast<double>(supply.spec->limit) - static_cast<double>(wanted)}});
    }
}

void BoardWatch::drop(Client& client, const std::vector<Part>& crumb, const Pose& X_WC) const {
    for (const Part& part : crumb) {
        Pose X = X_WC * part.X_CP;
        X.q = normalized(X.q);
        (void)client.set_pose(part.robot, X);
        (void)client.order(part.robot, Command{part.dropped, {}});
    }
}

}  // namespace roboss
