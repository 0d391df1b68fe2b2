// Where bodies touch only each other, their common angular momentum stays, and their energy does not grow.
// The soft solver knows the arms of its contacts at the beginning of the tick alone, so both are put right
// after it.
#pragma once

#include "physics/soft/soft_solver.h"

namespace roboss::soft {

class Guard {
  public:
    /// Before the robots move, with the solved impulses in the contacts. False where something else pushes or
    /// drives them.
    bool start(const Island& island, RobotWork& buffer);
    /// After that.
    void finish(const Island& island, RobotWork& buffer) const;

  private:
    Vec3 origin_;
    Vec3 momentum_;               // N m s, about the common centre of mass
    double energy_ = 0;           // J
    bool guards_energy_ = false;  // where there are joints, IslandGuard does
};

}  // namespace roboss::soft
