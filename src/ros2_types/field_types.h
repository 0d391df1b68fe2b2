// Kinds of fields of a message: primitives, arrays, sequences, messages.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace roboss::ros2 {

/// A message: a struct with its name, as "std_msgs/msg/Header", and fields(visit, message), which calls
/// visit(name, value) for each field.
template <class T>
concept Message = requires(T& message) {
    {T::kName};
    T::fields([](const char*, auto&) {}, message);
};

/// A number, a bool or a byte.
template <class T>
concept Primitive = std::is_arithmetic_v<T>;

template <class T>
inline constexpr bool kIsSequence = false;
/// True of unbounded sequences.
template <class T>
inline constexpr bool kIsSequence<std::vector<T>> = true;

template <class T>
inline constexpr bool kIsArray = false;
/// True of arrays of fixed length.
template <class T, std::size_t n>
inline constexpr bool kIsArray<std::array<T, n>> = true;

}  // namespace roboss::ros2
