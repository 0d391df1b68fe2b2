// One request, one part, in order: late and duplicate parts and those of an earlier run do not match and are
// dropped.
#include "bus/whole_pull.h"

#include "wire/model_codec.h"

namespace roboss {

void WholePull::advance(Bus& bus, const Address& self, std::int64_t resend_ms) {
    bus.drain(self, inbox_);
    for (const Envelope& envelope : inbox_)
        if (const auto* part = std::get_if<ModelPart>(&envelope.message)) take(*part);
    const std::int64_t now = bus.now_ms();
    if (complete_ || (!ask_now_ && now - asked_ms_ < resend_ms)) return;
    ask_now_ = false;
    asked_ms_ = now;
    bus.send(self, kControllerAddress, ModelRequest{what_, bytes_.size()});
}

void WholePull::take(const ModelPart& part) {
    if (complete_ || part.what != what_) return;
    if (part.bytes_hash != bytes_hash_ || part.total != total_) {  // of other bytes than those begun
        bytes_.clear();
        bytes_hash_ = part.bytes_hash;
        total_ = part.total;
        ask_now_ = true;
    }
    if (part.offset != bytes_.size() || (part.bytes.empty() && total_ > 0)) return;
    bytes_.insert(bytes_.end(), part.bytes.begin(), part.bytes.end());
    ask_now_ = true;
    if (bytes_.size() < total_) return;
    if (hash_of_bytes(bytes_) == bytes_hash_) {
        complete_ = true;
    } else {  // damaged in transit: start again
        bytes_hash_ = 0;
        bytes_.clear();
    }
}

}  // namespace roboss
