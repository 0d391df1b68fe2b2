// The columns of a row that a database gives, by type: bad values are noticed once, at the end.
#pragma once

#include <charconv>
#include <optional>
#include <string>

#include "core/types.h"
#include "journal/database.h"

namespace roboss {

/// The columns of a row, by type; remembers a fault if one is not as expected.
class Columns {
  public:
    explicit Columns(const Row& row) : row_(row) {}
    template <class T>
    T get() {
        if (at_ < row_.size())
            if (const T* value = std::get_if<T>(&row_[at_++])) return *value;
        good_ = false;
        return T{};
    }
    std::int64_t number() { return get<std::int64_t>(); }
    std::uint64_t hash() {
        const auto text = get<std::string>();
        std::uint64_t value = 0;
        const auto end = text.data() + text.size();
        if (text.size() != 16 || std::from_chars(text.data(), end, value, 16).ptr != end) good_ = false;
        return value;
    }
    std::optional<std::uint64_t> hash_or_null() {
        const bool null = at_ < row_.size() && row_[at_] == Value(Blob{});
        return null ? (++at_, std::nullopt) : std::optional(hash());
    }
    bool good() const { return good_; }

  private:
    const Row& row_;
    std::size_t at_ = 0;
    bool good_ = true;
};

inline std::string at_tick(Tick tick) {
    return "at tick " + std::to_string(tick);
}

}  // namespace roboss
