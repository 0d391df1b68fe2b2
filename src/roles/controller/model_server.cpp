// Encodes on the first request, then hands out slices.
#include "roles/controller/model_server.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "wire/model_codec.h"

namespace roboss {

namespace {
constexpr std::uint64_t kPartBytes = 1u << 20;
}

ModelServer::ModelServer(std::shared_ptr<const Model> model, SceneOf scene, SceneOf visuals,
                         std::vector<std::uint64_t> earlier)
    : model_(std::move(model)),
      scene_(std::move(scene)),
      visuals_(std::move(visuals)),
      earlier_(std::move(earlier)) {
    ROBOSS_CHECK(model_ != nullptr, "a ModelServer needs a Model");
}

bool ModelServer::is_earlier(std::uint64_t model_hash) const {
    return model_hash != model_->hash &&
           std::find(earlier_.begin(), earlier_.end(), model_hash) != earlier_.end();
}

std::vector<std::uint64_t> ModelServer::hashes() const {
    std::vector<std::uint64_t> hashes = earlier_;
    std::erase(hashes, model_->hash);
    hashes.push_back(model_->hash);
    return hashes;
}

const ModelServer::WholeBytes& ModelServer::whole(Whole what) {
    const auto [kept, is_new] = bytes_.try_emplace(what);
    if (is_new) {
        WholeBytes& made = kept->second;
        if (what == Whole::kModel) made.bytes = encode_model(*model_);
        if (what == Whole::kScene && scene_) made.bytes = scene_(*model_);
        if (what == Whole::kVisuals && visuals_) made.bytes = visuals_(*model_);
        made.hash = hash_of_bytes(made.bytes);
    }
    return kept->second;
}

ModelPart ModelServer::part(const ModelRequest& request) {
    const WholeBytes& all = whole(request.what);
    const std::uint64_t total = all.bytes.size(), offset = std::min(request.offset, total);
    const auto first = all.bytes.begin() + static_cast<std::ptrdiff_t>(offset);
    const auto count = static_cast<std::ptrdiff_t>(std::min(kPartBytes, total - offset));
    return {request.what, all.hash, total, offset, {first, first + count}};
}

}  // namespace roboss
