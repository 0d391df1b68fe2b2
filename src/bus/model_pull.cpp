// Fetches the bytes and decodes the Model.
#include "bus/model_pull.h"

#include "wire/model_codec.h"

namespace roboss {

void ModelPull::advance(Bus& bus, const Address& self, std::int64_t resend_ms) {
    pull_.advance(bus, self, resend_ms);
    if (pull_.complete() && !model_) model_ = decode_model(pull_.bytes());
}

}  // namespace roboss
