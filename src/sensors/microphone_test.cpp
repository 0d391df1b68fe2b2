// Microphones and sources of sound: volumes against the law of Gazebo's plugin.
#include <gtest/gtest.h>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

AudioSource source_at(const Vec3& p_R, double volume, double inner, double outer) {
    AudioSource source;
    source.id = 7, source.X_RS.p = p_R, source.volume_level = volume;
    source.inner_radius = inner, source.falloff_distance = outer;
    source.attenuation_function = "linear", source.attenuation_shape = "sphere";
    source.playing = true;
    return source;
}

/// Two carts: the first has a microphone on its mast (1 m up), the second these sources.
struct Carts {
    std::shared_ptr<Model> model;
    RobotState listener = cart_at({{0, 0, -1}, {}}), speaker;

    Carts(const std::vector<AudioSource>& sources, const Pose& X_WB, double threshold = 0)
        : speaker(cart_at(X_WB)) {
        RobotType type = cart_type();
        MicrophoneSpec microphone;
        microphone.id = 1, microphone.volume_threshold = threshold;
        add_sensor(type, 1, sensor("mic_1", microphone));
        model = model_of(type, 2);
        AudioSourceSpec spec;
        spec.sources = sources;
        OnboardInfo info;
        info.spec.parameters = spec;
        info.memory = spec.memory();
        speaker.onboard = spec.memory();
        RobotType speakers = cart_type();
        speakers.onboard.push_back(std::move(info));
        model->types.push_back(std::move(speakers));
        model->robots[1].type = TypeId(std::size_t{1});
    }
    MicrophoneReading read() const { return read_as<MicrophoneReading>(model, {&listener, &speaker}, 0); }
    /// Of the one source; -1: it is not heard.
    double volume() const {
        const MicrophoneReading reading = read();
        return reading.volumes.empty() ? -1 : reading.volumes.at(0);
    }
};

TEST(Microphone, HearsLessWithTheDistance) {
    const auto volume = [](double distance) {
        return Carts({source_at({}, 0.8, 1, 5)}, {{distance, 0, 0}, {}}).volume();
    };
    EXPECT_EQ(volume(0.5), 0.8);
    EXPECT_EQ(volume(1), 0.8);
    EXPECT_NEAR(volume(2), 0.6, 1e-12);
    EXPECT_NEAR(volume(4), 0.2, 1e-12);
    EXPECT_EQ(volume(5), -1);
    EXPECT_EQ(volume(50), -1);
}

TEST(Microphone, HearsNothingBelowItsThreshold) {
    EXPECT_NEAR(Carts({source_at({}, 0.8, 1, 5)}, {{2, 0, 0}, {}}, 0.59).volume(), 0.6, 1e-12);
    EXPECT_EQ(Carts({source_at({}, 0.8, 1, 5)}, {{2, 0, 0}, {}}, 0.61).volume(), -1);
}

TEST(Microphone, ASourceMovesWithTheFrameOfItsModel) {
    const Pose X_WB{{3, 0, 0}, from_rpy(0, 0, kPi)};  // turned: its source, 1 m ahead, is at x = 2
    Carts carts({source_at({1, 0, 0}, 0.8, 1, 5)}, X_WB);
    EXPECT_NEAR(carts.volume(), 0.6, 1e-12);
    carts.model->types[1].X_RB.p = {1, 0, 0};  // the body stands 1 m ahead of the model's frame
    EXPECT_NEAR(carts.volume(), 0.4, 1e-12);   // so the source is in the body's origin, at x = 3
}

TEST(Microphone, NamesTheSourcesThatPlay) {
    AudioSource silent = source_at({}, 0.5, 1, 5);
    silent.id = 8;
    AudioSource loud = source_at({}, 3, -1, -2);  // clamped as in Gazebo: volume 1, from 0 to 1 m
    loud.id = 9;
    Carts carts({source_at({}, 0.8, 1, 5), silent, loud}, {{0.5, 0, 0}, {}});
    carts.speaker.onboard[AudioSourceSpec::kSize + AudioSourceSpec::kPlays] = 0;
    const MicrophoneReading reading = carts.read();
    EXPECT_EQ(reading.sources, (std::vector<std::string>{"cart_1/source_7", "cart_1/source_9"}));
    EXPECT_EQ(reading.volumes.at(0), 0.8);
    EXPECT_NEAR(reading.volumes.at(1), 0.5, 1e-12);
}

}  // namespace
}  // namespace roboss
