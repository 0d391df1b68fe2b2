// See accuracy.h. The settings were chosen by measurement: docs/physics.md, "Accuracy".
#include "model/accuracy.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace roboss {
namespace {

constexpr std::array kNumbers{
    AccuracyNumber{"tolerance", "relative error of the momentum balance", 1e-14, 1e-5, &Accuracy::tolerance,
                   nullptr},
    AccuracyNumber{"friction_tolerance", "relative error of a friction bound", 1e-10, 2e-2,
                   &Accuracy::friction_tolerance, nullptr},
    AccuracyNumber{"newton_max", "Newton iterations of a contact island and tick", 10, 1000, nullptr,
                   &Accuracy::newton_max},
    AccuracyNumber{"friction_max", "updates of its friction bounds", 2, 1000, nullptr,
                   &Accuracy::friction_max},
    AccuracyNumber{"compliance", "softness of hard joint rows, relative to the mobility they act on", 1e-8,
                   1e-5, &Accuracy::compliance, nullptr},
    AccuracyNumber{"impact_compliance", "softness of hard contacts that are new", 1e-8, 1e-3,
                   &Accuracy::impact_compliance, nullptr},
    AccuracyNumber{"contact_compliance", "softness of hard contacts that bear a load already", 1e-8, 1e-2,
                   &Accuracy::contact_compliance, nullptr},
    AccuracyNumber{"friction_compliance", "softness of the friction of hard contacts", 1e-8, 0.1,
                   &Accuracy::friction_compliance, nullptr},
};

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string names() {
    std::string all;
    for (const AccuracyNumber& n : kNumbers) all += (all.empty() ? "" : ", ") + std::string(n.name);
    return all;
}

void apply_number(const AccuracySpec& spec, const AccuracySpec::Number& wanted, Accuracy& accuracy,
                  Diagnostics& diagnostics) {
    for (const AccuracyNumber& number : kNumbers) {
        if (wanted.name != number.name) continue;
        const bool fits = wanted.value >= number.low && wanted.value <= number.high &&
                          (number.real != nullptr || wanted.value == std::floor(wanted.value));
        if (!fits) {
            diagnostics.error(
                spec.where, "bad-accuracy",
                "the accuracy's " + wanted.name + " (" + number.meaning + ") is " + text(wanted.value),
                "Give a " + std::string(number.real != nullptr ? "number" : "whole number") + " from " +
                    text(number.low) + " to " + text(number.high) + ".");
        } else if (number.real != nullptr) {
            accuracy.*number.real = wanted.value;
        } else {
            accuracy.*number.whole = static_cast<int>(wanted.value);
        }
        return;
    }
    diagnostics.error(spec.where, "bad-accuracy", "the accuracy has no number called '" + wanted.name + "'",
                      "Known: " + names() + ".");
}

}  // namespace

std::span<const AccuracyNumber> accuracy_numbers() {
    return kNumbers;
}

std::optional<Accuracy> accuracy_setting(const std::string& name) {
    Accuracy a;
    if (name == "standard") return a;
    if (name == "fast") {
        a.tolerance = 1e-6;
        a.friction_tolerance = 1e-2;
        a.newton_max = 30;
        a.friction_max = 6;
        a.impact_compliance = 1e-3;
        a.friction_compliance = 0.1;
        return a;
    }
    if (name == "high") {
        a.tolerance = 1e-12;
        a.friction_tolerance = 1e-7;
        a.newton_max = 200;
        a.friction_max = 60;
        a.compliance = a.impact_compliance = 1e-8;
        a.contact_compliance = 1e-6;
        a.friction_compliance = 1e-6;
        return a;
    }
    return std::nullopt;
}

void apply(const AccuracySpec& spec, Accuracy& accuracy, Diagnostics& diagnostics) {
    if (!spec.setting.empty()) {
        if (const std::optional<Accuracy> setting = accuracy_setting(spec.setting)) {
            accuracy = *setting;
        } else {
            diagnostics.error(spec.where, "bad-accuracy",
                              "there is no accuracy setting called '" + spec.setting + "'",
                              "Write fast, standard or high.");
        }
    }
    for (const AccuracySpec::Number& number : spec.numbers) apply_number(spec, number, accuracy, diagnostics);
}

}  // namespace roboss
