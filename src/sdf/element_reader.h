// ElementReader: values out of XML elements. A value that cannot be what it should be (a word where a number
// belongs, NaN, too few numbers) is an error with its line; the fallback is used so that reading can go on
// and find more.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/number_text.h"
#include "math/pose.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

enum class Finite { kRequired, kInfinityAllowed };

/// The number that a text begins with, whatever follows it; nullopt: none.
std::optional<double> number_at_start(std::string_view text);

/// "0,5" with a point, as languages differ in it; empty: the word is no such number.
std::string with_decimal_point(std::string_view word);

class ElementReader {
  public:
    explicit ElementReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    double number(const Element& parent, const char* child, double fallback,
                  Finite finite = Finite::kRequired) const;
    int integer(const Element& parent, const char* child, int fallback) const;
    bool boolean(const Element& parent, const char* child, bool fallback) const;
    Vec3 vector(const Element& parent, const char* child, const Vec3& fallback) const;
    /// The number that is the element's own text.
    double value(const Element& element, double fallback) const;
    /// Six numbers; zeros if there is no such child.
    std::array<double, 6> six(const Element& parent, const char* child) const;

    /// An angle in radians, or in degrees with degrees="true".
    double angle(const Element& parent, const char* child, double fallback) const;

    /// A <pose>: x y z roll pitch yaw, also with degrees="true" or rotation_format="quat_xyzw". Empty:
    /// identity.
    Pose pose(const Element& pose_element) const;

    Diagnostics& diagnostics() const { return diagnostics_; }

  private:
    /// Fills all of `values` from the element's text, or reports and leaves them as they are.
    bool numbers(const Element& element, std::span<double> values, Finite finite) const;
    void report_rest(const Element& element, std::string_view word) const;
    /// nullopt: not even the beginning of the word is a number.
    std::optional<double> parsed(const Element& element, std::string_view word) const;
    void bad_value(const Element& element, const std::string& expected) const;

    Diagnostics& diagnostics_;
};

/// The frame that a <pose> names by `relative_to` (`frame` up to SDFormat 1.6); empty: none.
std::string relative_to(const Element& pose_element);

}  // namespace roboss::sdf_import
