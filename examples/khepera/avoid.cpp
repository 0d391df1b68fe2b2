// Drives a Khepera about without touching anything: a Braitenberg vehicle (V. Braitenberg, "Vehicles", MIT
// Press 1984). What a sensor sees slows the wheel on the other side, so the robot turns away. The same
// library drives the simulated robot (`roboss run`) and the real one (`roboss device`, docs/devices.md).
#include <algorithm>
#include <array>

#include <roboss/client/control_program.h>

namespace {

/// From the left to the right, then the two at the back; how each one, from 0 to 1, changes the speeds.
struct Eye {
    const char* name;
    double left, right;
};
constexpr std::array<Eye, 8> kEyes{{{"left", 0.5, -0.5},
                                    {"front_left", 1.0, -1.2},
                                    {"ahead_left", 1.0, -1.6},
                                    {"ahead_right", -1.4, 1.0},
                                    {"front_right", -1.2, 1.0},
                                    {"right", -0.5, 0.5},
                                    {"back_right", 0.2, 0.2},
                                    {"back_left", 0.2, 0.2}}};
constexpr double kCruise = 8;  // rad/s, 61 mm/s
constexpr double kFull = 600;  // of 1023: an eye that sees this much counts in full

class Avoid : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {.period_s = 0.05}; }

    void control(roboss::Client& client) override {
        double left = kCruise, right = kCruise;
        for (const Eye& eye : kEyes) {
            const double value = client.reading<roboss::InfraredReading>("khepera", eye.name).value;
            const double seen = std::min(value / kFull, 1.0);
            left += 2 * kCruise * eye.left * seen;
            right += 2 * kCruise * eye.right * seen;
        }
        const auto set = [&](const char* joint, double speed) {
            client.set_joint("khepera", joint, roboss::MotorMode::kVelocity, std::clamp(speed, -12.0, 12.0));
        };
        set("left", left);
        set("right", right);
    }
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(Avoid)
