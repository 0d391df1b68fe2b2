// Arrays of doubles that Python hands over: to fill, and to read.
#pragma once

#include <nanobind/ndarray.h>

#include <optional>
#include <span>

namespace roboss_python {

using Out = nanobind::ndarray<double, nanobind::c_contig, nanobind::device::cpu>;
using In = nanobind::ndarray<const double, nanobind::c_contig, nanobind::device::cpu>;

inline std::span<double> numbers(const Out& array) {
    return {array.data(), array.size()};
}

inline std::span<const double> numbers(const In& array) {
    return {array.data(), array.size()};
}

using MaybeIn = std::optional<In>;

/// Empty: none is given.
inline std::span<const double> numbers(const MaybeIn& array) {
    return array ? numbers(*array) : std::span<const double>{};
}

}  // namespace roboss_python
