// Contacts of free bodies by soft substeps: the tick is cut into a few substeps, in each of which the normals
// of all contacts are solved once with their overlaps pushed out by a spring and damper, bodies move, and
// normals and friction are solved once without. Pairs that share no body go side by side (soft_batches.h). A
// fixed number of passes, no sum over pairs, no test for convergence: so no bit depends on lanes, threads, or
// other robots. After Erin Catto's soft step ("Solver2D", 2024); docs/decisions/0047-soft-contacts.md.
#pragma once

#include <span>
#include <vector>

#include "core/team.h"
#include "physics/contact/contact.h"
#include "physics/dynamics/integrate.h"
#include "physics/soft/soft_batches.h"
#include "physics/soft/soft_body.h"
#include "physics/soft/soft_kernel.h"

namespace roboss::soft {

inline constexpr int kSubsteps = 4;  ///< of a tick

/// Robots of a contact island, and their contacts in the order of their first robots.
struct Island {
    const Model& model;
    std::span<RobotWork> robots;             // of the group
    std::span<const std::uint32_t> members;  // of the island, ascending
    std::span<Contact* const> contacts;
    std::span<const SurfacePair> surfaces;  // of these
};

/// True where the accuracy leaves robots that touch each other to soft substeps, and these can solve all
/// members.
bool can_solve(const Model& model, std::span<const RobotWork> robots, std::span<const std::uint32_t> members);
/// True for contacts of the same shapes with one normal.
bool are_of_one_patch(const Contact& a, const Contact& b);
/// True for a contact of two robots, or with scenery, that soft substeps can solve. On triangles they would
/// leave bodies trembling: where an edge of a body rests on an edge of a mesh, the point comes and goes as it
/// moves.
bool can_solve(const Model& model, const Contact& contact, const SurfacePair& surface);

/// The start of a pair of shapes, by the last tick.
struct Start {
    double fresh_load = 0;  // N s, of each point that is new
    double steady = 0;      // what the last tick ended with, of its sum over the substeps
    Vec3 lost;              // N s on side A: friction of points that are gone, as it ended
};

class Solver {
  public:
    /// Takes the island at the beginning of the tick. False: a member is no rigid body of finite size.
    bool take(const Island& island);
    /// Finds what contacts do in the tick; the team's threads share the work.
    void solve(const Island& island, const Team& team);
    /// Marks the robots that contacts push.
    void mark_pushed();
    /// Writes the impulses into the contacts: `impulse` and `friction` are those of the tick, `load` is what
    /// the last substep gave, times their number. Where a load grows, that is more than the impulse.
    void give_impulses(const Island& island) const;
    /// Velocities at the end of the tick and displacements over dt, from `offsets` on (by robot of the
    /// group).
    void give_motion(const Island& island, std::span<const int> offsets, std::span<double> velocity,
                     std::span<double> displacement) const;
    /// Moves the robots by the tick. What no contact pushes flies freely.
    void move(const Island& island, FreeBuffer& buffer);

  private:
    bool flies(std::size_t body) const;
    void list_pairs(const Island& island);
    void fill_batch(const Island& island, std::size_t batch);
    void fill(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
              const Batch& batch, Patch& patch);
    void fill_friction(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
                       const Batch& batch, Patch& patch);
    void run(Pass pass, const Team& team);
    void give(const Island& island, const Pair& pair, std::size_t lane, const Batch& batch,
              const Patch& patch) const;
    const Pair& pair_at(std::size_t batch, std::size_t lane) const {
        return pairs_[batches_.order()[batches_.first_pairs()[batch] + lane]];
    }

    std::vector<Body> bodies_;
    std::vector<int> body_of_;  // by robot of the group; -1: it does not move
    std::vector<Pair> pairs_;
    Batches batches_;
    Problem problem_;
    Substep substep_;
};

}  // namespace roboss::soft
