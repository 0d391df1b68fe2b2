// WholePull: gets something large (the Model, the scene) from the Controller, part by part. It runs before a
// role: other messages for `self` are dropped meanwhile, and will be sent again.
#pragma once

#include "bus/bus.h"

namespace roboss {

class WholePull {
  public:
    explicit WholePull(Whole what) : what_(what) {}

    /// Handles the messages received and requests what is missing. Never waits.
    void advance(Bus& bus, const Address& self, std::int64_t resend_ms);
    bool complete() const { return complete_; }
    /// The bytes once they are complete; possibly none.
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  private:
    void take(const ModelPart& part);

    Whole what_;
    std::vector<std::uint8_t> bytes_;
    std::uint64_t bytes_hash_ = 0, total_ = 0;
    bool complete_ = false, ask_now_ = true;
    std::int64_t asked_ms_ = 0;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
