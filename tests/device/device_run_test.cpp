// A control program on a device: when it is called, when the robots rest, and what it is told of abilities.
#include <functional>
#include <stdexcept>

#include "devices.h"

namespace roboss::test {
namespace {

/// Does in each control() what a test says.
class Scripted : public ControlProgram {
  public:
    explicit Scripted(std::function<void(Client&)> script) : script_(std::move(script)) {}
    void control(Client& client) override { script_(client); }

  private:
    std::function<void(Client&)> script_;
};

void drive(Client& client) {
    client.set_joint("khepera", "left", MotorMode::kVelocity, 4 * KheperaUnits::kSpeed);
    client.set_joint("khepera", "right", MotorMode::kVelocity, 5 * KheperaUnits::kSpeed);
}

class DeviceRunTest : public ::testing::Test {
  protected:
    void begin(std::function<void(Client&)> script, DeviceRunOptions options = {}) {
        model = world_file("khepera.sdf");
        const RobotId robot = id_of(*model, "khepera");
        options.period = 25;  // of 2 ms
        std::vector<ConnectedDevice> lines(1);
        auto fake = std::make_unique<FakeLine>(device);
        line = fake.get();
        lines[0] = {std::move(fake), std::move(make_adapter("khepera", *model, robot)).value(), robot,
                    on_silence};
        if (other != nullptr)
            lines.push_back({std::make_unique<FakeLine>(*other),
                             std::move(make_adapter("khepera", *model, robot)).value(), robot});
        run =
            std::make_unique<DeviceRun>(model, std::move(lines), std::make_unique<Scripted>(script), options);
    }
    void pass(double seconds) {
        for (const double end = now + seconds; now < end; now += 0.002) run->advance(now);
    }
    using Phase = DeviceRun::Phase;

    std::shared_ptr<const Model> model;
    FakeKhepera device;
    FakeLine* line = nullptr;
    OnSilence on_silence = OnSilence::kStopAll;  // of `device`
    FakeKhepera* other = nullptr;                // a second device; it stops all
    std::unique_ptr<DeviceRun> run;
    double now = 1000;
};

TEST_F(DeviceRunTest, AProgramIsCalledOnceAPeriodOfRealTimeAndTheRobotStopsAtItsEnd) {
    std::vector<Tick> ticks;
    begin([&](Client& client) { ticks.push_back(client.tick()), drive(client); }, {.duration_s = 2});
    pass(1);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{4, 5}));
    EXPECT_EQ(run->phase(), Phase::kDriving);
    pass(1.5);
    EXPECT_EQ(run->phase(), Phase::kOver);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{0, 0}));
    EXPECT_FALSE(run->failure());
    ASSERT_GE(ticks.size(), 40u);  // at 0, 50 ms ... 1950 ms, and perhaps at 2 s
    EXPECT_EQ(ticks[0], 0);
    EXPECT_EQ(ticks[39], 39 * 25);
}

TEST_F(DeviceRunTest, ASilentDeviceIsNotDrivenAndReturnsWithItsOrders) {
    int calls = 0;
    begin([&](Client& client) {
        if (calls++ == 0) drive(client);  // once: orders hold
    });
    pass(1);
    device.mute = true;
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kSilent);
    const int before = calls;
    pass(1);
    EXPECT_EQ(calls, before);
    EXPECT_EQ(device.heard, "D,0,0");
    device.mute = false;
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kDriving);
    EXPECT_GT(calls, before);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{4, 5}));
    EXPECT_EQ(run->count().losses, 1u);
    EXPECT_EQ(run->count().late, 0u);
}

/// Whether a notice has this code.
bool noticed(const std::vector<std::string>& notices, const std::string& code) {
    return std::ranges::any_of(notices, [&](const std::string& n) { return n.ends_with("[" + code + "]"); });
}

TEST_F(DeviceRunTest, ASilentDeviceThatStopsAloneRestsWhileTheProgramGoesOn) {
    int calls = 0;
    on_silence = OnSilence::kStopThis;
    begin([&](Client& client) { ++calls, drive(client); });
    pass(1);
    device.mute = true;
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kDriving);
    EXPECT_EQ(device.heard, "D,0,0");
    EXPECT_EQ(run->count().losses, 1u);
    const int before = calls;
    pass(20);  // no time ends it
    EXPECT_GE(calls, before + 390);
    EXPECT_TRUE(noticed(run->take_notices(), "lost"));
    device.mute = false;
    pass(1);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{4, 5}));
    EXPECT_TRUE(noticed(run->take_notices(), "back"));
}

TEST_F(DeviceRunTest, ASilentDeviceThatIsIgnoredIsDrivenOn) {
    int calls = 0;
    on_silence = OnSilence::kGoOn;
    begin([&](Client& client) { ++calls, drive(client); });
    pass(1);
    device.mute = true;
    const int before = calls;
    pass(15);
    EXPECT_EQ(run->phase(), Phase::kDriving);
    EXPECT_GE(calls, before + 290);
    EXPECT_EQ(device.heard, "D,4,5");
    EXPECT_FALSE(run->failure());
    run->stop();
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kOver);
    EXPECT_EQ(device.heard, "D,0,0");
    EXPECT_TRUE(noticed(run->take_notices(), "unstopped"));
}

