// Fibers by POSIX contexts (makecontext(3)).
#include "cluster/fiber.h"

#include <cstdint>
#include <stdexcept>
#include <utility>

namespace roboss::bench {
namespace {

constexpr std::size_t kStackBytes = std::size_t{1} << 20;

}  // namespace

void Fiber::enter(unsigned low, unsigned high) {
    auto* self = reinterpret_cast<Fiber*>(std::uintptr_t{low} | std::uintptr_t{high} << 32);
    try {
        self->work_();
    } catch (...) {
        self->thrown_ = std::current_exception();
    }
    self->under_way_ = false;
}

void Fiber::begin(std::function<void()> work) {
    stack_.resize(kStackBytes);
    work_ = std::move(work);
    if (getcontext(&there_) != 0) throw std::runtime_error("this system has no contexts (getcontext)");
    there_.uc_stack.ss_sp = stack_.data();
    there_.uc_stack.ss_size = stack_.size();
    there_.uc_link = &here_;
    const auto self = reinterpret_cast<std::uintptr_t>(this);
    makecontext(&there_, reinterpret_cast<void (*)()>(&Fiber::enter), 2, static_cast<unsigned>(self),
                static_cast<unsigned>(self >> 32));
    under_way_ = true;
    go_on();
}

void Fiber::go_on() {
    swapcontext(&here_, &there_);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void Fiber::pause() {
    swapcontext(&there_, &here_);
}

}  // namespace roboss::bench
