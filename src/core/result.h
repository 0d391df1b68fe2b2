// Result<T>: a value, or one Error with a message that names the thing and the remedy. For the outside world:
// files, network, users. World files report through Diagnostics instead (all findings at once). Programs and
// tests compare the code; messages are for people.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "core/check.h"

namespace roboss {

/// Why something failed.
struct Error {
    std::string message;  ///< what went wrong, with names and values
    std::string remedy;   ///< what the user can do about it
    std::string code{};   ///< names the kind of error, as "no-branch"; empty: none is assigned
    /// "message [code]", and the remedy on a second line, each if there is one.
    std::string text() const {
        return message + (code.empty() ? "" : " [" + code + "]") +
               (remedy.empty() ? "" : "\n  remedy: " + remedy);
    }
};

/// The value of a Result that has none but success.
struct Ok {};

/// A value or an Error. Asking for the value of a failed Result aborts: ask ok() first.
template <class T = Ok>
class [[nodiscard]] Result {
  public:
    /// Success.
    Result(T value) : data_(std::move(value)) {}
    /// Failure.
    Result(Error error) : data_(std::move(error)) {}

    /// Whether it holds a value.
    bool ok() const { return std::holds_alternative<T>(data_); }
    /// The same as ok().
    explicit operator bool() const { return ok(); }
    /// The value; aborts with the Error's text if there is none.
    const T& value() const& { return check(), std::get<T>(data_); }
    /// The value, which the caller may change; aborts if there is none.
    T& value() & { return check(), std::get<T>(data_); }
    /// The value to move from; aborts if there is none.
    T&& value() && { return check(), std::get<T>(std::move(data_)); }
    /// The Error; only of a failed Result (else std::bad_variant_access).
    const Error& error() const { return std::get<Error>(data_); }

  private:
    void check() const { ROBOSS_CHECK(ok(), error().text()); }
    std::variant<T, Error> data_;
};

}  // namespace roboss
