// Which robots are of one type: those that a step treats alike, whatever they, their parts and topics are
// called.
#include <gtest/gtest.h>

#include <functional>
#include <type_traits>

#include <support/robots.h>

#include "model/compile_type.h"
#include "model/model.h"

namespace roboss::test {
namespace {

const RobotId kFirst(std::size_t{0}), kSecond(std::size_t{1});

/// A car with all that a robot may carry; names of its parts, its topics and its sensors begin with `own`.
ModelSpec equipped(const std::string& own) {
    ModelSpec spec = car();
    spec.name = own;
    for (LinkSpec& link : spec.links) link.name = own + link.name;
    for (JointSpec& joint : spec.joints)
        joint.name = own + joint.name, joint.parent = own + joint.parent, joint.child = own + joint.child;
    spec.canonical_link = spec.links[0].name;
    SensorSpec sensor;
    sensor.name = own + "scan", sensor.update_rate_hz = static_cast<double>(own.size());
    sensor.parameters = LaserSpec{};
    spec.links[0].sensors.push_back(sensor);
    DiffDriveSpec drive;
    drive.left = {spec.joints[0].name, spec.joints[2].name},
    drive.right = {spec.joints[1].name, spec.joints[3].name};
    drive.wheel_separation = 0.26, drive.wheel_radius = 0.05;
    drive.topic = "/" + own + "/cmd_vel", drive.output.topic = own + "_odometry";
    drive.output.rate = sensor.update_rate_hz;
    spec.onboard.push_back({own + "plugin", drive, {}});
    LinearBatterySpec battery;
    battery.battery_name = own + "battery", battery.voltage = 12, battery.capacity = 2;
    spec.onboard.push_back({"battery", battery, {}});
    return spec;
}

std::shared_ptr<const Model> pair_of(const ModelSpec& first, const ModelSpec& second) {
    World world = empty_world(1e-3);
    place(world, first, "first");
    place(world, second, "second", {{3, 0, 0}, {}});
    Diagnostics diagnostics;
    return compile(world, {}, diagnostics);
}

TEST(RobotsAlike, DifferInNamesTopicsAndSensorsAlone) {
    const auto model = pair_of(equipped("a"), equipped("long_"));
    EXPECT_EQ(model->like(kFirst), model->like(kSecond));
    EXPECT_NE(model->type_of(kFirst).hash, model->type_of(kSecond).hash) << "each keeps its own names";
    EXPECT_EQ(model->type_of(kSecond).sensors[0].spec.name, "long_scan");
    EXPECT_EQ(model->type_of(kSecond).channels[0].channel.topic, "/long_/cmd_vel");
    EXPECT_NE(pair_of(equipped("a"), equipped("b"))->hash, model->hash) << "names count in the Model hash";
}

TEST(RobotsAlike, MayCarryDifferentSensors) {
    ModelSpec other = equipped("b");
    other.links[0].sensors.clear();
    EXPECT_EQ(pair_of(equipped("a"), other)->types.size(), 2u);
    const auto model = pair_of(equipped("a"), other);
    EXPECT_EQ(model->like(kFirst), model->like(kSecond));
}

TEST(RobotsAlike, MayReflectLasersDifferently) {
    ModelSpec bright = equipped("b");
    bright.links[0].collisions[0].laser_retro = 100;
    const auto model = pair_of(equipped("a"), bright);
    EXPECT_EQ(model->like(kFirst), model->like(kSecond));
}

TEST(RobotsAlike, AreThoseOfWhichAStepReadsTheSame) {
    const struct {
        const char* what;
        std::function<void(ModelSpec&)> change;
    } changes[] = {
        {"a mass", [](ModelSpec& m) { m.links[2].mass *= 1.0000001; }},
        {"a size", [](ModelSpec& m) { m.links[0].collisions[0].geometry.size.x += 1e-9; }},
        {"a friction coefficient", [](ModelSpec& m) { m.links[1].collisions[0].surface.mu += 1e-9; }},
        {"a motor's bound", [](ModelSpec& m) { m.joints[0].axes[0].max_effort += 1; }},
        {"a place", [](ModelSpec& m) { m.joints[3].X_MJ.p.x += 1e-6; }},
        {"the order of the wheels",
         [](ModelSpec& m) {
             auto& drive = std::get<DiffDriveSpec>(m.onboard[0].parameters);
             std::swap(drive.left, drive.right);
         }},
        {"a number of a controller",
         [](ModelSpec& m) { std::get<DiffDriveSpec>(m.onboard[0].parameters).wheel_radius += 1e-6; }},
        {"a controller more",
         [](ModelSpec& m) {
             m.onboard.push_back({"v", VelocityControlSpec{}, {}});
         }},
        {"a controller less", [](ModelSpec& m) { m.onboard.pop_back(); }},
        {"whether it sleeps", [](ModelSpec& m) { m.may_sleep = false; }},
    };
    for (const auto& [what, change] : changes) {
        ModelSpec other = equipped("b");
        change(other);
        const auto model = pair_of(equipped("a"), other);
        ASSERT_NE(model, nullptr) << what;
        EXPECT_NE(model->like(kFirst), model->like(kSecond)) << what;
    }
}

TEST(RobotsAlike, ShareTheirCommandsInTheSameWay) {
    const auto with_two = [](const std::string& first, const std::string& second) {
        ModelSpec spec = car();
        for (const std::string& topic : {first, second}) {
            VelocityControlSpec control;
            control.topic = topic;
            spec.onboard.push_back({"go", control, {}});
        }
        return spec;
    };
    const auto apart = pair_of(with_two("/a/go", "/b/go"), with_two("/c/go", "/d/go"));
    EXPECT_EQ(apart->like(kFirst), apart->like(kSecond));
    const auto shared = pair_of(with_two("/a/go", "/b/go"), with_two("/c/go", "/c/go"));
    EXPECT_NE(shared->like(kFirst), shared->like(kSecond))
        << "one command drives both controllers of the second";
}

TEST(RobotsAlike, DifferWhereAWordSaysHowAControllerWorks) {
    const auto with_rotor = [](const std::string& direction, const std::string& name) {
        ModelSpec spec = car();
        MotorModelSpec motor;
        motor.joint = {spec.joints[0].name}, motor.link = {spec.links[1].name};
        motor.direction = direction, motor.robot_namespace = name;
        spec.onboard.push_back({"rotor", motor, {}});
        return spec;
    };
    const auto alike = pair_of(with_rotor("cw", "X1"), with_rotor("cw", "X2"));
    ASSERT_FALSE(alike->type_of(kFirst).onboard.empty());
    EXPECT_EQ(alike->like(kFirst), alike->like(kSecond));
    const auto other = pair_of(with_rotor("cw", "X1"), with_rotor("ccw", "X2"));
    EXPECT_NE(other->like(kFirst), other->like(kSecond));
}

/// Sets all texts of a controller that are no words for how it works.
struct TextSetter {
    std::string text;

