// Kinds of fields of a message: primitives, arrays, sequences, messages.
#pragma once

#include <array>
#include <cstddef>
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
concept Primitive = std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>;

/// Name of the field that messages without fields have, as ROS 2 gives them one.
inline constexpr const char* kNoField = "structure_needs_at_least_one_member";

/// A sequence of at most `most` elements.
template <class T, std::size_t most>
struct Bounded : std::vector<T> {
    using std::vector<T>::vector;
};

template <class T>
inline constexpr bool kIsSequence = false;
/// True of sequences.
template <class T>
inline constexpr bool kIsSequence<std::vector<T>> = true;
template <class T, std::size_t most>
inline constexpr bool kIsSequence<Bounded<T, most>> = true;

template <class T>
inline constexpr std::size_t kBound = 0;
/// The most elements of a sequence that is bounded; 0: it is not.
template <class T, std::size_t most>
inline constexpr std::size_t kBound<Bounded<T, most>> = most;

template <class T>
inline constexpr bool kIsArray = false;
/// True of arrays of fixed length.
template <class T, std::size_t n>
inline constexpr bool kIsArray<std::array<T, n>> = true;

}  // namespace roboss::ros2
