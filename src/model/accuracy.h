// The numbers by which a user trades truth for speed, and the range that each may have. Within these ranges
// the simulation stays honest (a skid-steer car whose motors are too weak to turn does not turn): beyond, it
// would be a guess.
#pragma once

#include <span>
#include <string>

#include "core/diagnostics.h"
#include "model/model.h"

namespace roboss {

/// One member of Accuracy and its range.
struct AccuracyNumber {
    const char* name;        ///< as in `<roboss:accuracy>`
    const char* meaning;     ///< for people: what it does
    double low,              ///< smallest value allowed
        high;                ///< largest value allowed
    double Accuracy::*real;  ///< one of the two is set
    int Accuracy::*whole;    ///< the member, if it is an int; else nullptr

    /// Its value in `a`.
    double get(const Accuracy& a) const { return real != nullptr ? a.*real : a.*whole; }
};

/// All numbers.
std::span<const AccuracyNumber> accuracy_numbers();

/// "fast", "standard" or "high"; nullopt for any other name.
std::optional<Accuracy> accuracy_setting(const std::string& name);

/// First the setting, if one is named, then the numbers. What is unknown or out of range is an error and is
/// left out.
void apply(const AccuracySpec& spec, Accuracy& accuracy, Diagnostics& diagnostics);

}  // namespace roboss
