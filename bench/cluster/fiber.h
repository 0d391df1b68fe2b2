// Fiber: work that can stop halfway and be resumed later, on one thread.
#pragma once

#include <ucontext.h>

#include <exception>
#include <functional>
#include <vector>

namespace roboss::bench {

class Fiber {
  public:
    Fiber() = default;
    Fiber(const Fiber&) = delete;
    Fiber& operator=(const Fiber&) = delete;

    /// Begins this work; returns when it is done or pauses. Not while another is under way. What it throws is
    /// thrown here.
    void begin(std::function<void()> work);
    void go_on();
    /// Of the work itself: goes back to who began it, or went on with it.
    void pause();
    bool under_way() const { return under_way_; }

  private:
    static void enter(unsigned low, unsigned high);

    std::vector<char> stack_;
    std::function<void()> work_;
    ucontext_t here_{}, there_{};
    bool under_way_ = false;
    std::exception_ptr thrown_;
};

}  // namespace roboss::bench