TEST_F(DeviceRunTest, OneOfTwoDevicesThatStopsAloneLeavesTheOtherDriving) {
    FakeKhepera second;
    on_silence = OnSilence::kStopThis;
    other = &second;
    begin(drive);
    pass(1);
    device.mute = true;
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kDriving);
    EXPECT_EQ(device.heard, "D,0,0");
    second.mute = true;  // this one stops all
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kSilent);
    second.mute = false;
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kDriving);
    EXPECT_EQ(device.heard, "D,0,0");  // still silent
    device.mute = false;
    pass(1);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{4, 5}));
}

TEST_F(DeviceRunTest, ALineThatIsCutIsOpenedAgain) {
    begin(drive);
    pass(1);
    line->cut = true;
    pass(2);
    EXPECT_EQ(run->phase(), Phase::kSilent);
    line->cut = false;
    pass(1);
    EXPECT_EQ(run->phase(), Phase::kDriving);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{4, 5}));
}

TEST_F(DeviceRunTest, ADeviceThatNeverAnswersEndsTheRun) {
    begin(drive, {.give_up_s = 3});
    device.mute = true;
    pass(2.9);
    EXPECT_EQ(run->phase(), Phase::kConnecting);
    pass(1.5);
    EXPECT_EQ(run->phase(), Phase::kOver);
    EXPECT_EQ(run->failure()->code, "device-lost");
    EXPECT_EQ(run->count().calls, 0u);
    EXPECT_TRUE(noticed(run->take_notices(), "unstopped"));
}

TEST_F(DeviceRunTest, AnExceptionStopsTheRobot) {
    begin([&](Client& client) {
        drive(client);
        if (client.tick() >= 250) throw std::runtime_error("enough");
    });
    pass(2);
    EXPECT_EQ(run->phase(), Phase::kOver);
    EXPECT_EQ(run->failure()->code, "client-failed");
    EXPECT_EQ(device.speeds, (std::array<int, 2>{0, 0}));
}

TEST_F(DeviceRunTest, PeriodsThatAreMissedAreSkippedAndCounted) {
    std::vector<Tick> ticks;
    begin([&](Client& client) {
        ticks.push_back(client.tick());
        drive(client);
    });
    pass(1);
    const std::size_t before = ticks.size();
    now += 0.23;  // the computer was busy
    pass(0.1);
    EXPECT_GE(run->count().late, 4u);
    EXPECT_LE(ticks.size(), before + 3);
    for (const Tick tick : ticks) EXPECT_EQ(tick % 25, 0);
}

TEST_F(DeviceRunTest, StopEndsItOrderly) {
    begin(drive);
    pass(1);
    run->stop();
    pass(0.5);
    EXPECT_EQ(run->phase(), Phase::kOver);
    EXPECT_EQ(device.speeds, (std::array<int, 2>{0, 0}));
    EXPECT_FALSE(run->failure());
}

TEST_F(DeviceRunTest, WhatNobodyKnowsThrowsAndWhatNobodyCanDoIsRefused) {
    int asked = 0;
    begin([&](Client& client) {
        if (asked++ > 0) return;
        EXPECT_THROW((void)client.state(RobotId(0u)), std::invalid_argument);
        EXPECT_THROW((void)client.pose("khepera", "body"),
                     std::invalid_argument);  // counting turns is no pose
        EXPECT_THROW((void)client.twist("khepera", "body"), std::invalid_argument);
        EXPECT_THROW((void)client.contacts(), std::invalid_argument);
        EXPECT_THROW((void)client.joint("khepera", "middle"), std::invalid_argument);
        EXPECT_NO_THROW((void)client.joint("khepera", "left"));
        EXPECT_EQ(client.reading<InfraredReading>("khepera", "left").value, 77);
        EXPECT_FALSE(client.set_pose("khepera", Pose{}).ok());
        EXPECT_FALSE(client.set_joint("khepera", "left", MotorMode::kPosition, 1).ok());
        EXPECT_FALSE(client.set_joint("khepera", "left", MotorMode::kVelocity, 1e12).ok());
        client.control(PauseRun{});
        const auto answers = client.take_control_answers();
        ASSERT_EQ(answers.size(), 1u);
        EXPECT_FALSE(answers[0].done());
    });
    device.eyes[0] = 77;
    pass(1);
    EXPECT_GT(asked, 1);
    EXPECT_FALSE(run->failure());
    std::size_t refusals = 0;
    for (const std::string& notice : run->take_notices())
        refusals += notice.find("refused") != std::string::npos;
    EXPECT_EQ(refusals, 3u);
}

}  // namespace
}  // namespace roboss::test
