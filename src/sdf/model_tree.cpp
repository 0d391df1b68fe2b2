// Names and frames of a model that is read.
#include "sdf/model_tree.h"

#include <cmath>

namespace roboss::sdf_import {
namespace {

/// Up to SDFormat 1.4 an axis was written in the model's frame; up to 1.6 it could be.
bool is_in_model_frame(const Element& axis, const ElementReader& reader) {
    const int version = version_of(*axis.source);
    return version < 107 && reader.boolean(axis, "use_parent_model_frame", version < 105);
}

}  // namespace

std::optional<ModelTree::Named> ModelTree::locate(const std::string& name) const {
    if (const auto known = by_name.find(name); known != by_name.end()) return Named{known->second, {}};
    for (std::size_t at = name.find("::"); at != name.npos; at = name.find("::", at + 2)) {
        const auto nested = by_name.find(name.substr(0, at));
        if (nested != by_name.end() && parts[nested->second].model)
            return Named{nested->second, name.substr(at + 2)};
    }
    return std::nullopt;
}

std::optional<Pose> ModelTree::pose_of(const std::string& name) const {
    if (name == kModelFrame) return Pose{};
    const auto named = locate(name);
    if (!named) return std::nullopt;
    const TreePart& part = parts[named->part];
    if (named->rest.empty()) return part.X_MP;
    const auto X_NP = part.model->pose_of(named->rest);
    return X_NP ? std::optional(part.X_MP * *X_NP) : std::nullopt;
}

std::optional<std::string> ModelTree::body_of(const std::string& name) const {
    if (name == kModelFrame) return canonical_link.empty() ? std::nullopt : std::optional(canonical_link);
    const auto named = locate(name);
    if (!named) return std::nullopt;
    const TreePart& part = parts[named->part];
    if (named->rest.empty()) return part.body.empty() ? std::nullopt : std::optional(part.body);
    const auto body = part.model->body_of(named->rest);
    return body ? std::optional(part.name + "::" + *body) : std::nullopt;
}

Pose ModelTree::pose_in(const TreePart& holder, const Element& posed, const ElementReader& reader) const {
    const Element pose = posed.child("pose");
    const Pose X_RP = reader.pose(pose);
    const std::string frame = relative_to(pose);
    if (frame.empty()) return X_RP;
    if (const auto X_MR = pose_of(frame == kModelFrame ? holder.model_frame : frame))
        return inverse(holder.X_MP) * *X_MR * X_RP;
    reader.diagnostics().warning(
        pose.where(), "unknown-frame",
        "the <pose> of <" + std::string(posed.node.name()) + "> '" + posed.name() + "' is relative to '" +
            frame + "', which its model does not have; it is taken as relative to '" + holder.name + "'",
        "Name a link, joint, frame or nested model of the model, or NESTED::NAME.");
    return X_RP;
}

Vec3 ModelTree::direction_of(const TreePart& joint, const Element& axis, const ElementReader& reader) const {
    const Element xyz = axis.child("xyz");
    const Vec3 written = reader.vector(axis, "xyz", {0, 0, 1});
    const double length = norm(written);
    if (!(length > 1e-12) || !std::isfinite(length)) return {0, 0, 1};  // reported with the joint
    const Vec3 direction = written / length;
    std::string frame = xyz.node.attribute("expressed_in").value();
    if (frame.empty() && is_in_model_frame(axis, reader)) frame = kModelFrame;
    if (frame.empty() || frame == joint.name) return direction;
    const auto X_ME = pose_of(frame == kModelFrame ? joint.model_frame : frame);
    if (X_ME) return rotate(conjugate(joint.X_MP.q) * X_ME->q, direction);
    reader.diagnostics().error(xyz.where(), "unknown-frame",
                               "the axis of joint '" + joint.name + "' is expressed in '" + frame +
                                   "', which its model does not have",
                               "Name a link, joint, frame or nested model of the model, or NESTED::NAME.");
    return direction;
}

}  // namespace roboss::sdf_import
