// The rows of a contact island: everything that pushes besides inertia and explicit forces, in one form each.
// Over T: of one island (double), or of a few robots of one type that have the same rows, in lanes.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/make_room.h"
#include "core/wide.h"
#include "physics/contact/contact.h"

namespace roboss {

/// Compliances of hard joint rows, of contacts that are new, that bounce and that bear a load, and of their
/// friction, relative to the mobility they act on. Newton's matrix holds their reciprocals beside the masses:
/// floats have no room for the hardest, least of all where rows share their columns, as contacts do.
template <class T>
double hard_compliance(const Accuracy& accuracy) {
    return kIsFloat<T> ? std::max(accuracy.compliance, 1e-6) : accuracy.compliance;
}
template <class T>
double new_compliance(const Accuracy& accuracy) {
    return kIsFloat<T> ? std::max(accuracy.impact_compliance, 1e-4) : accuracy.impact_compliance;
}
template <class T>
double bounce_compliance(const Accuracy& accuracy) {
    return kIsFloat<T> ? std::max(accuracy.compliance, 1e-4) : accuracy.compliance;
}
template <class T>
double loaded_compliance(const Accuracy& accuracy) {
    return kIsFloat<T> ? std::max(accuracy.contact_compliance, 1e-3) : accuracy.contact_compliance;
}

template <class T>
double friction_compliance(const Accuracy& accuracy) {
    return kIsFloat<T> ? std::max(accuracy.friction_compliance, 1e-3) : accuracy.friction_compliance;
}

/// One direction with a bounded impulse: clamp((target - u) / compliance, low, high).
template <class T>
struct BoundedRowT {
    T target{};           // for the velocity
    T position_target{};  // for the displacement of this tick, which corrects violations without adding speed
    T compliance{1}, low{}, high{};
    T position_compliance{};  // for the displacement, if it is larger
    T stiffness{1};           // 1 / compliance, set by the solver
    T u{}, du{};              // velocity along it; per unit step of the line search
    T impulse{};              // solved; before that, of the normals of contacts: what they carried last
    T d{};                    // minus the derivative of the impulse by the velocity
    T d_held{};               // of it, what the Hessian holds
};
using BoundedRow = BoundedRowT<double>;

/// From now on the row is one of the displacement's.
template <class T>
void aim_at_displacement(BoundedRowT<T>& row) {
    row.target = row.position_target;
    row.compliance = larger(row.compliance, row.position_compliance);
}

/// True if the displacement of the tick asks the row for something else than the velocity.
inline bool displaces_otherwise(const BoundedRow& row) {
    return row.position_target != row.target || row.position_compliance > row.compliance;
}

/// Friction in a plane: impulse = (target - u) / compliance, cut to the disc of radius `bound` = coefficient
/// * normal impulse (isotropic Coulomb).
template <class T>
struct FrictionDiscT {
    double coefficient = 0;
    T bound{}, compliance{1};
    T stiffness{1};  // 1 / compliance, set by the solver
    // Compliance besides: it slips (slip_disc.h). Not in lanes.
    double slip_11 = 0, slip_12 = 0, slip_22 = 0;
    T target_1{}, target_2{};
    T u_1{}, u_2{}, du_1{}, du_2{};  // velocity minus target; per unit step of the line search
    T impulse_1{}, impulse_2{};
    T d_11{}, d_12{}, d_22{};           // minus the derivative of the impulses by the velocity
    T d_1n{}, d_2n{};                   // by the normal velocity, where the bound moves with it
    T held_11{}, held_12{}, held_22{};  // what the Hessian holds
    T bound_error{}, relaxation{1};     // of the last update of the bound: what it lacked, the share given
};
using FrictionDisc = FrictionDiscT<double>;

/// Motor, joint friction or limit: a row on one degree of freedom.
template <class T>
struct JointRowT : BoundedRowT<T> {
    int dof = 0;                         // in the contact island
    MotorSetpointT<T>* motor = nullptr;  // that remembers its load
};
using JointRow = JointRowT<double>;

/// One entry of a coupling row's Jacobian.
struct CouplingColumn {
    int dof = 0;  // in the contact island
    double j = 0;
};

/// A row over several degrees of freedom of one robot (gearbox, mimic, closed loop), or of two that a bond
/// joins: u = sum of j * v.
template <class T>
struct CouplingRowT : BoundedRowT<T> {
    std::size_t first = 0, last = 0;     // columns
    MotorSetpointT<T>* motor = nullptr;  // that remembers its load
    RobotId robot;
    bool soft = false;      // a spring, damper or servo that does not outweigh the inertia
    bool equality = false;  // a loop, gearbox or mimic joint that always holds, in both directions
    int loop = -1;          // in RobotType::loops, if it is of one
    int bond = -1;          // among those of the contact island, if it is of one
    /// Per unit of impulse: of a loop on its body B about the robot's origin; of a bond on the other link
    /// about the bond's point.
    SpatialT<T> wrench;
};
using CouplingRow = CouplingRowT<double>;

/// Columns of the contacts' Jacobians: velocity of A against B at the point, along (normal, tangent 1,
/// tangent 2), per unit of one degree of freedom; in an AngularRow: angular velocity. Those of one contact
/// ascend along A's path, then along B's.
template <class T>
struct ContactColumnsT {
    std::vector<int> dof;    // in the contact island
    std::vector<char> base;  // whether it and the next five are those of a free base, with dofs one by one
    std::vector<T> n, t1, t2;

