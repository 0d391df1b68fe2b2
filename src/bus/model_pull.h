// ModelPull: gets the Model from the Controller, so that a joining process needs neither file nor compiler.
// It runs before the role: other messages for `self` are dropped meanwhile, and will be sent again.
#pragma once

#include <optional>
#include <string>

#include "bus/whole_pull.h"
#include "core/result.h"
#include "model/model.h"

namespace roboss {

class ModelPull {
  public:
    using Outcome = Result<std::shared_ptr<const Model>>;

    /// Handles the messages received and requests what is missing. Never waits.
    void advance(Bus& bus, const Address& self, std::int64_t resend_ms);
    /// Empty until it is complete; then the Model, or why it cannot be used.
    const std::optional<Outcome>& model() const { return model_; }
    std::uint64_t bytes_here() const { return pull_.bytes().size(); }

  private:
    WholePull pull_{Whole::kModel};
    std::optional<Outcome> model_;
};

}  // namespace roboss
