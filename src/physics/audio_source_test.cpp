// Sources of sound in the step: commands and play durations, and what the state hash sees of them.
#include <gtest/gtest.h>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

using Spec = AudioSourceSpec;
const RobotId kFirst(std::size_t{0});

AudioSource source(int id, bool playing, double duration) {
    AudioSource s;
    s.id = id, s.playing = playing, s.play_duration = duration;
    s.attenuation_function = "linear", s.attenuation_shape = "sphere";
    s.inner_radius = 1, s.falloff_distance = 5, s.volume_level = 0.8;
    return s;
}

World world_of(const std::vector<AudioSource>& sources) {
    ModelSpec model = pendulum();
    Spec spec;
    spec.sources = sources;
    model.onboard.push_back({"sound", spec, {}});
    World world = empty_world(1e-3, {});
    place(world, model, "robot");
    return world;
}

bool plays(const Simulation& sim, std::size_t which) {
    const OnboardInfo& info = sim.type(0).onboard.back();
    return sim.states[0]
               .onboard[static_cast<std::size_t>(info.memory_index) + which * Spec::kSize + Spec::kPlays] !=
           0;
}

/// Commands the robot and steps a tick.
void give(Simulation& sim, const std::string& name) {
    const auto channel = static_cast<std::uint32_t>(sim.type(0).find_channel(name).value());
    const Order order{sim.tick, ClientId(std::size_t{0}), 0, kFirst, Command{channel, {}}};
    sim.step({&order, 1});
}

TEST(AudioSource, PlaysForItsDurationFromTheStart) {
    Simulation sim(world_of({source(1, true, 0.5), source(2, true, 0), source(3, false, 0)}));
    while (sim.tick < 501) sim.step({});
    EXPECT_TRUE(plays(sim, 0)) << "500 ticks of 1 ms have not gone beyond 0.5 s";
    sim.step({});
    EXPECT_FALSE(plays(sim, 0));
    EXPECT_TRUE(plays(sim, 1));
    EXPECT_FALSE(plays(sim, 2));
}

TEST(AudioSource, PlaysAndFallsSilentByCommand) {
    Simulation sim(world_of({source(1, false, 0), source(2, false, 0.1)}));
    give(sim, "sensor/source_2/play");
    EXPECT_FALSE(plays(sim, 0));
    EXPECT_TRUE(plays(sim, 1));
    while (sim.tick < 50) sim.step({});
    give(sim, "sensor/source_2/play");  // it plays already: the time counts on
    while (sim.tick < 101) sim.step({});
    EXPECT_TRUE(plays(sim, 1));
    sim.step({});
    EXPECT_FALSE(plays(sim, 1));
    give(sim, "sensor/source_1/play");
    EXPECT_TRUE(plays(sim, 0));
    while (sim.tick < 500) sim.step({});
    EXPECT_TRUE(plays(sim, 0));
    give(sim, "sensor/source_1/stop");
    EXPECT_FALSE(plays(sim, 0));
    sim.step({});
    EXPECT_FALSE(plays(sim, 0)) << "each command is obeyed once";
}

TEST(AudioSource, MayNotSleepWhileItsTimeRuns) {
    Spec spec;
    spec.sources = {source(1, true, 0), source(2, false, 1)};
    std::vector<double> memory = spec.memory();
    EXPECT_TRUE(spec.rests(memory));
    memory[Spec::kSize + Spec::kPlays] = 1;
    EXPECT_FALSE(spec.rests(memory));
}

TEST(AudioSource, ThatSaysTooLittleIsAProblem) {
    const auto problems = [](const AudioSource& first, const AudioSource& second) {
        Spec spec;
        spec.sources = {first, second};
        return problems_of({"sound", spec, {}}).size();
    };
    const AudioSource good = source(1, true, 0), other = source(2, true, 0);
    EXPECT_EQ(problems(good, other), 0u);
    EXPECT_EQ(problems(good, good), 1u);
    AudioSource bad = other;
    bad.attenuation_shape = "cube";
    EXPECT_EQ(problems(good, bad), 1u);
    bad = other, bad.volume_level = AudioSource::kUnset;
    EXPECT_EQ(problems(good, bad), 1u);
    bad = other, bad.id = -1;
    EXPECT_EQ(problems(good, bad), 1u);
}

}  // namespace
}  // namespace roboss::test
