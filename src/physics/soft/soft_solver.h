// Contacts of free bodies and robots with joints by soft substeps: the tick is cut into a few substeps, in
// each of which the normals of all contacts are solved once with their overlaps pushed out by a spring and
// damper, bodies move, and normals and friction are solved once without. Pairs that share no body go side by
// side (soft_batches.h). A fixed number of passes, no sum over pairs, no test for convergence: so no bit
// depends on lanes, threads, or other robots. After Erin Catto's soft step ("Solver2D", 2024);
// docs/decisions/0047-soft-contacts.md.
#pragma once

#include <span>
#include <vector>

#include "core/team.h"
#include "physics/contact/contact.h"
#include "physics/contact/contact_rows.h"
#include "physics/dynamics/integrate.h"
#include "physics/soft/soft_batches.h"
#include "physics/soft/soft_body.h"
#include "physics/soft/soft_joints.h"
#include "physics/soft/soft_kernel.h"
#include "physics/soft/soft_tree.h"

namespace roboss::soft {

inline constexpr int kSubsteps = 4;  ///< of a tick

/// Robots of a contact island, and their contacts in the order of their first robots.
struct Island {
    const Model& model;
    std::span<RobotWork> robots;             // of the group
    std::span<const std::uint32_t> members;  // of the island, ascending
    std::span<Contact* const> contacts;
    std::span<const SurfacePair> surfaces;  // of these
    // Of robots with joints, whose impulses and mass matrices are computed: the rows of their joints, in the
    // order of the members, and by robot of the group its first degree of freedom there.
    std::span<JointRow> joints;
    std::span<const int> offsets;
};

/// True where the accuracy leaves robots that touch each other to soft substeps, and these can solve all
/// members.
bool can_solve(const Model& model, std::span<const RobotWork> robots, std::span<const std::uint32_t> members);
/// True for contacts of the same shapes with one normal.
bool are_of_one_patch(const Contact& a, const Contact& b);
/// True for a contact that soft substeps can solve. On triangles they would
/// leave bodies trembling: where an edge of a body rests on an edge of a mesh, the point comes and goes as it
/// moves.
bool can_solve(const Model& model, const Contact& contact, const SurfacePair& surface);

/// The start of a pair of shapes, by the last tick.
struct Start {
    double fresh_load = 0;  // N s, of each point that is new
    double steady = 0;      // what the last tick ended with, of its sum over the substeps
    Vec3 lost;              // N s on side A: friction of points that are gone, as it ended
};

/// A side of a pair in which a robot with joints is.
struct JointedSide {
    const RobotWork* robot = nullptr;
    const Body* free = nullptr;  // a free body, or
    const Tree* tree = nullptr;
    TreePath path;
    int slot = -1, body = -1;
    double inverse_mass = 0;
};
struct JointedPair {
    JointedSide a, b;
    bool swapped = false, itself = false;  // as Pair
};
struct JointedRow {
    TreeRow a, b;
};
/// J_x M^-1 J_y^T
double product(const JointedRow& x, const JointedRow& y, const JointedPair& pair);

class Solver {
  public:
    /// Takes the members at the beginning of the tick. False: one is no rigid body of finite size.
    bool take(const Island& island);
    /// After that, and whenever the contacts changed.
    void take_contacts(const Island& island);
    /// Finds what contacts do in the tick; the team's threads share the work.
    void solve(const Island& island, const Team& team);
    /// Marks the robots that contacts push.
    void mark_pushed(const Island& island);
    /// Writes the impulses into the contacts: `impulse` and `friction` are those of the tick, `load` is what
    /// the last substep gave, times their number. Where a load grows, that is more than the impulse. Also
    /// into the rows of joints.
    void give_impulses(const Island& island) const;
    /// Velocities at the end of the tick and displacements over dt, from `offsets` on (by robot of the
    /// group).
    void give_motion(const Island& island, std::span<const int> offsets, std::span<double> velocity,
                     std::span<double> displacement) const;
    /// True if something bounces that was hit.
    bool bounces() const { return bounces_; }
    /// True if robots are so deep in each other that pushing them out may throw something that is jammed.
    bool is_deep() const { return deep_; }
    /// For robots with joints that `drifts` (by member) gives the kick-drift step: adds what contacts gave
    /// them in the tick, and sets the displacement, which is the velocity but for contacts; both by degree of
    /// freedom of the group.
    void prepare_drift(const Island& island, std::span<const char> drifts, std::span<double> kick,
                       std::span<double> displacement) const;
    /// Moves the free bodies by the tick. What no contact pushes flies freely.
    void move(const Island& island, FreeBuffer& buffer);

  private:
    struct NormalRow {
        double mobility = 0, approach = 0;
    };
    struct FrictionRows {
        double k_11 = 0, k_12 = 0, k_22 = 0, k_twist = 0;
    };
    bool flies(std::span<const double> start, std::size_t slot) const;
    bool take_trees(const Island& island);
    void list_pairs(const Island& island);
    int slot_of(int robot, int body) const;
    void start(const Island& island, const Team& team);
    void start_tree(const Tree& tree);
    // soft_fill.cpp
    void fill_batch(const Island& island, std::size_t batch);
    void fill(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
              const Batch& batch, Patch& patch);
    NormalRow put_normal(const Pair& pair, const Vec3& n, const Contact& c, std::size_t lane,
                         Point& point) const;
    void fill_friction(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
                       const Batch& batch, Patch& patch);
    FrictionRows put_friction(const Pair& pair, const Contact& first, const ContactFrame& frame,
                              std::size_t lane, Patch& patch) const;
    // soft_pair.cpp
    double inverse_mass(int slot) const;
    JointedSide jointed_side(int slot, const RobotWork& robot, int body, int other) const;
    JointedPair jointed_pair(const Island& island, const Pair& pair) const;
    void set_row(const JointedPair& pair, const Push& push, const Vec3& shift_b, JointedRow& row) const;
    double approach_of(const JointedPair& pair, const Vec3& n, const Contact& c) const;
    void clear_columns(const Batch& batch);
    bool is_full(std::size_t batch) const;
    void put_places(const JointedPair& pair, std::size_t lane, const Batch& batch);
    void put_columns(const JointedRow& row, const JointedPair& pair, std::size_t k, std::size_t lane,
                     const Batch& batch);
    FrictionRows put_jointed_friction(const Pair& pair, const Contact& first, const ContactFrame& frame,
                                      std::size_t lane, const Batch& batch);

    void run(Pass pass, const Team& team);
    void give(const Island& island, const Pair& pair, std::size_t lane, const Batch& batch,
              const Patch& patch) const;
    const Pair& pair_at(std::size_t batch, std::size_t lane) const {
        return pairs_[batches_.order()[batches_.first_pairs()[batch] + lane]];
    }

    std::vector<Body> bodies_;
    std::vector<Tree> trees_;
    std::vector<std::size_t> tree_of_;  // by place in Problem::velocity behind the bodies
    std::vector<double> roots_;         // Tree::root
    std::vector<int> slots_;            // by robot of the group: of Problem::velocity; -1: it does not move
    Joints joints_;
    std::vector<Pair> pairs_;
    std::vector<JointedPair> jointed_;
    Batches batches_;
    Problem problem_;
    Substep substep_;
    bool bounces_ = false, deep_ = false;
};

}  // namespace roboss::soft
