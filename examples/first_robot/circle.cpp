#include "client/control_program.h"

class Circle : public roboss::ControlProgram {
    void control(roboss::Client& client) override {
        const roboss::RobotId rover = client.model().find_robot("rover").value();
        const roboss::RobotType& type = client.model().type_of(rover);
        client.set_joint(rover, *type.find_joint("left_wheel"), roboss::MotorMode::kVelocity, 8.0).value();
        client.set_joint(rover, *type.find_joint("right_wheel"), roboss::MotorMode::kVelocity, 10.0).value();
    }
};
ROBOSS_CONTROL_PROGRAM(Circle)
