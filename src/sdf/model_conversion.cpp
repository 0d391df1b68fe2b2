// Walks a model and its nested models.
#include "sdf/model_conversion.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "sdf/ignored_elements.h"
#include "sdf/joint_conversion.h"
#include "sdf/libsdformat_reader.h"
#include "sdf/look_conversion.h"
#include "sdf/newer_versions.h"
#include "sdf/plugin_sensors.h"

namespace roboss::sdf_import {
namespace {

/// A model or nested model on the way: where it is in the outermost model.
struct Scope {
    const sdf::Model& model;
    std::string prefix;  // "" or "inner::"
    Pose X_MS;           // this model's frame in the outermost model's
    bool wind = false;   // <enable_wind> of the model: for links that do not say otherwise
};

Pose to_pose(const ignition::math::Pose3d& pose) {
    return {{pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z()},
            {pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()}};
}

template <class Posed>
Pose resolved(const Posed& posed, const std::string& in) {
    ignition::math::Pose3d pose;
    // Errors of the frame graph were reported when libsdformat built it.
    if (!posed.SemanticPose().Resolve(pose, in).empty()) return {};
    return to_pose(pose);
}

class ModelConverter {
  public:
    ModelConverter(const ReadModel& read, const Import& import, ModelSpec& spec)
        : read_(read), import_(import), spec_(spec) {}

    void convert(const Scope& scope) {
        const Element source = read_.source_of(scope.model.Element());
        std::vector<PluginSensor> sensors;
        if (source) convert_extensions(source, scope.prefix, import_, spec_, sensors);
        for (std::uint64_t i = 0; i < scope.model.LinkCount(); ++i)
            convert_link(*scope.model.LinkByIndex(i), scope);
        for (std::uint64_t i = 0; i < scope.model.JointCount(); ++i)
            convert_joint_of(*scope.model.JointByIndex(i), scope);
        for (std::uint64_t i = 0; i < scope.model.ModelCount(); ++i)
            convert_nested(*scope.model.ModelByIndex(i), scope);
        for (std::uint64_t i = 0; i < scope.model.FrameCount(); ++i)
            convert_frame(*scope.model.FrameByIndex(i), scope);
        if (scope.prefix.empty()) find_joints_of_sensors();
        const std::string canonical = scope.prefix + scope.model.CanonicalLinkAndRelativeName().second;
        for (PluginSensor& sensor : sensors)
            attach_plugin_sensor(std::move(sensor), canonical, scope.X_MS, import_, spec_);
        if (source) label_visuals(source, scope.prefix);
    }

    /// A Label plugin of a model labels the visuals that have no label of their own; a nested model's comes
    /// before that of the model around it.
    void label_visuals(const Element& model, const std::string& prefix) {
        for (const auto node : model.node.children("plugin")) {
            const Element plugin{model.source, node};
            if (!is_named(plugin_name(plugin), "Label", "label-system")) continue;
            const int label = read_label(plugin, import_);
            for (LinkSpec& link : spec_.links)
                for (VisualSpec& visual : link.visuals)
                    if (visual.label == 0 && link.name.starts_with(prefix))
                        visual.label = label, visual.labels_model = label != 0;
        }
    }

    /// Links of nested static models do not move: with no others the model is static, else they are welded to
    /// the world.
    void fix_static_links() {
        if (static_.empty() || spec_.is_static) return;
        spec_.is_static = static_.size() == spec_.links.size();
        if (spec_.is_static) return;
        std::erase_if(spec_.joints, [&](const JointSpec& joint) {
            return static_.count(joint.child) > 0 &&
                   (joint.parent == "world" || static_.count(joint.parent) > 0);
        });
        for (const LinkSpec& link : spec_.links) {
            if (static_.count(link.name) > 0) weld(link);
        }
        import_.diagnostics().note(spec_.where, "nested-static",
                                   "model '" + spec_.name +
                                       "' has nested static models: " + std::to_string(static_.size()) +
                                       " of its links are welded to the world");
    }

