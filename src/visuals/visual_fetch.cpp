// See visual_fetch.h.
#include "visuals/visual_fetch.h"

#include "bus/whole_pull.h"
#include "scene/scene_codec.h"
#include "visuals/visual_source.h"

namespace roboss {
namespace {

constexpr std::int64_t kAgain_ms = 250, kSilence_ms = 30'000;

Result<std::vector<std::uint8_t>> fetch_bytes(const VisualFetch& from) {
    const Address self = from.new_address();
    WholePull pull(Whole::kVisuals);
    std::size_t here = 0;
    std::int64_t grown_ms = from.bus.now_ms();
    for (pull.advance(from.bus, self, kAgain_ms); !pull.complete(); pull.advance(from.bus, self, kAgain_ms)) {
        if (Result<> waited = from.wait(); !waited) return waited.error();
        const std::int64_t now = from.bus.now_ms();
        if (pull.bytes().size() != here) here = pull.bytes().size(), grown_ms = now;
        if (now - grown_ms > kSilence_ms)
            return Error{"the Controller sends no visuals for cameras for " +
                             std::to_string(kSilence_ms / 1000) + " s",
                         "see whether it still runs", "no-controller"};
    }
    return pull.bytes();
}

}  // namespace

Result<std::shared_ptr<const render::VisualWorld>> visual_world(std::span<const std::uint8_t> bytes,
                                                                const Model& model) {
    if (bytes.empty())
        return Error{"cameras render the visuals of a world, and the Controller of this run has none",
                     "start the Controller with the world file, its meshes and its pictures in place",
                     "no-look"};
    Result<Scene> scene = decode_scene(bytes, model);
    if (!scene) return scene.error();
    return visual_world(scene.value(), model);
}

render::VisualsOf fetched_visuals(VisualFetch fetch) {
    return
        [fetch = std::move(fetch)](const Model& model) -> Result<std::shared_ptr<const render::VisualWorld>> {
            const Result<std::vector<std::uint8_t>> bytes = fetch_bytes(fetch);
            if (!bytes) return bytes.error();
            return visual_world(bytes.value(), model);
        };
}

}  // namespace roboss
