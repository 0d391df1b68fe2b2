// ModelPull: gets the Model from the Controller, part by part, so that who joins needs neither file nor
// compiler. It stands before the role: what else comes for `self` meanwhile will be said again.
#pragma once

#include <optional>
#include <string>

#include "bus/bus.h"
#include "core/result.h"
#include "model/model.h"

namespace roboss {

class ModelPull {
  public:
    using Outcome = Result<std::shared_ptr<const Model>>;

    /// Handles what has come and asks for what is missing. Never waits.
    void advance(Bus& bus, const Address& self, std::int64_t resend_ms);
    /// Nothing as long as it is under way; then the Model, or why it cannot be used.
    const std::optional<Outcome>& model() const { return model_; }
    std::uint64_t bytes_here() const { return bytes_.size(); }

  private:
    void take(const ModelPart& part);

    std::vector<std::uint8_t> bytes_;
    std::uint64_t bytes_hash_ = 0, total_ = 0;
    std::optional<Outcome> model_;
    bool ask_now_ = true;
    std::int64_t asked_ms_ = 0;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