    /// A heightmap stands still in Gazebo, whatever its model says.
    void fix_terrain() {
        if (spec_.is_static || spec_.kinematic || spec_.links.size() != 1) return;
        const auto is_heightmap = [](const CollisionSpec& collision) {
            return collision.geometry.kind == GeometryKind::kHeightmap;
        };
        if (std::ranges::none_of(spec_.links[0].collisions, is_heightmap)) return;
        spec_.is_static = true;
        spec_.joints.clear();
        import_.diagnostics().warning(
            spec_.where, "movable-heightmap",
            "model '" + spec_.name + "' is a heightmap and not static: it stands still",
            "Write <static>true</static> in the model.");
    }

    /// Links of a kinematic model hang on its base.
    void fix_kinematic_links() {
        if (kinematic_links_ > 0) judge_kinematic_links();
        if (!spec_.kinematic) return;
        spec_.joints.clear();
        for (const LinkSpec& link : spec_.links) weld(link);
    }

  private:
    /// A model is kinematic as a whole, or not at all.
    void judge_kinematic_links() {
        if (spec_.is_static || spec_.kinematic) return;
        spec_.kinematic = kinematic_links_ == spec_.links.size();
        if (spec_.kinematic)
            import_.diagnostics().note(
                spec_.where, "kinematic",
                "model '" + spec_.name +
                    "' is kinematic: one rigid body that nothing pushes and that pushes "
                    "what it meets",
                "Move it with a VelocityControl plugin or by its pose.");
        else
            import_.diagnostics().warning(spec_.where, "kinematic",
                                          "model '" + spec_.name + "' has " +
                                              std::to_string(kinematic_links_) + " kinematic links of " +
                                              std::to_string(spec_.links.size()) +
                                              "; they are simulated as dynamic links",
                                          "Make all of its links kinematic, or none.");
    }

    /// To the world.
    void weld(const LinkSpec& link) {
        JointSpec weld;
        weld.name = link.name + "::static";
        weld.parent = "world";
        weld.child = link.name;
        weld.X_MJ = link.X_ML;
        weld.where = link.where;
        spec_.joints.push_back(std::move(weld));
    }

    void convert_frame(const sdf::Frame& frame, const Scope& scope) {
        std::string body;
        if (!frame.ResolveAttachedToBody(body).empty()) return;
        const auto link = std::ranges::find(spec_.links, scope.prefix + body, &LinkSpec::name);
        if (link == spec_.links.end()) return;
        const Pose X_MF = scope.X_MS * resolved(frame, "__model__");
        spec_.frames.push_back({scope.prefix + frame.Name(), link->name, inverse(link->X_ML) * X_MF});
    }

    void convert_nested(const sdf::Model& nested, const Scope& outer) {
        const Element source = read_.source_of(nested.Element());
        const std::size_t first = spec_.links.size();
        convert({nested, outer.prefix + nested.Name() + "::", outer.X_MS * resolved(nested, "__model__"),
                 import_.reader.boolean(source, "enable_wind", outer.wind)});
        if (nested.Static())
            for (std::size_t l = first; l < spec_.links.size(); ++l) static_.insert(spec_.links[l].name);
        report_nested_flags(source);
    }

    /// Flags that only the outermost model has.
    void report_nested_flags(const Element& nested) {
        const auto report = [&](const char* flag, bool counts) {
            if (import_.reader.boolean(nested, flag, counts) == counts) return;
            import_.diagnostics().warning(nested.child(flag).where(), "nested-flag",
                                          "<" + std::string(flag) + "> of the nested model '" +
                                              nested.name() + "' is ignored: the outermost model's counts",
                                          "Write it in the outermost model.");
        };
        report("self_collide", spec_.self_collide);
        report("allow_auto_disable", spec_.may_sleep);
    }

    void convert_link(const sdf::Link& link, const Scope& scope) {
        const Element source = read_.source_of(link.Element());
        LinkSpec spec;
        spec.name = scope.prefix + link.Name();
        spec.where = source.where();
        spec.X_ML = scope.X_MS * resolved(link, "__model__");
        if (!source) {
            import_.diagnostics().warning(
                read_.source().where(), "lost-link",
                "link '" + spec.name + "' cannot be found again in the file; it has no shapes");
            spec_.links.push_back(std::move(spec));
            return;
        }
        const auto collision_pose = [&](const Element& collision) {
            return pose_of(collision, link.CollisionByName(name_among_siblings(collision)), link);
        };
        if (!spec_.is_static && !spec_.kinematic) convert_inertial(source, collision_pose, import_, spec);
        convert_link_flags(source, spec);
        convert_drag(source, scope.wind, import_, spec);
        for (const auto node : source.node.children()) {
            if (node.type() == pugi::node_element) convert_part({source.source, node}, link, scope, spec);
        }
        convert_retro(source, spec);
        spec_.links.push_back(std::move(spec));
    }

