// A control program with the faults that the environment variable FAULT names, a quarter of a second into the
// run.
#include <roboss/client/control_program.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

volatile int g_most = 1 << 30;  // calls, far more than a stack holds

int overflow(int depth) {
    volatile char page[4096];
    page[0] = static_cast<char>(depth);
    return depth < g_most ? overflow(depth + 1) + page[0] : 0;
}

class FaultyProgram : public roboss::ControlProgram {
    roboss::ControlOptions options() const override {
        const char* wanted = std::getenv("FAULT");
        if (wanted != nullptr && std::string(wanted) == "options") throw std::runtime_error("no options");
        return {};
    }
    void control(roboss::Client& client) override {
        if (client.time_s() < 0.25) return;
        const char* wanted = std::getenv("FAULT");
        const std::string fault = wanted == nullptr ? "" : wanted;
        if (fault == "segv") std::raise(SIGSEGV);
        if (fault == "null") *null_ = 1;
        if (fault == "overflow") (void)overflow(0);
        if (fault == "thread") std::thread([] { throw std::runtime_error("in a thread"); }).join();
        if (fault == "throw") throw std::runtime_error("as it was asked");
        if (fault == "robot") client.set_velocity("rovr", {}, {});
        if (fault == "joint") client.set_joint("rover", "left_weel", roboss::MotorMode::kVelocity, 1);
        if (fault == "order") client.set_joint("rover", "left_wheel", roboss::MotorMode::kVelocity, 1e300);
        if (fault == "id")
            client.set_joint(roboss::RobotId(77u), roboss::JointId(5u), roboss::MotorMode::kVelocity, 1);
        if (fault == "value")
            client.set_joint(roboss::RobotId(), roboss::JointId(), roboss::MotorMode::kVelocity, 1).value();
    }
    int* volatile null_ = nullptr;
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(FaultyProgram)
