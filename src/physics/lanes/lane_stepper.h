// Robots that meet nobody, stepped several of one type at a time in the lanes of a register: the same kernel
// as for one robot (dynamics.h, contact_rows.h, newton.h) over another number type, so that each lane gets
// the same bits. Contacts are found lane by lane by the ordinary narrow phase. Lanes whose contacts or
// decisions differ from those of most are left to the ordinary step.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/check.h"
#include "physics/contact/contact.h"
#include "physics/step.h"

namespace roboss {

struct LaneRobot {
    RobotId id;
    RobotState* state = nullptr;
    Aabb* bound = nullptr;          // receives the interaction bound
    bool has_contacts = false;      // found already, all of them with scenery
    std::span<Contact> contacts{};  // then these; they receive what is solved
};

class LaneStepper {
  public:
    LaneStepper() = default;
    virtual ~LaneStepper();
    LaneStepper(const LaneStepper&) = delete;
    LaneStepper& operator=(const LaneStepper&) = delete;

    virtual std::size_t width() const = 0;
    /// Steps at most width() robots, awake, of one type that fits. Bit i of the result: robots[i] was
    /// stepped; the others are untouched. Of robots whose contacts are given, these and the bound are left to
    /// the caller: to remember, to count.
    virtual unsigned step(const Model& model, std::span<const LaneRobot> robots, StepReport& report,
                          StageClock& clock) = 0;
    /// The interaction bounds of at most width() robots, awake, of one type that fits.
    virtual void find_bounds(const Model& model, std::span<const LaneRobot> robots) = 0;
};

/// Robots that wait, by type, until a register is full. They have numbers of the caller.
class LaneQueue {
  public:
    void start(std::size_t types) {
        waiting_.resize(std::max(waiting_.size(), types));
        for (std::vector<std::uint32_t>& batch : waiting_) batch.clear();
    }
    /// Robot i waits; once there are enough, step(batch) steps and clears them.
    template <class Step>
    void add(std::size_t type, std::uint32_t i, std::size_t width, Step&& step) {
        waiting_[type].push_back(i);
        if (waiting_[type].size() >= width) step(waiting_[type]);
    }
    /// Steps those who still wait.
    template <class Step>
    void finish(Step&& step) {
        for (std::vector<std::uint32_t>& batch : waiting_)
            if (!batch.empty()) step(batch);
    }

  private:
    std::vector<std::vector<std::uint32_t>> waiting_;
};

/// What robots that meet nobody are stepped with; `lanes` may be none. `single`, where robots are stepped in
/// floats: who did not get through in lanes has another try by itself, so that no bit depends on who shared
/// them.
struct LaneSteppers {
    LaneStepper* lanes = nullptr;
    LaneStepper* single = nullptr;

    explicit operator bool() const { return lanes != nullptr; }
    std::size_t width() const { return lanes->width(); }
    bool in_floats() const { return single != nullptr; }
    /// True if such a robot is stepped in them. In doubles those with own numbers are not.
    bool take(const Model& model, const RobotType& type, const RobotState& state) const;
};

/// Steps a batch in lanes, each robot as lane_of(i) says; then visit(i, whether it was stepped) for each of
/// them. The batch is empty afterwards.
template <class LaneOf, class Visit>
void step_batch(const LaneSteppers& steppers, const Model& model, std::vector<std::uint32_t>& batch,
                StepReport& report, StageClock& clock, LaneOf&& lane_of, Visit&& visit) {
    ROBOSS_CHECK(!batch.empty() && batch.size() <= std::min(kMostLanes, steppers.width()),
                 std::to_string(batch.size()) + " robots");
    std::array<LaneRobot, kMostLanes> robots;
    std::ranges::transform(batch, robots.begin(), lane_of);
    unsigned stepped = 0;
    if (batch.size() > 1)
        stepped = steppers.lanes->step(model, std::span(robots).first(batch.size()), report, clock);
    for (std::size_t k = 0; steppers.in_floats() && k < batch.size(); ++k)
        if ((stepped >> k & 1u) == 0)
            stepped |= steppers.single->step(model, {&robots[k], 1}, report, clock) << k;
    for (std::size_t k = 0; k < batch.size(); ++k) visit(batch[k], (stepped >> k & 1u) != 0);
    batch.clear();
}

/// Whether a robot with joints may be stepped in lanes: no loops, couplings or drag, no contact with itself,
/// no wheels that slip, no wrench, no bond that it holds, and a driven motor (the energy of others is
/// guarded, see kick_drift.h and island_guard.h).
bool fits_lanes(const RobotType& type, const RobotState& state);
/// Likewise a free body that touched something in the last tick. Those that turn so far in a tick that their
/// energy is guarded do not fit, nor those about to fall asleep.
bool rests_in_lanes(const Model& model, const RobotType& type, const RobotState& state);

/// The widest stepper of at most `most` lanes that this processor can run. If there is none: nullptr for
/// doubles, make_single_stepper() for floats.
std::unique_ptr<LaneStepper> make_lane_stepper(Precision precision, std::size_t most);
/// One robot at a time, in floats.
std::unique_ptr<LaneStepper> make_single_stepper();

// One translation unit for each instruction set (lanes_*.cpp); nullptr if it was built without.
std::unique_ptr<LaneStepper> make_avx2_stepper(Precision precision);
std::unique_ptr<LaneStepper> make_avx512_stepper(Precision precision);
std::unique_ptr<LaneStepper> make_neon2_stepper(Precision precision);
std::unique_ptr<LaneStepper> make_neon4_stepper(Precision precision);
std::unique_ptr<LaneStepper> make_neon8_stepper(Precision precision);

}  // namespace roboss
