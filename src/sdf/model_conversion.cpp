// Walks a model and its nested models.
#include "sdf/model_conversion.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "sdf/joint_conversion.h"
#include "sdf/look_conversion.h"
#include "sdf/model_tree.h"
#include "sdf/plugin_sensors.h"

namespace roboss::sdf_import {
namespace {

using Kind = TreePart::Kind;

/// A model or nested model on the way: where it is in the outermost model.
struct Scope {
    const ModelTree& model;
    std::string prefix;  // "" or "inner::"
    Pose X_MS;           // this model's frame in the outermost model's
    bool wind = false;   // <enable_wind> of the model: for links that do not say otherwise
};

class ModelConverter {
  public:
    ModelConverter(const Import& import, ModelSpec& spec) : import_(import), spec_(spec) {}

    void convert(const Scope& scope) {
        std::vector<std::pair<Element, Pose>> sources{{scope.model.source, {}}};
        sources.insert(sources.end(), scope.model.merged.begin(), scope.model.merged.end());
        std::vector<std::pair<PluginSensor, Pose>> sensors;
        for (const auto& [source, X_SN] : sources) {
            std::vector<PluginSensor> found;
            convert_extensions(source, scope.prefix, import_, spec_, found);
            for (PluginSensor& sensor : found) sensors.emplace_back(std::move(sensor), scope.X_MS * X_SN);
        }
        convert_each(Kind::kLink, &ModelConverter::convert_link, scope);
        convert_each(Kind::kJoint, &ModelConverter::convert_joint_of, scope);
        convert_each(Kind::kModel, &ModelConverter::convert_nested, scope);
        convert_each(Kind::kFrame, &ModelConverter::convert_frame, scope);
        if (scope.prefix.empty()) find_joints_of_sensors();
        const std::string canonical = scope.prefix + scope.model.canonical_link;
        for (auto& [sensor, X_MN] : sensors)
            attach_plugin_sensor(std::move(sensor), canonical, X_MN, import_, spec_);
        for (const auto& [source, X_SN] : sources) label_visuals(source, scope.prefix);
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

    void convert_each(Kind kind, void (ModelConverter::*convert_it)(const TreePart&, const Scope&),
                      const Scope& scope) {
        for (const TreePart& part : scope.model.parts)
            if (part.kind == kind) (this->*convert_it)(part, scope);
    }

    void convert_frame(const TreePart& frame, const Scope& scope) {
        const auto link = std::ranges::find(spec_.links, scope.prefix + frame.body, &LinkSpec::name);
        if (link == spec_.links.end()) return;
        const Pose X_MF = scope.X_MS * frame.X_MP;
        spec_.frames.push_back({scope.prefix + frame.name, link->name, inverse(link->X_ML) * X_MF});
    }

    void convert_nested(const TreePart& nested, const Scope& outer) {
        const std::size_t first = spec_.links.size();
        convert({*nested.model, outer.prefix + nested.name + "::", outer.X_MS * nested.X_MP,
                 import_.reader.boolean(nested.source, "enable_wind", outer.wind)});
        if (nested.model->is_static)
            for (std::size_t l = first; l < spec_.links.size(); ++l) static_.insert(spec_.links[l].name);
        report_nested_flags(nested.source);
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

    void convert_link(const TreePart& link, const Scope& scope) {
        const Element& source = link.source;
        LinkSpec spec;
        spec.name = scope.prefix + link.name;
        spec.where = source.where();
        spec.X_ML = scope.X_MS * link.X_MP;
        const auto pose_in_link = [&](const Element& part) {
            return scope.model.pose_in(link, part, import_.reader);
        };
        if (!spec_.is_static && !spec_.kinematic) convert_inertial(source, pose_in_link, import_, spec);
        convert_link_flags(source, spec);
        convert_drag(source, scope.wind, import_, spec);
        for (const auto node : source.node.children()) {
            if (node.type() == pugi::node_element)
                convert_part({source.source, node}, pose_in_link, scope.prefix, spec);
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
    void convert_part(const Element& part, const PoseInLink& pose_of, const std::string& scope,
                      LinkSpec& spec) {
        const char* tag = part.node.name();
        if (std::strcmp(tag, "collision") == 0) {
            report_repeated(part);
            if (auto collision = convert_collision(part, pose_of(part), import_))
                spec.collisions.push_back(std::move(*collision));
        } else if (std::strcmp(tag, "visual") == 0) {
            for (VisualSpec& visual : convert_visual(part, pose_of(part), import_))
                spec.visuals.push_back(std::move(visual));
        } else if (std::strcmp(tag, "light") == 0) {
            if (auto light = convert_light(part, pose_of(part), import_))
                spec.lights.push_back(std::move(*light));
        } else if (std::strcmp(tag, "sensor") == 0 || std::strcmp(tag, "roboss:sensor") == 0 ||
                   std::strcmp(tag, "roboss:radio") == 0) {
            const Pose X_LS = pose_of(part);
            std::vector<SensorSpec> cameras = convert_multicamera(part, X_LS, scope, import_);
            if (cameras.empty()) cameras.push_back(convert_sensor(part, X_LS, scope, import_));
            std::ranges::move(cameras, std::back_inserter(spec.sensors));
        }
    }

    void report_repeated(const Element& collision) {
        for (auto node = collision.node.previous_sibling("collision"); node;
             node = node.previous_sibling("collision")) {
            if (collision.name() != node.attribute("name").value()) continue;
            import_.diagnostics().warning(
                collision.where(), "repeated-name",
                "a link has several collisions named '" + collision.name() + "': all of them count",
                "Give each a name of its own.");
            return;
        }
    }

    void convert_joint_of(const TreePart& joint, const Scope& scope) {
        auto spec = convert_joint(joint, scope.model, scope.X_MS * joint.X_MP, scope.prefix, import_);
        if (!spec) return;
        if (joint.source.node.attribute(kJointName)) spec_.shared_names = true;
        for (const auto node : joint.source.node.children("sensor"))
            convert_joint_sensor({joint.source.source, node}, joint, *spec, scope);
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
    void convert_joint_sensor(const Element& element, const TreePart& part, const JointSpec& joint,
                              const Scope& scope) {
        const auto child = std::ranges::find(spec_.links, joint.child, &LinkSpec::name);
        if (child == spec_.links.end()) return;
        const Pose X_MS = joint.X_MJ * scope.model.pose_in(part, element, import_.reader);
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

    const Import& import_;
    ModelSpec& spec_;
    std::size_t kinematic_links_ = 0;
    std::set<std::string> static_;  // links of nested static models
};

}  // namespace

ModelSpec convert_model(const ModelTree& model, bool is_static, const Import& import) {
    const Element& source = model.source;
    ModelSpec spec;
    spec.name = source.name();
    spec.where = source.where();
    spec.is_static = is_static;
    spec.self_collide = import.reader.boolean(source, "self_collide", false);
    spec.may_sleep = import.reader.boolean(source, "allow_auto_disable", true);
    spec.canonical_link = model.canonical_link;
    ModelConverter converter(import, spec);
    converter.convert({model, "", {}, import.reader.boolean(source, "enable_wind", false)});
    converter.fix_static_links();
    converter.fix_kinematic_links();
    converter.fix_terrain();
    return spec;
}

}  // namespace roboss::sdf_import