    std::size_t size() const { return count_; }
    /// Adds columns, not set yet. The arrays only ever grow, so that in the long run nothing is filled twice.
    void extend(std::size_t more) {
        count_ += more;
        if (count_ <= dof.size()) return;
        const auto grow = [this](auto& array) {
            make_room(array, count_);
            array.resize(array.capacity());
        };
        grow(dof), grow(base), grow(n), grow(t1), grow(t2);
    }
    void clear() { count_ = 0; }
    /// Columns from `middle` on into those of [first, middle), ascending, one a degree of freedom: a robot in
    /// contact with itself.
    void merge(std::size_t first, std::size_t middle);

  private:
    std::size_t count_ = 0;
};
using ContactColumns = ContactColumnsT<double>;

/// A contact point: normal (low 0, no high) and friction at the point.
template <class T>
struct ContactRowT {
    std::size_t first = 0, last = 0;  // columns
    BoundedRowT<T> normal;
    FrictionDiscT<T> slip;
    T warm_start_max{};  // of its normal impulse, what may count as a load and not as a blow
    bool soft = false;   // a spring and damper
    // The overlap of a soft contact, over dt, that no motion made; the whole at the end of the tick, if it
    // gave no impulse.
    T unsprung{}, overlap{};
    bool joins = false;  // both sides have columns: two robots, or a robot that touches itself
    // It carried a load in the last tick and did not slide; it carried one: probably it does the same now.
    MaskOf<T> sticks{false}, loaded{false};
    double inverse_effective_mass = 1;  // 1/kg: mobility that its compliances are relative to
};
using ContactRow = ContactRowT<double>;

/// Where a contact is on the bodies that it joins, for a solver that moves bodies one by one.
struct ContactPlace {
    int body_a = -1, body_b = -1;  // of their robots; -1: a fixed base, or scenery
    Vec3 arm_a, arm_b;             // from the robots' origins, world axes
    std::array<Vec3, 3> axes;      // normal and tangents, as the columns are along
};

/// Torsional friction about the normal and rolling friction about the tangents, bounded by the normal impulse
/// of a contact of the same island.
template <class T>
struct AngularRowT {
    std::size_t first = 0, last = 0;  // contact columns
    std::size_t contact = 0;          // index of the ContactRow whose normal impulse bounds it
    double torsional = 0;             // m: torque per normal force
    BoundedRowT<T> spin;
    T spin_error{}, spin_relaxation{1};  // as FrictionDisc::bound_error and relaxation
    FrictionDiscT<T> roll;               // coefficient in m
};
using AngularRow = AngularRowT<double>;

/// All rows of one contact island.
template <class T>
struct IslandRowsT {
    std::vector<JointRowT<T>> joints;
    std::vector<CouplingColumn> coupling_columns;
    std::vector<CouplingRowT<T>> couplings;
    ContactColumnsT<T> columns;
    std::vector<ContactRowT<T>> contacts;
    std::vector<AngularRowT<T>> angulars;
    bool keeps_places = false;
    std::vector<ContactPlace> places;  // of the contacts, if they are kept

    void clear() {
        joints.clear(), coupling_columns.clear(), couplings.clear();
        columns.clear(), contacts.clear(), angulars.clear(), places.clear();
    }
};
using IslandRows = IslandRowsT<double>;

/// Rows of one contact; offsets[i] is the first dof of robots[i] in the contact island. Returns true if the
/// way of this tick needs another target than the velocity (a penetration to correct, an impact inside the
/// tick).
bool add_contact_row(const Model& model, const Contact& contact, const SurfacePair& surface,
                     std::span<const RobotWork> robots, std::span<const int> offsets, IslandRows& rows);

/// The row of torsional and rolling friction at the contact added last, if it has any.
void add_angular_row(const Model& model, const Contact& contact, const SurfacePair& surface,
                     std::span<const RobotWork> robots, std::span<const int> offsets, IslandRows& rows);

template <class T>
void ContactColumnsT<T>::merge(std::size_t first, std::size_t middle) {
    const auto for_each = [&](auto&& f) { f(dof), f(base), f(n), f(t1), f(t2); };
    const auto place = [](auto& x, std::size_t at) { return x.begin() + static_cast<std::ptrdiff_t>(at); };
    for (std::size_t c = middle; c < size();) {
        const auto found = std::lower_bound(place(dof, first), place(dof, middle), dof[c]);
        const auto k = static_cast<std::size_t>(found - dof.begin());
        if (k < middle && dof[k] == dof[c]) {
            n[k] += n[c], t1[k] += t1[c], t2[k] += t2[c];
            for_each([&](auto& x) { std::copy(place(x, c + 1), place(x, count_), place(x, c)); });
            --count_;
        } else {
            for_each([&](auto& x) { std::rotate(place(x, k), place(x, c), place(x, c + 1)); });
            ++middle, ++c;
        }
    }
}

}  // namespace roboss
