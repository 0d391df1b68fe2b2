// Attributes: the attributes of an element, with those of its default classes behind them. A value that
// cannot be what it should be is an error with its line; the fallback is used so that reading can go on and
// find more.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "math/vec3.h"
#include "mjcf/document.h"

namespace roboss::mjcf {

class Attributes {
  public:
    /// `chain`: the element, then its default class, then that class's parent and so on.
    Attributes(std::vector<Element> chain, Diagnostics& diagnostics)
        : chain_(std::move(chain)), diagnostics_(&diagnostics) {}

    const Element& element() const { return chain_.front(); }
    SourceLocation where() const { return element().where(); }
    std::string name() const { return element().name(); }
    Diagnostics& diagnostics() const { return *diagnostics_; }

    /// The nearest element of the chain that has the attribute; an empty one: none has.
    Element owner(const char* attribute) const;
    /// The nearest element of the chain that has any of them.
    Element owner(std::span<const char* const> attributes) const;
    bool has(const char* attribute) const { return static_cast<bool>(owner(attribute)); }

    std::string text(const char* attribute, const std::string& fallback = "") const;
    double number(const char* attribute, double fallback) const;
    int integer(const char* attribute, int fallback) const;
    bool boolean(const char* attribute, bool fallback) const;
    Vec3 vector(const char* attribute, const Vec3& fallback) const;
    /// All of `values`, from the nearest element that has the attribute; false: none has, or not that many
    /// numbers.
    bool numbers(const char* attribute, std::span<double> values) const;
    /// As many numbers as each element of the chain writes, the nearer over the farther ones, as MuJoCo does
    /// for sizes, friction and the parameters of actuators. Returns how many the nearest one writes.
    std::size_t overlay(const char* attribute, std::span<double> values) const;
    /// All numbers of the nearest element that has the attribute.
    std::vector<double> list(const char* attribute) const;
    /// Whether `attribute`, true, false or auto, is on: auto is whether `range` is written, where <compiler
    /// autolimits> says so.
    bool limited(const char* attribute, const char* range, bool autolimits) const;

    /// Reports that an attribute is not what it should be.
    void bad_value(const char* attribute, const std::string& expected) const;

  private:
    std::vector<double> parse(const Element& owner, const char* attribute) const;

    std::vector<Element> chain_;
    Diagnostics* diagnostics_;
};

}  // namespace roboss::mjcf
