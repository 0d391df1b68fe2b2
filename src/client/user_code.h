// Which control program runs now, so that a crash can name it.
#pragma once

#include <string>

namespace roboss {

/// While one lives, code of this control program runs on this thread. They nest.
class UserCode {
  public:
    /// `program` must outlive it; `what` is a literal: "control()".
    UserCode(const std::string& program, const char* what);
    UserCode(const UserCode&) = delete;
    UserCode& operator=(const UserCode&) = delete;
    ~UserCode();

    /// What runs on this thread now; null: none. Safe to call in a signal handler.
    static const UserCode* running();
    const char* program() const { return program_; }  ///< its name as a Client: the path of its library
    const char* what() const { return what_; }        ///< the function that was called

  private:
    const char* program_;
    const char* what_;
    const UserCode* outer_;
};

}  // namespace roboss
