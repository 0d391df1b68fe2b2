// Sleep: robots at rest cost nothing and do not change a bit of their state, deterministically.
//
// A contact island falls asleep as a whole when each of its robots has been at rest for half a second: no
// point of it faster than 1 mm/s, no joint than 0.01 rad/s (or m/s), something holds it (a contact, a motor,
// a limit: not a pendulum at its turning point), no timed wrench, and no motor that still works against
// something (a servo that stands still off its target, drooping or stopped, rests), and nothing that it
// touches has a surface in motion: what rides on a belt is not at rest. Both its velocity and what the tick
// moved it by must be as slow: penetration recovery, bonds and guards move robots whose velocity is zero. A
// joint that dampers slow down counts with the speed that it would gain within the half second without them.
// Where a contact recovers more slowly than 2 mm/s, half of its speed counts instead of 1 mm/s. The
// velocities then become exactly zero, which takes at most half a microjoule a kilogram. Each sleeper keeps
// its interaction bound and the robots that it touches (frozen edges).
//
// A sleeper wakes, before the tick is solved, by an order (apply_order), by an awake robot that touches it or
// comes to within 2 mm of it while moving, and when a robot that it touched, or was bonded with, is awake or
// not in the call. The last cannot be told apart by who is in the call: robots that touch, or are bonded,
// have bounds that overlap, so they are always stepped together, unless an order has taken one of them away.
// So the rest of the argument in ARCHITECTURE.md ("Why the bits are equal") holds.
#pragma once

#include <span>
#include <vector>

#include "physics/contact/contact.h"
#include "physics/contact/surface_pair.h"

namespace roboss {

inline constexpr double kRestSpeed = 1e-3;  // m/s: no point of a robot at rest is faster

/// Whether a robot so wakes sleepers that it touched. One that is fixed to the world never sleeps; it counts
/// when ordered, and while its surfaces move.
inline bool wakes_neighbours(const RobotType& type, const RobotState& state, bool asleep, bool ordered) {
    return type.nv == 0 ? ordered || !state.surfaces.empty() : !asleep;
}

struct HeldBond;

/// Buffers of the search for sleepers to wake.
struct WakeBuffers {
    std::vector<std::uint32_t> place_of;  // by RobotId: index in the call, if that robot is there
    std::vector<std::uint32_t> stack;
    std::vector<Contact> contacts;
};

/// Wakes the sleepers of which a neighbour is gone or awake, and all that are joined to them.
void wake_left(const Model& model, std::span<RobotWork> robots, WakeBuffers& buffers);

/// Wakes the sleepers that an awake robot touches, and so on; `finder` knows the pairs of robots, before and
/// afterwards.
void wake_touched(const Model& model, std::span<RobotWork> robots, ContactFinder& finder,
                  WakeBuffers& buffers);

/// Wakes a sleeper and all that are joined to it.
void wake_sleeper(const Model& model, std::span<RobotWork> robots, std::uint32_t sleeper,
                  WakeBuffers& buffers);

/// Counts the ticks that the robots of a contact island have been at rest, and puts it to sleep when all are.
/// `members` index `robots`, placed as they were at the beginning of the tick; `contacts` are the island's,
/// solved, with their `surfaces`, and `bonds` those that join its robots. Overwrites `buffer`.
void settle_island(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                   std::span<Contact* const> contacts, std::span<const SurfacePair> surfaces,
                   std::span<const HeldBond> bonds, RobotWork& buffer);

}  // namespace roboss
