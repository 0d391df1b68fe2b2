// LogicalAudioSensorPlugin of Gazebo: sources of sound on a model, which play and fall silent by command.
// Its microphones are sensors (sensor_kinds/microphone.h).
#pragma once

#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/fixed_math.h"
#include "math/pose.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// A point that sounds equally loud in all directions.
struct AudioSource {
    int id = -1;                       ///< unique in the plugin
    Pose X_RS;                         ///< m, in the model's frame; only its position counts
    std::string attenuation_function,  ///< "linear"
        attenuation_shape;             ///< "sphere"
    double inner_radius = kUnset,      ///< m: up to here the volume is full
        falloff_distance = kUnset;     ///< m: from here on nothing is heard
    double volume_level = kUnset;      ///< 0 to 1
    bool playing = false;              ///< at the start
    double play_duration = 0;          ///< s that it plays at most; 0: for ever

    static constexpr double kUnset = -std::numeric_limits<double>::max();  ///< not written

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"id", "id"}, s.id);
        visit({"pose", "pose", "m"}, s.X_RS);
        visit({.name = "attenuation_function", .element = "attenuation_function", .choice = true},
              s.attenuation_function);
        visit({"attenuation_shape", "attenuation_shape"}, s.attenuation_shape);
        visit({"inner_radius", "inner_radius", "m"}, s.inner_radius);
        visit({"falloff_distance", "falloff_distance", "m"}, s.falloff_distance);
        visit({"volume_level", "volume_level"}, s.volume_level);
        visit({"playing", "playing"}, s.playing);
        visit({"play_duration", "play_duration", "s"}, s.play_duration);
    }
    /// "source_ID".
    std::string name() const { return "source_" + std::to_string(id); }
    /// Volume at a distance in m, while it plays.
    double volume_at(double distance) const {
        const double full = fixed_min(fixed_max(volume_level, 0.0), 1.0),
                     inner = fixed_max(inner_radius, 0.0);
        const double outer = falloff_distance > inner ? falloff_distance : inner + 1;  // as in Gazebo
        if (distance <= inner) return full;
        return distance >= outer ? 0.0 : full * (outer - distance) / (outer - inner);
    }
    /// Compares all members.
    friend bool operator==(const AudioSource&, const AudioSource&) = default;
};

/// The sources of one plugin.
struct AudioSourceSpec {
    std::vector<AudioSource> sources;  ///< in the order of the file

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 95,
                                       .name = "audio-source",
                                       .phrase = "a source of sound",
                                       .classes = "LogicalAudioSensorPlugin",
                                       .files = "logicalaudiosensorplugin-system"};
    /// What it remembers of each source: whether it plays (0 or 1), since which tick, and the ticks of the
    /// last commands to play and to stop that it has obeyed (-1: none).
    enum Memory : std::size_t { kPlays, kSince, kPlayHeard, kStopHeard, kSize };

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"sources", "source"}, s.sources);
    }
    /// The commands that it takes, two a source, without values: play and stop.
    std::vector<Channel> channels() const {
        std::vector<Channel> all;
        for (const AudioSource& source : sources)
            for (const char* action : {"/play", "/stop"})
                all.push_back(channel_of("", "sensor/" + source.name() + action, {}));
        return all;
    }
    /// At the start.
    std::vector<double> memory() const {
        std::vector<double> all;
        for (const AudioSource& source : sources)
            all.insert(all.end(), {source.playing ? 1.0 : 0.0, 0, -1, -1});
        return all;
    }
    /// A source whose time runs out may not sleep.
    bool rests(std::span<const double> memory) const {
        for (std::size_t i = 0; i < sources.size(); ++i)
            if (memory[i * kSize + kPlays] != 0 && sources[i].play_duration > 0) return false;
        return true;
    }
    /// None, if the plugin has microphones only.
    std::vector<AudioSourceSpec> parts() const {
        if (sources.empty()) return {};
        return {*this};
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        std::set<int> ids;
        for (const AudioSource& source : sources) {
            const std::string which = "has a <source> with the <id> " + std::to_string(source.id);
            if (source.id < 0)
                problems.push_back({"has a <source> without an <id>", "Write one of at least 0."});
            if (!ids.insert(source.id).second)
                problems.push_back({which + " twice", "Give each source an <id> of its own."});
            if (source.attenuation_function != "linear" || source.attenuation_shape != "sphere")
                problems.push_back(
                    {which + " that does not fall off linearly in a sphere",
                     "Write linear as <attenuation_function>, sphere as <attenuation_shape>."});
            for (const double value : {source.inner_radius, source.falloff_distance, source.volume_level})
                if (value == AudioSource::kUnset)
                    return problems.push_back(
                        {which + " that says not how loud it is",
                         "Write <inner_radius>, <falloff_distance> and <volume_level>."});
            if (!(source.play_duration >= 0))
                problems.push_back({which + " and a negative <play_duration>", "Write 0 for no end."});
        }
    }
    /// Compares all members.
    friend bool operator==(const AudioSourceSpec&, const AudioSourceSpec&) = default;
};

}  // namespace roboss
