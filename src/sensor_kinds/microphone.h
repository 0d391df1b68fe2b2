// The microphone of LogicalAudioSensorPlugin: which sources of sound it hears, and how loud.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "math/pose.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a microphone hears: sources in the order of their robots, then of the file.
struct MicrophoneReading {
    std::vector<std::string> sources;  ///< "model/source_ID"
    std::vector<double> volumes;       ///< of each, from 0 to 1
    Tick tick = 0;                     ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"sources"}, r.sources);
        visit({"volumes"}, r.volumes);
    }
};

/// It hears a source that plays (onboard_kinds/audio_source.h) where its volume has not fallen below the
/// threshold. Nothing between them weakens the sound.
struct MicrophoneSpec {
    using Reading = MicrophoneReading;  ///< what it measures

    int id = -1;                  ///< in the plugin; the sensor is called mic_ID
    Pose X_RM;                    ///< m, in the model's frame; only its position counts
    double volume_threshold = 0;  ///< a source that is not as loud is not heard

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 40,
                                      .name = "microphone",
                                      .phrase = "a microphone",
                                      .sdf_types = "",
                                      .ours = true,
                                      .needs_all_states = true,
                                      .plugin = {.classes = "LogicalAudioSensorPlugin",
                                                 .files = "logicalaudiosensorplugin-system",
                                                 .topic = "",
                                                 .usual_topic = "mic",
                                                 .element = "microphone"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"id", "id"}, s.id);
        visit({"pose", "pose", "m"}, s.X_RM);
        visit({"volume_threshold", "volume_threshold"}, s.volume_threshold);
    }
    /// Of the sensor.
    std::string sensor_name() const { return "mic_" + std::to_string(id); }
    /// Compares all members.
    friend bool operator==(const MicrophoneSpec&, const MicrophoneSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (id < 0)
            problems.push_back({"has a <microphone> without an <id>", "Write an <id> of at least 0."});
    }
};

}  // namespace roboss
