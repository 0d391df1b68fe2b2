// Resolves the frames of a world depth first, with a mark on those on the way, so that a circle is found.
#include "sdf/world_frames.h"

namespace roboss::sdf_import {

WorldFrames::WorldFrames(const Element& world, const std::vector<Placement>& placements, InModel in_model,
                         const Import& import)
    : placements_(placements), in_model_(std::move(in_model)), import_(import) {
    for (const auto node : world.node.children("frame")) frames_.push_back({world.source, node});
    for (std::size_t i = 0; i < placements.size(); ++i)
        names_.try_emplace(placements[i].name, Named{false, i});
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        if (!names_.try_emplace(frames_[i].name(), Named{true, i}).second) {
            import.diagnostics().error(
                frames_[i].where(), "duplicate-name",
                "the frame '" + frames_[i].name() + "' has the name of another frame or model",
                "Give it a name of its own.");
        }
    }
    solved_models_.resize(placements.size());
    solved_frames_.resize(frames_.size());
}

Pose WorldFrames::pose_of(std::size_t placement) {
    return solve({false, placement});
}

Pose WorldFrames::pose_of(const Element& element) {
    const Element pose = element.child("pose");
    return named_pose(relative_to(pose), element) * import_.reader.pose(pose);
}

Pose WorldFrames::solve(const Named& named) {
    Solved& solved = named.is_frame ? solved_frames_[named.index] : solved_models_[named.index];
    if (solved.state == State::kBusy) {
        const Element& at = named.is_frame ? frames_[named.index] : placements_[named.index].where;
        import_.diagnostics().error(at.where(), "frame-cycle",
                                    "the pose of '" +
                                        (named.is_frame ? at.name() : placements_[named.index].name) +
                                        "' depends on itself",
                                    "Break the circle of relative_to and attached_to.");
        return {};
    }
    if (solved.state == State::kOpen) {
        solved.state = State::kBusy;
        solved.X = named.is_frame ? solve_frame(named.index) : solve_model(named.index);
        solved.state = State::kDone;
    }
    return solved.X;
}

Pose WorldFrames::solve_frame(std::size_t index) {
    const Element frame = frames_[index];
    const Element pose = frame.child("pose");
    std::string base = relative_to(pose);
    if (base.empty()) base = frame.node.attribute("attached_to").value();
    return named_pose(base, frame) * import_.reader.pose(pose);
}

Pose WorldFrames::solve_model(std::size_t index) {
    const Placement& placement = placements_[index];
    const Pose X_WP = named_pose(placement.relative_to, placement.where) * placement.X_RP;
    if (placement.placement_frame.empty() || placement.placement_frame == "__model__") return X_WP;
    const auto X_MP = in_model_(index, placement.placement_frame);
    if (!X_MP) {
        import_.diagnostics().error(placement.where.where(), "unknown-frame",
                                    "the placement frame '" + placement.placement_frame +
                                        "' is not in model '" + placement.name + "'",
                                    "Name one of its links, joints or frames.");
        return X_WP;
    }
    return X_WP * inverse(*X_MP);
}

Pose WorldFrames::named_pose(const std::string& name, const Element& user) {
    if (name.empty() || name == "world") return {};
    const std::size_t scope = name.find("::");
    const auto found = names_.find(name.substr(0, scope));
    if (found != names_.end()) {
        const Named named = found->second;
        if (scope == std::string::npos) return solve(named);
        if (!named.is_frame) {
            if (const auto X_MF = in_model_(named.index, name.substr(scope + 2))) return solve(named) * *X_MF;
        }
    }
    import_.diagnostics().error(user.where(), "unknown-frame",
                                "'" + name + "' is no frame or model of this world",
                                "Check the name in relative_to or attached_to.");
    return {};
}

}  // namespace roboss::sdf_import
