// The numbers of a robot that differ from those of its type and of the Model, and the type that it has with
// them. Decisions 0050 and 0051.
#pragma once

#include <memory>
#include <vector>

#include "model/joint_parameters.h"
#include "model/link_parameters.h"
#include "model/surroundings.h"

namespace roboss {

/// All numbers that differ from those of the robot's type or of the Model, and no others.
struct OwnNumbers {
    std::vector<OwnJointNumber> joints;  ///< by joint, axis and parameter
    std::vector<OwnLinkNumber> links;    ///< by link and parameter
    OwnSurroundings around{};            ///< gravity and wind
    /// True if there are none.
    bool empty() const { return joints.empty() && links.empty() && around.empty(); }
    /// Compares all members.
    friend bool operator==(const OwnNumbers&, const OwnNumbers&) = default;
};

/// The type that a robot has with its own numbers: what a step computes it with. It follows from the numbers
/// and the type of the Model, so it is neither compared nor hashed, nor does it travel; copies of a state
/// share it.
class OwnType {
  public:
    OwnType() = default;
    /// No numbers: none.
    OwnType(const RobotType& type, const OwnNumbers& own);
    /// nullptr: the robot has the type of the Model.
    const RobotType* get() const { return type_.get(); }
    /// Becomes that of `type`, an equal one of another Model in memory, whose shapes it points to then.
    void move_to(const RobotType& type, const OwnNumbers& own);
    /// Always true: what differs stands in the numbers.
    friend bool operator==(const OwnType&, const OwnType&) { return true; }

  private:
    std::shared_ptr<const RobotType> type_;
};

/// Gives a robot of the Model's type these numbers in place of those that it has.
void set_own(const RobotType& type, OwnNumbers own, RobotState& state);

}  // namespace roboss
