// See controllers_file.h.
#include "ros2/controllers_file.h"

#include <array>
#include <cmath>
#include <optional>

#include "ros2/controller_parameters.h"
#include "ros2/drive_parameters.h"
#include "ros2/robot_names.h"
#include "ros2/yaml_file.h"

namespace roboss::ros2 {

namespace {

using EntryKind = ControllerEntry::Kind;

constexpr std::size_t kNodesMost = 100'000, kControllersMost = 1'000;
constexpr std::size_t kJointsMost = 10'000;  // of all controllers
constexpr std::size_t kNameMost = 200;       // characters: an alias makes many of one
constexpr int kDepthMost = 10;
constexpr const char* kManager = "controller_manager";

struct KnownType {
    const char* type;
    EntryKind kind;
    std::optional<MotorMode> mode;  ///< none: the parameter interface_name says it
};
constexpr std::array kTypes{
    KnownType{"joint_trajectory_controller/JointTrajectoryController", EntryKind::kTrajectory,
              MotorMode::kPosition},
    KnownType{"position_controllers/JointGroupPositionController", EntryKind::kSetpoints,
              MotorMode::kPosition},
    KnownType{"velocity_controllers/JointGroupVelocityController", EntryKind::kSetpoints,
              MotorMode::kVelocity},
    KnownType{"effort_controllers/JointGroupEffortController", EntryKind::kSetpoints, MotorMode::kEffort},
    KnownType{"forward_command_controller/ForwardCommandController", EntryKind::kSetpoints, std::nullopt},
    KnownType{"position_controllers/GripperActionController", EntryKind::kGripper, MotorMode::kPosition},
    KnownType{"effort_controllers/GripperActionController", EntryKind::kGripper, MotorMode::kPosition},
    KnownType{"parallel_gripper_action_controller/GripperActionController", EntryKind::kParallelGripper,
              MotorMode::kPosition}};

/// The parameters of a node.
struct Parameters {
    std::string name, space;  // "arm_controller", "left"; a space of wildcards is empty
    YAML::Node values;
};

/// Divides "/left/arm_controller" into its space and its name.
Parameters at_path(const std::string& path, const YAML::Node& values) {
    const std::size_t slash = path.rfind('/');
    std::string space = slash == std::string::npos ? "" : path.substr(0, slash);
    while (space.starts_with('/')) space.erase(0, 1);
    if (space.find('*') != std::string::npos) space.clear();
    return {path.substr(slash == std::string::npos ? 0 : slash + 1), space, values};
}

/// The text of a file with YAML.
class ControllersReader {
  public:
    explicit ControllersReader(std::string file) { controllers_.file = std::move(file); }

    Result<Controllers> read(const YAML::Node& all) {
        if (const Result<> found = collect(all, "", 0); !found) return found.error();
        bool has_manager = false;
        for (const Parameters& node : nodes_) {
            if (node.name != kManager || !node.values.IsMap()) continue;
            has_manager = true;
            for (const auto& pair : node.values)
                if (const Result<> added = add(node.space, pair.first, pair.second); !added)
                    return added.error();
        }
        if (!has_manager)
            return bad(controllers_.file + ": ", "it has no parameters of a controller_manager",
                       "give the file that ros2_control is started with, as in 'controller_manager: "
                       "{ros__parameters: {arm: {type: ...}}}'");
        return std::move(controllers_);
    }

  private:
    static Error bad(const std::string& where, const std::string& what, const std::string& remedy) {
        return {where + what, remedy, "bad-controllers"};
    }
    std::string where(const YAML::Node& node) const {
        return at_line(controllers_.file, node.Mark().line + 1);
    }

    /// Finds the nodes that have parameters.
    Result<> collect(const YAML::Node& map, const std::string& path, int depth) {
        if (!map.IsMap() || depth > kDepthMost) return Ok{};
        for (const auto& pair : map) {
            if (++looked_at_ > kNodesMost)
                return bad(controllers_.file + ": ", "it is too large", "leave out what is no controller");
            const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
            if (key == "ros__parameters")
                nodes_.push_back(at_path(path, pair.second));
            else if (const Result<> found =
                         collect(pair.second, path.empty() ? key : path + "/" + key, depth + 1);
                     !found)
                return found.error();
        }
        return Ok{};
    }

    /// A parameter of a controller manager: a controller, or something else.
    Result<> add(const std::string& space, const YAML::Node& key, const YAML::Node& value) {
        if (!key.IsScalar() || !value.IsMap() || !value["type"]) return Ok{};
        if (!value["type"].IsScalar())
            return bad(where(key), "the type of '" + key.Scalar() + "' is no text", "correct it");
        if (controllers_.entries.size() == kControllersMost)
            return bad(where(key), "there are more than " + std::to_string(kControllersMost) + " controllers",
                       "divide the file");
        ControllerEntry entry;
        entry.name = key.Scalar(), entry.space = space, entry.line = key.Mark().line + 1;
        if (const std::string problem = problem_of_name("/" + entry.name); !problem.empty())
            return bad(where(key), "the name '" + entry.name.substr(0, 100) + "' " + problem,
                       "give another one");
        return set_type(value["type"], entry);
    }

    Result<> set_type(const YAML::Node& type, ControllerEntry& entry) {
        const std::string& name = type.Scalar();
        if (name.ends_with("Broadcaster")) return Ok{};  // its topics are there without it
        for (const KnownType& known : kTypes) {
            if (name != known.type) continue;
            entry.kind = known.kind;
            return set_parameters(type, known.mode, entry);
        }
        if (const DriveReader read_drive = drive_reader(name)) return set_drive(type, read_drive, entry);
        notice(where(type) + "the controller '" + entry.name + "' has no effect: a " + name.substr(0, 100) +
               " is not known here; plugins in the world file can drive wheels [controller-type]");
        return Ok{};
    }

