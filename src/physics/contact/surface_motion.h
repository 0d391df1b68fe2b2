// Surfaces that move along their shapes: belts, tracks, turntables, and the surfaces of kinematic bodies. How
// fast they are at a contact, on top of what the bodies move by themselves.
#pragma once

#include <optional>
#include <span>

#include "physics/contact/contact.h"

namespace roboss {

/// The flow of a shape's surface of a robot; nullopt: it does not move.
std::optional<SurfaceFlow> flow_of(const RobotWork& robot, std::uint32_t shape);

/// The flow of a shape of the scenery, which the robot that drives it may have among `robots` (ascending by
/// id).
std::optional<SurfaceFlow> flow_of(std::span<const RobotWork> robots, const StaticShape& scenery);

/// The robot among `robots` that drives the scenery's surface; nullptr: none is there.
const RobotWork* driver_of(std::span<const RobotWork> robots, const StaticShape& scenery);

/// Sets what of `pair` comes from the motion of both surfaces.
void add_motion(const Model& model, std::span<const RobotWork> robots, const Contact& contact,
                SurfacePair& pair);

/// Adds to `pair` what keeps a free body on the circle of a link that carries it by friction. The link turns
/// about its joints (and its base's origin) within the tick, the body moves straight: its target is the
/// velocity along the chord. For links of robots with motors, and contacts that bore a load in the last tick.
void add_carrying(const Model& model, std::span<const RobotWork> robots, const Contact& contact,
                  SurfacePair& pair);

/// Whether a robot of the contact, or the one that drives its scenery, has a surface in motion.
bool has_motion(const Model& model, std::span<const RobotWork> robots, const Contact& contact);

}  // namespace roboss
