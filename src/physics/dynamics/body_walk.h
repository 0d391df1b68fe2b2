// Placing and moving the bodies of a robot, and what is summed over them: of a robot with many loops by all
// threads of a team. The bits are those of the functions in robot_work.h, for any number of threads.
#pragma once

#include "physics/dynamics/body_branches.h"
#include "physics/dynamics/robot_work.h"

namespace roboss {

class BodyWalk {
  public:
    /// What a body adds to the sums over a robot.
    struct Terms {
        Spatial momentum;
        double kinetic = 0, potential = 0;
    };

    /// Whose threads may share the work.
    void share_with(const Team& team) { team_ = team; }
    const Team& team() const { return team_; }

    /// Whether threads share the bodies of such a robot; then branches() are its own.
    bool shares(const RobotType& type);
    const BodyBranches& branches() const { return branches_; }

    /// forward_kinematics
    void place(const RobotType& type, std::span<const double> q, RobotWork& work);
    /// forward_velocities
    void move(const RobotType& type, std::span<const double> v, RobotWork& work);
    /// work(first, last) for blocks of bodies, of two and more.
    template <class Work>
    void each_block(const RobotType& type, const Work& work) const {
        constexpr std::size_t kBlock = 64;
        team_.run_blocks(type.bodies.size(), kBlock, work);
    }
    /// A buffer, by body.
    std::vector<Terms>& terms(const RobotType& type) {
        terms_.resize(type.bodies.size());
        return terms_;
    }

  private:
    Team team_;
    BodyBranches branches_;
    std::vector<Terms> terms_;
};

}  // namespace roboss