    /// What beams read of the link's visuals, which gz-sim's lidars see: of the one of the same name, or else
    /// of the first that says so. A collision's own <laser_retro> (of Gazebo Classic) comes first.
    void convert_retro(const Element& link, LinkSpec& spec) {
        std::optional<double> first;
        std::map<std::string, double> by_name;
        for (const auto node : link.node.children("visual")) {
            const Element visual{link.source, node};
            if (!visual.child("laser_retro")) continue;
            const double retro = import_.reader.number(visual, "laser_retro", 0);
            first = first.value_or(retro);
            by_name.emplace(visual.name(), retro);
        }
        if (!first) return;
        for (CollisionSpec& collision : spec.collisions) {
            const auto own = by_name.find(collision.name);
            if (collision.laser_retro == 0)
                collision.laser_retro = own != by_name.end() ? own->second : *first;
        }
    }

    void convert_link_flags(const Element& source, LinkSpec& spec) {
        spec.gravity = import_.reader.boolean(source, "gravity", true);
        if (import_.reader.boolean(source, "self_collide", false)) collide_with_itself(source);
        if (import_.reader.boolean(source, "kinematic", false)) ++kinematic_links_;
    }

    /// Told once a model.
    void collide_with_itself(const Element& link) {
        if (spec_.self_collide || spec_.is_static) return;
        spec_.self_collide = true;
        import_.diagnostics().note(link.child("self_collide").where(), "self-collide",
                                   "link '" + link.name() +
                                       "' asks for <self_collide>: all links of model '" + spec_.name +
                                       "' collide with each other",
                                   "Write <self_collide> in the model, or leave it out.");
    }

    /// A <collision>, <visual>, <light> or sensor of a link.
    void convert_part(const Element& part, const sdf::Link& link, const Scope& scope, LinkSpec& spec) {
        const char* tag = part.node.name();
        const std::string name = name_among_siblings(part);
        if (std::strcmp(tag, "collision") == 0) {
            report_repeated(part, name);
            const auto* known = link.CollisionByName(name);
            if (auto collision = convert_collision(part, pose_of(part, known, link), import_)) {
                spec.collisions.push_back(std::move(*collision));
            }
        } else if (std::strcmp(tag, "visual") == 0) {
            for (VisualSpec& visual :
                 convert_visual(part, pose_of(part, link.VisualByName(name), link), import_))
                spec.visuals.push_back(std::move(visual));
        } else if (std::strcmp(tag, "light") == 0) {
            if (auto light = convert_light(part, pose_of(part, link.LightByName(name), link), import_))
                spec.lights.push_back(std::move(*light));
        } else if (std::strcmp(tag, "sensor") == 0 || std::strcmp(tag, "roboss:sensor") == 0 ||
                   std::strcmp(tag, "roboss:radio") == 0) {
            const Pose X_LS = pose_of(part, link.SensorByName(name), link);
            std::vector<SensorSpec> cameras = convert_multicamera(part, X_LS, scope.prefix, import_);
            if (cameras.empty()) cameras.push_back(convert_sensor(part, X_LS, scope.prefix, import_));
            std::ranges::move(cameras, std::back_inserter(spec.sensors));
        }
    }

    void report_repeated(const Element& collision, const std::string& other) {
        if (other == collision.name()) return;
        import_.diagnostics().warning(
            collision.where(), "repeated-name",
            "a link has several collisions named '" + collision.name() + "': all of them count",
            "Give each a name of its own.");
    }

    /// Ours to read unless it is relative to another frame; then libsdformat knows.
    template <class Posed>
    Pose pose_of(const Element& part, const Posed* known, const sdf::Link& link) {
        const Element pose = part.child("pose");
        if (relative_to(pose).empty()) return import_.reader.pose(pose);
        import_.reader.pose(pose);
        if (known == nullptr) return {};
        return resolved(*known, link.Name());
    }

