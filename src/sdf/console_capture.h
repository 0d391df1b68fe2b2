// ConsoleCapture: while it lives, what libsdformat and urdfdom print goes into a string instead of the
// terminal. Both print through process-wide streams, so captures exclude each other: only one thread is
// inside libsdformat at a time.
#pragma once

#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace roboss::sdf_import {

struct ConsoleLine {
    bool is_error = false;
    std::string text;  // without colours and without the library's own source position
};

class ConsoleCapture {
  public:
    ConsoleCapture();
    ~ConsoleCapture();
    ConsoleCapture(const ConsoleCapture&) = delete;
    ConsoleCapture& operator=(const ConsoleCapture&) = delete;

    std::vector<ConsoleLine> lines() const;

  private:
    std::lock_guard<std::mutex> alone_;  // released last
    std::ostringstream captured_;
    std::ostream* console_before_ = nullptr;
    std::streambuf* cerr_before_ = nullptr;
    std::streambuf* cout_before_ = nullptr;
};

}  // namespace roboss::sdf_import
