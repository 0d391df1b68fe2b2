// A control program that gives random orders, by seed.
#pragma once

#include "client/control_program.h"
#include "fuzz/mechanism.h"

namespace roboss::fuzz {

/// Gives random orders of every level, commands and attachments included; what it does depends on what it
/// sees.
class RandomProgram : public ControlProgram {
  public:
    explicit RandomProgram(std::uint64_t seed) : seed_(seed) {}
    void control(Client& client) override {
        Random random(seed_ * 1000 + calls_++);
        const Model& model = client.model();
        for (int i = 0; i < 3; ++i) {
            const RobotId robot(
                static_cast<std::size_t>(random.integer(0, static_cast<int>(model.robots.size()) - 1)));
            if (!give_order(client, robot, random).ok()) ++refused_;
        }
    }

  private:
    /// Any command of the robot.
    static Result<> give_command(Client& client, RobotId robot, Random& random) {
        const RobotType& type = client.model().type_of(robot);
        const ChannelInfo& channel = type.channels[static_cast<std::size_t>(
            random.integer(0, static_cast<int>(type.channels.size()) - 1))];
        std::vector<double> values;
        for (std::size_t i = 0; i < channel.channel.values.size(); ++i)
            values.push_back(random.integer(0, 3) == 0 ? 0.0 : random.uniform(-3, 3));
        return client.command(robot, channel.channel.name, values);
    }

    /// Own numbers of a joint, some of which no robot may have, or those of its type.
    static Result<> give_parameters(Client& client, RobotId robot, JointId joint, Random& random) {
        if (random.integer(0, 5) == 0) return client.reset_joint_parameters(robot, joint);
        std::vector<JointParameterValue> values;
        for (const JointParameter parameter :
             {JointParameter::kDamping, JointParameter::kFriction, JointParameter::kSpringStiffness,
              JointParameter::kArmature, JointParameter::kPositionGain, JointParameter::kVelocityGain,
              JointParameter::kMaxEffort})
            if (random.integer(0, 2) == 0) values.push_back({parameter, random.uniform(-0.2, 3)});
        if (random.integer(0, 3) == 0)
            values.insert(values.end(), {{JointParameter::kLower, random.uniform(-1, 0)},
                                         {JointParameter::kUpper, random.uniform(0, 1)}});
        return client.set_joint_parameters(robot, joint, std::move(values));
    }

    /// Own numbers of a link, some of which no robot may have, or those of its type.
    static Result<> give_link_parameters(Client& client, RobotId robot, LinkId link, Random& random) {
        if (random.integer(0, 5) == 0) return client.reset_link_parameters(robot, link);
        std::vector<LinkParameterValue> values;
        for (const LinkParameter parameter :
             {LinkParameter::kMass, LinkParameter::kCentreX, LinkParameter::kCentreZ,
              LinkParameter::kFriction, LinkParameter::kRestitution, LinkParameter::kTorsionalFriction}) {
            if (random.integer(0, 2) > 0) continue;
            const double now = client.link_parameter(robot, link, parameter).value_or(1);
            const double share =
                parameter == LinkParameter::kMass ? now * random.uniform(0.3, 3) : random.uniform(-0.05, 0.4);
            values.push_back({parameter, share});
        }
        return client.set_link_parameters(robot, link, std::move(values));
    }

    /// Own gravity or wind, or those of the world.
    static Result<> give_surroundings(Client& client, RobotId robot, Random& random) {
        if (random.integer(0, 3) == 0) return client.reset_surroundings(robot);
        if (random.integer(0, 2) == 0) return client.set_wind(robot, random.vector(5));
        const Vec3 gravity = client.model().gravity * random.uniform(0, 1.5);
        return client.set_gravity(robot, gravity + random.vector(1));
    }

    Result<> give_order(Client& client, RobotId robot, Random& random) {
        const RobotType& type = client.model().type_of(robot);
        const RobotState& state = client.state(robot);
        const double pull = state.q[0] - state.q[1];
        if (!type.channels.empty() && random.integer(0, 2) > 0) return give_command(client, robot, random);
        const int pick = random.integer(0, 15);
        if (pick == 15) return give_surroundings(client, robot, random);
        if ((pick < 6 || pick > 12) && !type.joints.empty()) {
            const JointId joint(
                static_cast<std::size_t>(random.integer(0, static_cast<int>(type.joints.size()) - 1)));
            if (pick > 12) return give_parameters(client, robot, joint, random);
            return client.set_joint(robot, joint, MotorMode::kVelocity, random.uniform(-8, 8) + pull, 5);
        }
        if (pick == 6)
            return give_link_parameters(
                client, robot,
                LinkId(static_cast<std::size_t>(random.integer(0, static_cast<int>(type.links.size()) - 1))),
                random);
        if (pick < 9)
            return client.apply_wrench(robot, LinkId(std::size_t{0}), random.vector(5) + Vec3{pull, 0, 0}, {},
                                       0.02);
        const LinkId link(std::size_t{0});
        if (pick < 11) {
            const RobotId other(static_cast<std::size_t>(
                random.integer(0, static_cast<int>(client.model().robots.size()) - 1)));
            return client.attach(robot, link, other, link);
        }
        if (pick < 12) return client.detach(robot, RobotId());
        Pose X_WR = base_pose(state);  // a leap over whoever is near
        X_WR.p += random.vector(1);
        return client.set_pose(robot, X_WR);
    }

    std::uint64_t seed_, calls_ = 0;
    std::size_t refused_ = 0;
};

}  // namespace roboss::fuzz
