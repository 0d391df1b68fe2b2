// A control program in a shared library, as a user would write one.
#include "client/control_program.h"

namespace {

class Pusher : public roboss::ControlProgram {
  public:
    void control(roboss::Client& client) override {
        if (!client.apply_wrench(roboss::RobotId(2u), roboss::LinkId(0u), {30, 0, 0}, {}, 0.02)) return;
    }
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(Pusher)
