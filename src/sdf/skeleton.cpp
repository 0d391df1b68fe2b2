// Writes skeletons: one element a line, so that libsdformat's line numbers lead back to the source.
#include "sdf/skeleton.h"

#include <algorithm>
#include <cstring>

#include "sdf/element_reader.h"
#include "sdf/newer_versions.h"
#include "sdf/sdf_text.h"

namespace roboss::sdf_import {
namespace {

bool is_any(const char* name, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return std::strcmp(name, n) == 0; });
}

/// Parts of a model that say nothing about its kinematics; the importer reads or reports them from the
/// source.
bool is_left_out(const char* parent, const char* name) {
    if (std::strchr(name, ':') != nullptr) return true;  // other namespaces, ours among them
    if (is_any(name, {"plugin", "light", "sensor", "visual"})) return true;
    if (std::strcmp(parent, "model") == 0)
        return is_any(name, {"gripper", "self_collide", "allow_auto_disable", "enable_wind"});
    if (std::strcmp(parent, "link") == 0) {
        return is_any(name, {"gravity", "enable_wind", "self_collide", "kinematic", "must_be_base_link",
                             "velocity_decay", "projector", "particle_emitter", "audio_source", "audio_sink",
                             "battery"});
    }
    if (std::strcmp(parent, "joint") == 0) return is_any(name, {"physics"});
    return is_any(parent, {"axis", "axis2"}) && std::strcmp(name, "initial_position") == 0;
}

/// How many numbers the importer reads from an element itself, and so reports when they are wrong; 0: not
/// known.
int numbers_read_here(const Element& e) {
    const char* name = e.node.name();
    if (std::strcmp(name, "size") == 0) return std::strcmp(e.node.parent().name(), "plane") == 0 ? 2 : 3;
    if (is_any(name, {"normal", "radii", "scale", "fdir1"})) return 3;
    return is_any(name, {"mass",
                         "ixx",
                         "iyy",
                         "izz",
                         "ixy",
                         "ixz",
                         "iyz",
                         "radius",
                         "length",
                         "mu",
                         "mu2",
                         "lower",
                         "upper",
                         "effort",
                         "velocity",
                         "stiffness",
                         "dissipation",
                         "damping",
                         "friction",
                         "spring_stiffness",
                         "spring_reference",
                         "restitution_coefficient",
                         "threshold",
                         "coefficient",
                         "patch_radius",
                         "surface_radius"})
               ? 1
               : 0;
}

class Writer {
  public:
    Writer(Skeleton& out, SkeletonIncludes& includes) : out_(out), includes_(includes) {}

    void top_model(const Element& model, TopPose pose) {
        const bool keep = pose == TopPose::kKept;
        const std::string version = libsdformat_version(version_of(*model.source));
        out_.head = "<sdf version=\"" + version + "\"><model name=\"" + escaped(model.name()) + "\"";
        out_.lines.push_back(model);
        for (const auto attribute : model.node.attributes()) {
            const bool placement = std::strcmp(attribute.name(), "placement_frame") == 0;
            if (std::strcmp(attribute.name(), "name") != 0 && (keep || !placement))
                write_attribute(attribute);
        }
        out_.body += '>';
        for (const auto child : model.node.children()) {
            if (child.type() != pugi::node_element) continue;
            if (keep || std::strcmp(child.name(), "pose") != 0) element({model.source, child}, "model");
        }
        out_.body += "\n</model></sdf>\n";
    }

  private:
    void element(const Element& e, const char* parent) {
        const char* name = e.node.name();
        if (is_any(name, {"visual", "sensor", "light"}) && std::strcmp(parent, "link") == 0)
            return posed_only(e);
        if (is_left_out(parent, name) || !known_to_libsdformat(e)) return;
        if (std::strcmp(name, "include") == 0) return include(e);
        if (std::strcmp(name, "pose") == 0 && is_any(parent, {"collision", "inertial"}) &&
            relative_to(e).empty())
            return;
        const bool mask =
            masked_ > 0 || is_any(name, {"inertial", "geometry", "surface", "limit", "dynamics"});
        open(e);
        masked_ += mask ? 1 : 0;
        content(e);
        masked_ -= mask ? 1 : 0;
        out_.body += std::string("</") + name + ">";
    }

    void open(const Element& e) {
        out_.body += std::string("\n<") + e.node.name();
        out_.lines.push_back(e);
        for (const auto attribute : e.node.attributes()) {
            if (std::strcmp(attribute.name(), "name") == 0) {
                out_.body += " name=\"" + escaped(name_among_siblings(e)) + "\"";
            } else if (std::strchr(attribute.name(), ':') == nullptr &&
                       attribute_known_to_libsdformat(e, attribute.name())) {
                write_attribute(attribute);
            }
        }
        out_.body += '>';
    }

