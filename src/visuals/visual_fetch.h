// The visuals of a run whose world file is elsewhere: a Client of a cluster fetches them from the Controller
// when its first camera is read, and computes the same images from them, bit for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "bus/bus.h"
#include "render/visuals_of.h"

namespace roboss {

/// What cameras see, of the bytes that the Controller sends (Whole::kVisuals). Errors: "no-look", there are
/// no bytes; those of decode_scene().
Result<std::shared_ptr<const render::VisualWorld>> visual_world(std::span<const std::uint8_t> bytes,
                                                                const Model& model);

/// How a fetch waits.
struct VisualFetch {
    Bus& bus;                              ///< where the Controller is; must outlive the function below
    std::function<Address()> new_address;  ///< of this process, never used before
    std::function<Result<>()> wait;        ///< until a message may have come; an Error gives up
};

/// Fetches, and waits for it. Errors: "no-controller", it sends nothing for half a minute; those of `wait`
/// and of visual_world().
render::VisualsOf fetched_visuals(VisualFetch fetch);

}  // namespace roboss