    template <class Value>
    void operator()(const Parameter& parameter, Value& value) const {
        if (parameter.choice) return;
        if constexpr (std::is_same_v<Value, std::string>)
            value = text;
        else if constexpr (std::is_base_of_v<std::vector<std::string>, Value>)
            value.assign(1, text);
        else if constexpr (requires { requires ParameterRecord<typename Value::value_type>; })
            for (auto& record : value) record.parameters(*this, record);
    }
};

/// Changes its first number, or its first word for how it works.
struct FirstChange {
    bool done = false;

    template <class Value>
    void operator()(const Parameter& parameter, Value& value) {
        if (done) return;
        done = true;
        if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int>)
            value += 1;
        else if constexpr (std::is_same_v<Value, bool>)
            value = !value;
        else if constexpr (std::is_same_v<Value, Vec3>)
            value.x += 1;
        else if constexpr (std::is_same_v<Value, std::string>)
            parameter.choice ? void(value += "?") : void(done = false);
        else
            done = false;
    }
};

TEST(RobotsAlike, RunControllersThatDifferInNamesAndTopicsOnlyOfAllKinds) {
    const auto hash_of = [](const OnboardParameters& parameters, bool of_step) {
        OnboardInfo info;
        info.spec = {"plugin", parameters, {}};
        Hash hash;
        of_step ? add_to_step_hash(hash, info) : add_to_hash(hash, info);
        return hash.value();
    };
    for_each_onboard_kind([&]<class Kind>(std::in_place_type_t<Kind>) {
        OnboardParameters first = Kind{}, second = Kind{}, other = Kind{};
        visit_parameters(first, TextSetter{"a"}), visit_parameters(second, TextSetter{"b"});
        EXPECT_EQ(hash_of(first, true), hash_of(second, true)) << Kind::kKind.name;
        FirstChange change;
        visit_parameters(other, change);
        if (change.done) {
            EXPECT_NE(hash_of(other, true), hash_of(Kind{}, true)) << Kind::kKind.name;
        }
        if (first != second) {
            EXPECT_NE(hash_of(first, false), hash_of(second, false)) << Kind::kKind.name;
        }
    });
}

TEST(Commands, AreFoundByTheLastPartsOfTheirNames) {
    const auto model = pair_of(equipped("a"), equipped("b"));
    const RobotType& type = model->type_of(kFirst);
    EXPECT_EQ(type.find_channel("cmd_vel"), std::nullopt);
    EXPECT_EQ(type.find_command("a/cmd_vel"), type.find_channel("a/cmd_vel"));
    EXPECT_EQ(type.find_command("cmd_vel"), type.find_channel("a/cmd_vel"));
    EXPECT_EQ(type.find_command("vel"), std::nullopt) << "no part of a name";
    EXPECT_EQ(type.find_command(""), std::nullopt);
    ModelSpec two = equipped("a");
    VelocityControlSpec control;
    control.topic = "/other/cmd_vel";
    two.onboard.push_back({"go", control, {}});
    EXPECT_EQ(pair_of(two, car())->type_of(kFirst).find_command("cmd_vel"), std::nullopt) << "there are two";
}

}  // namespace
}  // namespace roboss::test