    void notice(std::string line) {
        if (controllers_.notices.size() < kControllersMost) controllers_.notices.push_back(std::move(line));
    }

    /// The parameters of the controller's own node; null: it has none.
    const Parameters* find_parameters(const ControllerEntry& entry) const {
        const Parameters* own = nullptr;
        for (const Parameters& node : nodes_)
            if (node.name == entry.name && (node.space == entry.space || node.space.empty())) own = &node;
        return own == nullptr || !own->values.IsMap() ? nullptr : own;
    }
    Error no_parameters(const YAML::Node& type, const ControllerEntry& entry, const char* parameters) const {
        return bad(where(type), "the controller '" + entry.name + "' has no parameters",
                   "add '" + entry.name + ": {ros__parameters: {" + parameters + "}}'");
    }

    Result<> set_drive(const YAML::Node& type, DriveReader read_drive, ControllerEntry& entry) {
        const Parameters* own = find_parameters(entry);
        if (own == nullptr) return no_parameters(type, entry, "wheel_radius: ..., ...");
        ControllerParameters parameters(controllers_.file, entry.name, own->values);
        const auto drive = std::make_shared<const DriveController>(read_drive(parameters));
        if (!parameters.refusal().empty()) return notice(parameters.refusal()), Ok{};
        if (parameters.error()) return *parameters.error();
        for (std::string& line : parameters.take_notices()) notice(std::move(line));
        entry.kind = EntryKind::kDrive, entry.mode = MotorMode::kVelocity;
        entry.joints = joints_named(drive->parameters), entry.drive = drive;
        controllers_.entries.push_back(std::move(entry));
        return Ok{};
    }

    Result<> set_parameters(const YAML::Node& type, std::optional<MotorMode> mode, ControllerEntry& entry) {
        const Parameters* own = find_parameters(entry);
        if (own == nullptr) return no_parameters(type, entry, "joints: [...]");
        if (const Result<> read = set_joints(own->values, entry); !read) return read.error();
        if (!mode) {
            const Result<MotorMode> said = interface_of(own->values, entry);
            if (!said) return said.error();
            mode = said.value();
        }
        entry.mode = *mode;
        if (const Result<> read = set_gripper(own->values, entry); !read) return read.error();
        controllers_.entries.push_back(std::move(entry));
        return Ok{};
    }

    Result<> set_joints(const YAML::Node& values, ControllerEntry& entry) {
        const bool is_gripper =
            entry.kind == EntryKind::kGripper || entry.kind == EntryKind::kParallelGripper;
        const char* key = is_gripper ? "joint" : "joints";
        const YAML::Node joints = values[key];
        const Error missing =
            bad(where(values), "'" + entry.name + "' names no " + key,
                "write '" + std::string(key) + ": " + (is_gripper ? "NAME'" : "[NAME, ...]'"));
        if (!joints) return missing;
        const auto add_joint = [&](const YAML::Node& joint) {
            const bool fits = joint.IsScalar() && joint.Scalar().size() <= kNameMost;
            if (fits) entry.joints.push_back(joint.Scalar());
            return fits;
        };
        if (is_gripper) return add_joint(joints) ? Result<>(Ok{}) : Result<>(missing);
        if (!joints.IsSequence() || joints.size() == 0) return missing;
        if (joint_count_ + joints.size() > kJointsMost)
            return bad(where(joints), "the controllers have more than 10000 joints", "divide the file");
        joint_count_ += joints.size();
        for (const YAML::Node& joint : joints)
            if (!add_joint(joint)) return missing;
        return Ok{};
    }

    Result<MotorMode> interface_of(const YAML::Node& values, const ControllerEntry& entry) const {
        const YAML::Node interface = values["interface_name"];
        const std::string name = interface && interface.IsScalar() ? interface.Scalar() : "";
        if (name == "position") return MotorMode::kPosition;
        if (name == "velocity") return MotorMode::kVelocity;
        if (name == "effort") return MotorMode::kEffort;
        return bad(where(interface ? interface : values),
                   "the interface of '" + entry.name + "' is '" + name.substr(0, 100) + "'",
                   "write 'interface_name: position', velocity or effort");
    }

    Result<> set_gripper(const YAML::Node& values, ControllerEntry& entry) const {
        for (const auto& [key, number] : {std::pair{"goal_tolerance", &entry.goal_tolerance},
                                          {"stall_velocity_threshold", &entry.stall_velocity},
                                          {"stall_timeout", &entry.stall_timeout_s}}) {
            const YAML::Node given = values[key];
            if (given && (!YAML::convert<double>::decode(given, *number) || !(*number >= 0) ||
                          !std::isfinite(*number)))
                return bad(where(given), std::string(key) + " is no number from 0 on", "correct it");
        }
        const YAML::Node allow = values["allow_stalling"];
        if (allow && !YAML::convert<bool>::decode(allow, entry.allow_stalling))
            return bad(where(allow), "allow_stalling is neither true nor false", "correct it");
        return Ok{};
    }

    Controllers controllers_;
    std::vector<Parameters> nodes_;
    std::size_t looked_at_ = 0, joint_count_ = 0;
};

}  // namespace

Result<Controllers> parse_controllers(const std::string& file, const std::string& text) {
    return parse_yaml(file, text, "bad-controllers",
                      [&](const YAML::Node& all) { return ControllersReader(file).read(all); });
}

Result<Controllers> read_controllers(const std::filesystem::path& file) {
    const Result<std::string> text =
        read_yaml_text(file, "bad-controllers", "give the YAML file of ros2_control's controllers");
    return text ? parse_controllers(file.string(), text.value()) : Result<Controllers>(text.error());
}

}  // namespace roboss::ros2
