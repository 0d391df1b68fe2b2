#include <roboss/client/control_program.h>

class Circle : public roboss::ControlProgram {
    void control(roboss::Client& client) override {
        client.set_joint("rover", "left_wheel", roboss::MotorMode::kVelocity, 8.0);  // rad/s
        client.set_joint("rover", "right_wheel", roboss::MotorMode::kVelocity, 10.0);
    }
};
ROBOSS_CONTROL_PROGRAM(Circle)
