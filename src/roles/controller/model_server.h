// ModelServer: serves the run's encoded Model, the scene for viewers and the visuals for cameras, all of any
// size, in parts. It also knows the Models that the run had before (a rewind may change the world), so that
// members that still have one of these fetch the current Model instead of being refused.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "wire/message.h"

namespace roboss {

class ModelServer {
  public:
    using SceneOf = std::function<std::vector<std::uint8_t>(const Model&)>;

    /// `scene` and `visuals` make the bytes, and are called at the first request; they may be empty.
    /// `earlier`: hashes of earlier Models of the run.
    ModelServer(std::shared_ptr<const Model> model, SceneOf scene, SceneOf visuals,
                std::vector<std::uint64_t> earlier);

    /// The part that this request asks for; empty from the end of the bytes on.
    ModelPart part(const ModelRequest& request);
    /// The run had this Model before, and has another one now.
    bool is_earlier(std::uint64_t model_hash) const;
    /// Hashes of all Models of the run, the current one last.
    std::vector<std::uint64_t> hashes() const;

  private:
    struct WholeBytes {
        std::vector<std::uint8_t> bytes;
        std::uint64_t hash = 0;
    };
    const WholeBytes& whole(Whole what);

    std::shared_ptr<const Model> model_;
    SceneOf scene_, visuals_;
    std::vector<std::uint64_t> earlier_;
    std::map<Whole, WholeBytes> bytes_;  // made at the first request
};

}  // namespace roboss
