// Drives the rover of world.sdf, and turns away from what its laser sees.
#include <roboss/client/control_program.h>

#include <algorithm>

namespace {

class Driver : public roboss::ControlProgram {
    // When control() is called: every 0.05 s of simulated time. The world waits for it, so runs are
    // reproducible.
    roboss::ControlOptions options() const override { return {.period_s = 0.05}; }

    void control(roboss::Client& client) override {
        const auto ranges = client.laser("rover", "scan").ranges;  // m; infinite: nothing is hit
        const double nearest = *std::min_element(ranges.begin(), ranges.end());
        const bool blocked = nearest < 0.8;
        turn(client, blocked ? -4 : 8, 8);
    }

    /// Velocities of the wheels, rad/s. An order holds until the next one.
    static void turn(roboss::Client& client, double left, double right) {
        client.set_joint("rover", "left_wheel", roboss::MotorMode::kVelocity, left);
        client.set_joint("rover", "right_wheel", roboss::MotorMode::kVelocity, right);
    }
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(Driver)
