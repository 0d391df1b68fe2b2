// Result<T>: a value, or one Error with a message that names the thing and the remedy. For the outside world:
// files, network, users. World files report through Diagnostics instead (all findings at once). Programs and
// tests compare the code; messages are for people.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "core/check.h"

namespace roboss {

struct Error {
    std::string message;  // what went wrong, with names and values
    std::string remedy;   // what the user can do about it
    std::string code{};   // names the kind of error, as "no-branch"; empty: none is assigned
    std::string text() const {
        return message + (code.empty() ? "" : " [" + code + "]") +
               (remedy.empty() ? "" : "\n  remedy: " + remedy);
    }
};

struct Ok {};

template <class T = Ok>
class [[nodiscard]] Result {
  public:
    Result(T value) : data_(std::move(value)) {}
    Result(Error error) : data_(std::move(error)) {}

    bool ok() const { return std::holds_alternative<T>(data_); }
    explicit operator bool() const { return ok(); }
    const T& value() const& { return check(), std::get<T>(data_); }
    T& value() & { return check(), std::get<T>(data_); }
    T&& value() && { return check(), std::get<T>(std::move(data_)); }
    const Error& error() const { return std::get<Error>(data_); }

  private:
    void check() const { ROBOSS_CHECK(ok(), error().text()); }
    std::variant<T, Error> data_;
};

}  // namespace roboss
