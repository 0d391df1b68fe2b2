// What every kind of sensor states about itself, and the type of its noise parameters.
#pragma once

#include <cstdint>
#include <span>

#include "core/parameter.h"

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

/// One value of a reading: its name in the viewer's JSON, and its unit ("" for counts, ratios and rotations).
struct ReadingField {
    const char* name;       ///< unique in its reading
    const char* unit = "";  ///< "" for counts, ratios and rotations
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
using SensorProblem = ParameterProblem;

}  // namespace roboss
