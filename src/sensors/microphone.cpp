// The microphone: volumes of the sources of sound that play, of all robots.
#include "physics/dynamics/kinematics.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

/// m, world: a point of the robot's model frame.
Vec3 place_of(const RobotType& type, const RobotState& state, const Vec3& p_R) {
    return to_transform(base_pose(state)) * (inverse(type.X_RB) * p_R);
}

}  // namespace

Result<MicrophoneReading> read(const MicrophoneSpec& microphone, const SensorQuery& query) {
    constexpr double kSilence = 1e-5;  // as in Gazebo: nothing hears less
    const SensorInfo& info = query.info();
    const Vec3 here = link_pose(query.type(), query.state, info.link) * info.spec.X_LS.p;
    MicrophoneReading reading;
    for (std::size_t i = 0; i < query.model.robots.size(); ++i) {
        const RobotId id(i);
        const RobotType& type = query.model.type_of(id);
        for (const OnboardInfo& controller : type.onboard) {
            const auto* spec = std::get_if<AudioSourceSpec>(&controller.spec.parameters);
            if (spec == nullptr) continue;
            const RobotState& state = query.sources.state_of(id);
            const auto memory = static_cast<std::size_t>(controller.memory_index);
            for (std::size_t k = 0; k < spec->sources.size(); ++k) {
                const AudioSource& source = spec->sources[k];
                if (state.onboard[memory + k * AudioSourceSpec::kSize + AudioSourceSpec::kPlays] == 0)
                    continue;
                const double volume = source.volume_at(norm(place_of(type, state, source.X_RS.p) - here));
                if (volume < kSilence || volume < microphone.volume_threshold) continue;
                reading.sources.push_back(query.model.robots[i].name + "/" + source.name());
                reading.volumes.push_back(volume);
            }
        }
    }
    return reading;
}

}  // namespace roboss
