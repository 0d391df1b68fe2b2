// One request, one part, in order: whatever comes late, twice or from an earlier run does not fit and is
// dropped.
#include "bus/model_pull.h"

#include "wire/model_codec.h"

namespace roboss {

void ModelPull::advance(Bus& bus, const Address& self, std::int64_t resend_ms) {
    bus.drain(self, inbox_);
    for (const Envelope& envelope : inbox_)
        if (const auto* part = std::get_if<ModelPart>(&envelope.message)) take(*part);
    const std::int64_t now = bus.now_ms();
    if (model_ || (!ask_now_ && now - asked_ms_ < resend_ms)) return;
    ask_now_ = false;
    asked_ms_ = now;
    bus.send(self, kControllerAddress, ModelRequest{bytes_.size()});
}

void ModelPull::take(const ModelPart& part) {
    if (model_) return;
    if (part.bytes_hash != bytes_hash_ || part.total != total_) {  // another Model than the one begun
        bytes_.clear();
        bytes_hash_ = part.bytes_hash;
        total_ = part.total;
        ask_now_ = true;
    }
    if (part.offset != bytes_.size() || part.bytes.empty()) return;
    bytes_.insert(bytes_.end(), part.bytes.begin(), part.bytes.end());
    ask_now_ = true;
    if (bytes_.size() < total_) return;
    if (hash_of_bytes(bytes_) == bytes_hash_) {
        model_ = decode_model(bytes_);
    } else {  // damaged on the way: once more
        bytes_hash_ = 0;
        bytes_.clear();
    }
}

}  // namespace roboss