    void convert_joint_of(const sdf::Joint& joint, const Scope& scope) {
        Element source = read_.source_of(joint.Element());
        if (!source) source = read_.source();
        auto spec =
            convert_joint(joint, source, scope.X_MS * resolved(joint, "__model__"), scope.prefix, import_);
        if (!spec) return;
        if (source.node.attribute(kJointName)) spec_.shared_names = true;
        for (const auto node : source.node.children("sensor"))
            convert_joint_sensor({source.source, node}, *spec, scope);
        spec_.joints.push_back(std::move(*spec));
    }

    /// A force-torque sensor in a <link> measures the joint that holds the link.
    void find_joints_of_sensors() {
        for (LinkSpec& link : spec_.links) {
            const auto holds = [&](const JointSpec& joint) { return joint.child == link.name; };
            for (SensorSpec& sensor : link.sensors) {
                auto* force_torque = sensor.as<ForceTorqueSpec>();
                if (force_torque == nullptr || !force_torque->joint.empty()) continue;
                const auto joint = std::ranges::find_if(spec_.joints, holds);
                if (joint != spec_.joints.end()) {
                    force_torque->joint = joint->name;
                    continue;
                }
                import_.diagnostics().warning(sensor.where, "joint-sensor",
                                              "force-torque sensor '" + sensor.name + "' is in link '" +
                                                  link.name + "', which no joint holds; it measures nothing",
                                              "Put it in the <joint> that it measures.");
                sensor.parameters = UnsupportedSensor{};
            }
        }
    }

    /// A force-torque sensor: it stands on the joint's child link.
    void convert_joint_sensor(const Element& element, const JointSpec& joint, const Scope& scope) {
        const auto child = std::ranges::find(spec_.links, joint.child, &LinkSpec::name);
        if (child == spec_.links.end()) return;
        const Pose X_MS = joint.X_MJ * import_.reader.pose(element.child("pose"));
        SensorSpec sensor = convert_sensor(element, inverse(child->X_ML) * X_MS, scope.prefix, import_);
        if (auto* force_torque = sensor.as<ForceTorqueSpec>()) {
            force_torque->joint = joint.name;
            child->sensors.push_back(std::move(sensor));
        } else if (sensor.measures()) {
            import_.diagnostics().warning(
                element.where(), "joint-sensor",
                "sensors of type '" + sensor.sdf_type + "' in a <joint> are not read",
                "Put the sensor in a <link>.");
        }
    }

    const ReadModel& read_;
    const Import& import_;
    ModelSpec& spec_;
    std::size_t kinematic_links_ = 0;
    std::set<std::string> static_;  // links of nested static models
};

}  // namespace

ModelSpec convert_model(const ReadModel& read, bool is_static, const Import& import) {
    ModelSpec spec;
    const Element source = read.source();
    spec.name = source.name();
    spec.where = source.where();
    spec.is_static = is_static;
    spec.self_collide = import.reader.boolean(source, "self_collide", false);
    spec.may_sleep = import.reader.boolean(source, "allow_auto_disable", true);
    spec.canonical_link = read.model().CanonicalLinkAndRelativeName().second;
    report_newer_elements(source, import.diagnostics());
    report_ignored_elements(source, import.diagnostics());
    ModelConverter converter(read, import, spec);
    converter.convert({read.model(), "", {}, import.reader.boolean(source, "enable_wind", false)});
    converter.fix_static_links();
    converter.fix_kinematic_links();
    converter.fix_terrain();
    return spec;
}

std::optional<Pose> pose_in_model(const ReadModel& read, const std::string& scoped_name) {
    const sdf::Model* model = &read.model();
    std::string rest = scoped_name;
    Pose X_MS;
    for (std::size_t at = rest.find("::"); at != std::string::npos; at = rest.find("::")) {
        model = model->ModelByName(rest.substr(0, at));
        if (model == nullptr) return std::nullopt;
        X_MS = X_MS * resolved(*model, "__model__");
        rest = rest.substr(at + 2);
    }
    if (rest == "__model__") return X_MS;
    if (const auto* link = model->LinkByName(rest)) return X_MS * resolved(*link, "__model__");
    if (const auto* frame = model->FrameByName(rest)) return X_MS * resolved(*frame, "__model__");
    if (const auto* joint = model->JointByName(rest)) return X_MS * resolved(*joint, "__model__");
    if (const auto* nested = model->ModelByName(rest)) return X_MS * resolved(*nested, "__model__");
    return std::nullopt;
}

}  // namespace roboss::sdf_import
