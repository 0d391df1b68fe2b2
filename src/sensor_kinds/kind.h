// What every kind of sensor states about itself, and the type of its noise parameters.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/parameter.h"

namespace roboss {

/// Gaussian noise as in SDF's `<noise type="gaussian">`, in the unit of the value that it disturbs; all zero:
/// none.
struct NoiseSpec {
    double mean = 0,       ///< of the draw of each measurement
        stddev = 0;        ///< of the draw of each measurement
    double bias_mean = 0,  ///< of a bias that is drawn once per run
        bias_stddev = 0;   ///< of a bias that is drawn once per run
    double precision = 0;  ///< gaussian_quantized: readings are multiples of it; 0: any
    /// Of a second bias, which is 0 at the start and wanders from tick to tick: db = -b / T dt + sigma dW,
    /// with T the correlation time, sigma this number and W a Wiener process. Unit of the value / sqrt(s).
    double dynamic_bias_stddev = 0;
    double dynamic_bias_correlation_time = 0;  ///< s; 0: no such bias
    /// Whether it has a bias that wanders.
    bool drifts() const { return dynamic_bias_stddev != 0 && dynamic_bias_correlation_time != 0; }
    /// Compares all members.
    friend bool operator==(const NoiseSpec&, const NoiseSpec&) = default;
};

/// One value of a reading: its name in the viewer's JSON, and its unit ("" for counts, ratios and rotations).
struct ReadingField {
    const char* name;       ///< unique in its reading
    const char* unit = "";  ///< "" for counts, ratios and rotations
};

/// The plugins of Gazebo that publish what a kind of sensor measures; each becomes such a sensor of its
/// model.
struct PublishingPlugin {
    /// Class names without their namespace, separated by |; "": none.
    const char* classes = "";
    /// File names without "lib", ".so" and Gazebo's prefix, separated by |: "odometry-publisher-system".
    const char* files = "";
    const char* topic = "topic";   ///< its element for the topic, after which the sensor is named
    const char* usual_topic = "";  ///< the sensor's name where no topic is written
    const char* rate = "";         ///< its element for the rate in Hz, or "first|second"
    double usual_rate_hz = 0;      ///< 0: whenever it is asked
    const char* element = "";      ///< its element that is one sensor, repeated; "": the plugin is
};

/// What a kind of sensor may ask about the plugin that it was made from.
struct PluginFacts {
    std::string file;   ///< name without "lib", ".so" and Gazebo's prefix
    std::string scope;  ///< prefix of the names of its nested model: "inner::" or ""
    std::string body;   ///< link that it names, with its prefix; "": none
};

/// What a kind of sensor states about itself.
struct SensorKind {
    /// In Model hashes, on the wire and in saved runs: never changed, never used again.
    std::uint32_t number;
    const char* name;        ///< in the viewer's JSON and in `roboss check`
    const char* phrase;      ///< for messages: "a laser"
    const char* sdf_types;   ///< values of `<sensor type="...">`, separated by |
    bool ours = false;       ///< in `<roboss:sensor>` rather than `<sensor>`
    const char* block = "";  ///< the child element that holds the parameters, or "first|second"; "": none
    bool block_required = false;    ///< without it the sensor measures nothing
    bool needs_all_states = false;  ///< a reading depends on the states of other robots
    bool is_image = false;          ///< readings are images: large, measured when asked, never held
    bool is_never_held = false;     ///< measured when asked, never held, for another reason
    /// Of what several sensors share, a reading uses SensorSources::ray_scene() alone: threads may measure
    /// several at once.
    bool by_rays = false;
    std::span<const IgnoredElement> ignored{};  ///< elements that have no effect
    PublishingPlugin plugin{};                  ///< of Gazebo, that measures this

    /// Whether a Client keeps a sample until the next one is due.
    constexpr bool is_held() const { return !is_image && !is_never_held; }
};

/// Why a sensor cannot measure with these parameters.
using SensorProblem = ParameterProblem;

}  // namespace roboss
