// WorldFrames: poses of models and frames in the world, through `relative_to`, `attached_to` and placement
// frames.
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "sdf/placements.h"

namespace roboss::sdf_import {

class WorldFrames {
  public:
    /// `in_model(i, name)`: the pose of a frame inside the model of placement i, in the model's frame.
    using InModel = std::function<std::optional<Pose>(std::size_t, const std::string&)>;

    WorldFrames(const Element& world, const std::vector<Placement>& placements, InModel in_model,
                const Import& import);

    /// X_WM of placement i. Names that lead nowhere and circles are reported, and taken as the world's frame.
    Pose pose_of(std::size_t placement);

    /// The pose in the world of an element with a <pose>, a light for instance.
    Pose pose_of(const Element& element);

  private:
    struct Named {
        bool is_frame = false;
        std::size_t index = 0;
    };
    enum class State { kOpen, kBusy, kDone };
    struct Solved {
        State state = State::kOpen;
        Pose X;
    };

    Pose solve(const Named& named);
    Pose solve_frame(std::size_t index);
    Pose solve_model(std::size_t index);
    Pose named_pose(const std::string& name, const Element& user);

    const std::vector<Placement>& placements_;
    std::vector<Element> frames_;
    std::unordered_map<std::string, Named> names_;
    std::vector<Solved> solved_models_, solved_frames_;
    InModel in_model_;
    const Import& import_;
};

}  // namespace roboss::sdf_import
