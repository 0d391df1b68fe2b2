// Contacts of shapes that may meet within the tick but do not touch yet. The plane through the closest points
// at the beginning of the tick is where they meet only if they approach each other head-on: the motion of the
// tick may lead past each other, or to a place with another normal. So the motion itself is swept
// (geometry/time_of_impact.h): a pair that passes is no contact, and a fast pair gets the plane of the
// impact.
#pragma once

#include "geometry/collide_surface.h"
#include "geometry/time_of_impact.h"
#include "physics/contact/contact.h"

namespace roboss {

constexpr double kDeep = 1e-4;  // m: shapes that sink deeper within a tick than its rows say are stopped

constexpr double kFastDisplacement =
    4e-3;                         // m in a tick: less, and the plane of the beginning is near enough
constexpr double kNearly = 1e-4;  // m: what is nearer and not fast along the normal touches
constexpr double kBlow = 1e-3;    // m in a tick, along the normal: fast

/// The motion of a shape of a robot in a tick by the velocities in `robot`: of a lone body, by Euler's
/// equations.
Course course_of(const Mechanics<double>& robot, std::size_t shape, double dt);
/// The same where the angular velocities of bodies stay as they are: that of the explicit step.
Course steady_course_of(const Mechanics<double>& robot, std::size_t shape);
/// That of the kick-drift step: a lone body flies with the velocity `solved`, then it is shifted and turned
/// by the rest of the velocity in `robot`.
Course shifted_course_of(const Mechanics<double>& robot, std::size_t shape, const Spatial& solved, double dt);

enum class Meeting {
    kAtOnce,  // as if the plane of the beginning were the other shape: exact for what touches or moves little
    kInTick,  // at `time`
    kNone     // not by the motion that is known before solving
};

struct SweptPair {
    Meeting meeting = Meeting::kAtOnce;
    double time = 0;  // s
};

/// Whether shapes `gap` apart, which approach each other by at most `displacement` in the tick, may pass:
/// then sweep() has to judge. Quick, for most pairs are slow or touch.
inline bool may_pass(double gap, double displacement) {
    return gap > kImpactGap && (displacement > kFastDisplacement ||
                                (displacement > gap && (gap > kNearly || displacement > kBlow)));
}

inline bool may_pass(const Manifold& manifold, double displacement) {
    return manifold.count > 0 && may_pass(least_gap(manifold), displacement);
}

/// Judges a pair from its manifold at the beginning, which becomes that of the impact.
SweptPair sweep(const Course& a, const Course& b, double dt, double margin, Manifold& manifold);

struct SweepBuffers {
    SurfaceContacts found;            // at the beginning of the tick
    std::vector<SurfaceContact> met;  // at the impact
    SurfaceContacts there;            // on the way to `met`
    std::vector<TouchedPlane> held;
};

/// Judges a shape near a surface from its contacts at the beginning, `buffers.found`. Afterwards these are
/// those that hold from the beginning on, and `buffers.met` those of the impact at time t, if there is one.
SweptPair sweep(const Course& course, const TriangleSurface& surface, const Transform& X_WS, double dt,
                double margin, SweepBuffers& buffers);

/// Whether a contact of the beginning of the tick changes velocities at once.
bool is_blow(std::span<const RobotWork> robots, const Contact& contact, double dt);

/// Rewrites a contact at time t for a solver that knows the beginning of the tick only: the arms from the
/// bodies' origins stay those of the impact, the gap is the distance to it.
void take_back(const Course& a, const Course& b, double t, Contact& contact);

/// buffers.met becomes the contacts of a shape, placed at X_WA, with a surface: all points of the planes in
/// which one is nearer than kDeep, but for the planes buffers.held.
void find_met(const Shape& shape, const Transform& X_WA, const TriangleSurface& surface,
              const Transform& X_WS, double margin, SweepBuffers& buffers);

}  // namespace roboss
