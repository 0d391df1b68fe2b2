// A list with room for N values inside itself. Unlike std::array of a type that starts at zero, room that is
// not used is neither written nor copied: the narrow phase makes many of them a contact.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace roboss {

template <class T, std::size_t N>
class FixedList {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    // The room is written where it is used. NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
    FixedList() {}
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
    FixedList(const FixedList& other) : size_(other.size_) {
        std::uninitialized_copy(other.begin(), other.end(), begin());
    }
    FixedList& operator=(const FixedList& other) {
        if (this == &other) return *this;
        size_ = other.size_;
        std::uninitialized_copy(other.begin(), other.end(), begin());
        return *this;
    }
    ~FixedList() = default;

    static constexpr std::size_t capacity() { return N; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == N; }
    void clear() { size_ = 0; }

    /// Not on a full list.
    void push_back(const T& value) { std::construct_at(begin() + size_, value), ++size_; }
    void pop_back() { --size_; }

    T* data() { return begin(); }
    const T* data() const { return begin(); }
    T* begin() { return std::launder(reinterpret_cast<T*>(room_.data())); }
    T* end() { return begin() + size_; }
    const T* begin() const { return std::launder(reinterpret_cast<const T*>(room_.data())); }
    const T* end() const { return begin() + size_; }
    T& operator[](std::size_t i) { return begin()[i]; }
    const T& operator[](std::size_t i) const { return begin()[i]; }
    T& back() { return begin()[size_ - 1]; }

  private:
    std::size_t size_ = 0;
    alignas(T) std::array<std::byte, N * sizeof(T)> room_;
};

}  // namespace roboss