    void content(const Element& e) {
        for (const auto child : e.node.children()) {
            if (child.type() == pugi::node_element) {
                element({e.source, child}, e.node.name());
            } else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
                out_.body += masked_ > 0 ? masked(e, child.value()) : mended(e, child.value());
            }
        }
    }

    /// A visual, sensor or light whose pose depends on other frames: a stand-in that libsdformat can place.
    void posed_only(const Element& e) {
        const Element pose = e.child("pose");
        if (relative_to(pose).empty()) return;
        const bool visual = std::strcmp(e.node.name(), "visual") == 0,
                   light = std::strcmp(e.node.name(), "light") == 0;
        out_.body += std::string("\n<") + e.node.name() + " name=\"" + escaped(name_among_siblings(e)) +
                     (visual  ? "\">"
                      : light ? "\" type=\"point\">"
                              : "\" type=\"contact\">");
        out_.lines.push_back(e);
        element(pose, e.node.name());
        if (visual) out_.body += "<geometry><sphere><radius>1</radius></sphere></geometry>";
        out_.body += std::string("</") + e.node.name() + ">";
    }

    void include(const Element& e) {
        const auto file = includes_.skeleton_file(e);
        if (!file) return;
        open(e);
        out_.body += "<uri>" + escaped(*file) + "</uri>";
        for (const char* kept : {"name", "pose", "static", "placement_frame"}) {
            if (const Element child = e.child(kept)) element(child, "include");
        }
        out_.body += "</include>";
    }

    void write_attribute(const pugi::xml_attribute& attribute) {
        out_.body += std::string(" ") + attribute.name() + "=\"" + escaped(attribute.value()) + "\"";
    }

    /// Every number becomes 1 (products of inertia 0, so that the inertia stays valid); other words stay.
    /// What the importer reads itself is made valid here, so that libsdformat does not refuse the model and
    /// hide what else is wrong in it.
    static std::string masked(const Element& e, const std::string& text) {
        const char* name = e.node.name();
        if (const int count = numbers_read_here(e); count > 0) {
            if (is_any(name, {"ixy", "ixz", "iyz"})) return "0";
            return count == 1 ? "1" : count == 2 ? "1 1" : "1 1 1";
        }
        std::string result;
        for (const auto word : words_of(text)) {
            if (!result.empty()) result += ' ';
            result += parse_number(word) ? std::string("1") : escaped(std::string(word));
        }
        return result;
    }

    /// Numbers that libsdformat would refuse, which the importer reports where it reads them: decimal commas,
    /// and an axis without direction.
    static std::string mended(const Element& e, const std::string& text) {
        const bool axis = is_any(e.node.name(), {"xyz"});
        if (!axis && !is_any(e.node.name(), {"pose"})) return escaped(text);
        const auto words = words_of(text);
        const bool is_zero =
            axis && std::ranges::all_of(words, [](auto word) { return parse_number(word) == 0.0; });
        if (is_zero) return "0 0 1";
        std::string result;
        for (const auto word : words) {
            const std::string point = with_decimal_point(word);
            result += (result.empty() ? "" : " ") + (point.empty() ? escaped(std::string(word)) : point);
        }
        return result;
    }

    Skeleton& out_;
    SkeletonIncludes& includes_;
    int masked_ = 0;
};

}  // namespace

std::string name_among_siblings(const Element& part) {
    const std::string name = part.name();
    if (!is_any(part.node.name(), {"collision", "visual", "sensor", "light"})) return name;
    const auto has_name = [&](pugi::xml_node node, const std::string& wanted) {
        return std::strcmp(node.name(), part.node.name()) == 0 && wanted == node.attribute("name").value();
    };
    int before = 0;
    for (auto node = part.node.previous_sibling(); node; node = node.previous_sibling())
        before += has_name(node, name) ? 1 : 0;
    if (before == 0) return name;
    std::string other = name + "_" + std::to_string(before);
    while (std::ranges::any_of(part.node.parent().children(),
                               [&](pugi::xml_node node) { return has_name(node, other); }))
        other += "_";
    return other;
}

Skeleton make_skeleton(const Element& model, TopPose pose, SkeletonIncludes& includes) {
    Skeleton skeleton;
    Writer(skeleton, includes).top_model(model, pose);
    return skeleton;
}

}  // namespace roboss::sdf_import
