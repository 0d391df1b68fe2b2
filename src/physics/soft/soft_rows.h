// The soft solver's rows: patches of contact points, eight side by side. Plain numbers, filled by code for
// every processor; soft_kernel.h computes with them. docs/how-contacts-are-solved.md explains the method.
#pragma once

#include <cstddef>
#include <vector>

namespace roboss::soft {

/// Numbers of eight patches.
struct alignas(64) Eight {
    double x[8] = {};
};

/// Velocity of a body, or how far it moved since the tick began: of its centre of mass, then its turning w as
/// A^T w, with A A^T the inertia about that centre. So what a torque does to it is A^-1 times the torque. The
/// last two are not used. A robot with joints has as many of these as hold its coordinates (soft_tree.h).
struct alignas(64) Motion {
    double x[8] = {};
};

/// A contact point of each of eight patches: the normal's row. Where a patch has none, all is zero. Patches
/// of robots with joints have their Jacobians in Problem::columns.
struct Point {
    Eight turn_a[3], turn_b[3];  // Jacobian: by the turning of body a, of body b
    Eight gap;                   // m, at the beginning of the tick
    Eight speed;                 // m/s, of the surfaces besides the bodies' motion
    Eight mass;                  // kg, effective
    Eight lever;                 // m: torque about the normal that friction may give, over the normal impulse
    Eight bounce;                // m/s: the speed with which it parts after a blow; 0: it does not bounce
    Eight impulse;               // N s, of the substep
    Eight total;                 // N s, of the tick
};

/// Each of eight patches has these once: the normal, and friction as one force in the plane and one twist
/// about the normal.
struct Patch {
    Eight n[3], t1[3], t2[3];                                  // the normal from b to a, and the tangents
    Eight slide_1a[3], slide_2a[3], slide_1b[3], slide_2b[3];  // of friction, as Point::turn_a
    Eight twist_a[3], twist_b[3];
    Eight inverse_mass_a, inverse_mass_b;  // 1 for robots with joints: their columns hold it
    Eight coefficient, recovery;           // of friction; m/s: of overlaps, at most
    Eight k_11, k_12, k_22, k_twist;       // 1/kg, 1/(kg m^2): mobilities along friction
    Eight speed_1, speed_2, speed_twist;   // of the surfaces, as Point::speed
    Eight slide_1, slide_2, twist;         // impulses of the substep
    Eight total_1, total_2, total_twist;   // of the tick
};

/// Columns of a row at one side: the first six coordinates, and those further along the path of the body that
/// is touched. Of each of eight patches; what a shorter path lacks is a coordinate that is always zero.
struct Path {
    int further = 0;        // columns beyond six, of the longest; at least one
    std::size_t first = 0;  // of Problem::places: the coordinates of these, column by column, eight each
};

/// Eight patches or fewer of one colour: no two have a body in common. A lane that is not used, and the other
/// side of scenery, are a body that never moves.
struct Batch {
    int a[8] = {}, b[8] = {};     // of Problem::velocity
    int patches = 0, points = 0;  // lanes in use; points of the longest
    std::size_t first = 0;        // of Problem::points
    bool scenery = false;         // only side a moves
    bool jointed = false;         // a robot with joints is among them
    // Where it is: of Problem::columns, the rows of the points, of both tangents and of the twist; each has
    // 6 + further columns of side a, then those of side b.
    std::size_t first_column = 0;
    Path path_a, path_b;

    std::size_t columns_a() const { return 6 + static_cast<std::size_t>(path_a.further); }
    std::size_t columns_b() const { return scenery ? 0 : 6 + static_cast<std::size_t>(path_b.further); }
    std::size_t columns() const { return columns_a() + columns_b(); }
};

/// A spring and damper, as the share of a row's mass and impulse that a substep may use (soft step).
struct Softness {
    double rate = 0;  // 1/s: of recovery
    double mass_share = 1, impulse_share = 0;
};

struct Substep {
    double h = 0;        // s
    double elapsed = 0;  // s, since the tick began
    Softness pair, scenery;
};

/// The most columns of a row at one side.
inline constexpr std::size_t kMostColumns = 32;

struct Problem {
    std::vector<Motion> velocity, displacement;  // by body, and one that never moves
    std::vector<Motion> kick;                    // by body: what all but contacts changes in a substep
    std::vector<Motion> free;                    // by body: velocity without the impulses of this substep
    std::vector<Point> points;
    std::vector<Patch> patches;  // by batch
    std::vector<Batch> batches;
    std::vector<Eight> columns;        // of batches with robots with joints
    std::vector<int> places;           // coordinates, as places among the numbers of all bodies
    std::vector<std::size_t> colours;  // first batch of each, and the end
};

}  // namespace roboss::soft
