// What every kind of sensor states about itself, and the types that its parameters may have.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace roboss {

/// Gaussian noise as in SDF's <noise type="gaussian">, in the unit of the value that it disturbs; all zero:
/// none.
struct NoiseSpec {
    double mean = 0,       ///< of the draw of each measurement
        stddev = 0;        ///< of the draw of each measurement
    double bias_mean = 0,  ///< of a bias that is drawn once per run
        bias_stddev = 0;   ///< of a bias that is drawn once per run
    double precision = 0;  ///< gaussian_quantized: readings are multiples of it; 0: any
    /// Compares all members.
    friend bool operator==(const NoiseSpec&, const NoiseSpec&) = default;
};

/// Joints of the sensor's model, by name ("inner::joint" in nested models).
struct JointNames : std::vector<std::string> {
    using std::vector<std::string>::vector;
};

/// One parameter of a kind of sensor: its name in code, hashes and the viewer's JSON, and its element in SDF.
struct Parameter {
    const char* name;       ///< unique in its kind
    const char* element;    ///< path below SensorKind::block, e.g. "scan/horizontal/samples"
    const char* unit = "";  ///< "rad": the element may have degrees="true"
    bool infinite = false;  ///< whether infinity is a value of it
};

/// One value of a reading: its name in the viewer's JSON, and its unit ("" for counts, ratios and rotations).
struct ReadingField {
    const char* name;       ///< unique in its reading
    const char* unit = "";  ///< "" for counts, ratios and rotations
};

/// An element of SDF that this kind of sensor does not honour. It is reported where it is written with
/// another value than `neutral`.
struct IgnoredElement {
    const char* element;      ///< path below SensorKind::block
    const char* neutral;      ///< the value that means nothing; "": none
    const char* why;          ///< continues "<element> has no effect: "
    const char* remedy = "";  ///< what to write instead; "": nothing
};

/// What a kind of sensor states about itself.
struct SensorKind {
    /// In Model hashes, on the wire and in saved runs: never changed, never used again.
    std::uint32_t number;
    const char* name;        ///< in the viewer's JSON and in `roboss check`
    const char* phrase;      ///< for messages: "a laser"
    const char* sdf_types;   ///< values of <sensor type="...">, separated by |
    bool ours = false;       ///< in <roboss:sensor> rather than <sensor>
    const char* block = "";  ///< the child element that holds the parameters, or "first|second"; "": none
    bool block_required = false;                ///< without it the sensor measures nothing
    bool needs_all_states = false;              ///< a reading depends on the states of other robots
    std::span<const IgnoredElement> ignored{};  ///< elements that have no effect
};

/// Why a sensor cannot measure with these parameters.
struct SensorProblem {
    std::string text;    ///< continues "sensor 'x' ...", e.g. "has 0 beams"
    std::string remedy;  ///< what to do about it
};

}  // namespace roboss
