// Moves the arm of worlds/arm.sdf from posture to posture by positions of its joints. It goes on when the
// encoders say that a posture is reached, so it needs nothing of the world but the joints: the same library
// drives the simulated arm
// (`roboss run`) and a real one (`roboss device`, docs/devices.md).
#include <algorithm>
#include <array>
#include <cmath>

#include <roboss/client/control_program.h>

namespace {

constexpr std::array<const char*, 6> kJoints{"yaw", "shoulder", "elbow", "roll", "bend", "flange"};
using Posture = std::array<double, 6>;  // rad
constexpr std::array<Posture, 3> kPostures{
    {{0.8, 0.5, 0.7, 0, 0.4, 0}, {-0.8, 0.3, 1.1, 0.5, 0.2, 1}, {0, 0, 0, 0, 0, 0}}};
constexpr double kReached = 0.02;  // rad
constexpr double kLead = 0.03;     // rad: setpoints stay this close to the joint, so nothing jumps

class Postures : public roboss::ControlProgram {
  public:
    void control(roboss::Client& client) override {
        bool reached = true;
        for (std::size_t j = 0; j < kJoints.size(); ++j) {
            const double position = client.joint("arm", kJoints[j]).position;
            const double left = kPostures[next_][j] - position;
            reached = reached && std::abs(left) < kReached;
            const double ahead = std::clamp(left, -kLead, kLead);
            client.set_joint("arm", kJoints[j], roboss::MotorMode::kPosition, position + ahead);
        }
        if (reached) next_ = (next_ + 1) % kPostures.size();
    }
    std::string memory() const override { return std::string(1, static_cast<char>(next_)); }
    void restore(const std::string& bytes) override {
        next_ = static_cast<std::size_t>(bytes.at(0)) % kPostures.size();
    }

  private:
    std::size_t next_ = 0;
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(Postures)
