// Motion that nothing touches: here a simulator can be exact, so small bounds hold.
#include <cmath>

#include <support/bodies.h>
#include <support/reference/hinge_chain.h>
#include <support/reference/tumbling_body.h>
#include <support/robots.h>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

using test::Real;

test::RealVec3 widened(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Vec3 narrowed(const test::RealVec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The block thrown, turning about its middle axis, the unstable one.
struct ThrownBlock {
    const Vec3 size{1, 4, 9};
    const double mass = 2;
    const Pose X_WB{{1, 2, 3}, from_rpy(0.3, 0.2, 0.1)};
    const Vec3 angular_B{0.05, 3, 0.05}, linear{1, 2, 30}, gravity{0, 0, -9.81};
};

test::TumblingBody exact_motion(const ThrownBlock& block) {
    const Mat3 inertia = test::box_inertia(block.mass, block.size);
    const Quat& q = block.X_WB.q;
    const QuatT<Real> wide = normalized(QuatT<Real>{q.w, q.x, q.y, q.z});
    return {widened({inertia(0, 0), inertia(1, 1), inertia(2, 2)}), to_matrix(wide),
            widened(block.angular_B)};
}

/// Furthest that a corner, seen from the centre, is from where it should be.
double corner_error(const ThrownBlock& block, const Quat& now, const test::RealMat3& R) {
    double error = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1 ? 0.5 : -0.5) * block.size.x, (corner & 2 ? 0.5 : -0.5) * block.size.y,
                     (corner & 4 ? 0.5 : -0.5) * block.size.z};
        error = largest(error, norm(rotate(now, p) - narrowed(R * widened(p))));
    }
    return error;
}

Outcome throw_block(const Contender& contender) {
    const ThrownBlock block;
    World world = test::empty_world(contender.dt_s, block.gravity);
    test::place(world, test::solid_box(block.mass, block.size, test::surface(0.5)), "block", block.X_WB);
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(4);
    trial.engine().set_base(0, block.X_WB, rotate(block.X_WB.q, block.angular_B), block.linear);
    trial.begin();
    test::TumblingBody exact = exact_motion(block);
    const double kinetic = trial.energy() + block.mass * dot(block.gravity, block.X_WB.p);
    const double energy = trial.energy();
    const auto spin = [&] {
        return trial.momentum().angular - cross(trial.centre(0), trial.momentum().linear);
    };
    const Vec3 spin_before = spin();
    std::vector<double> worst(4);
    trial.run(10, 0.1, [&] {
        const double t = trial.time_s();
        const Vec3 centre = block.X_WB.p + block.linear * t + block.gravity * (0.5 * t * t);
        worst[0] = largest(worst[0], norm(trial.centre(0) - centre));
        worst[1] = largest(
            worst[1], corner_error(block, trial.link(0).X_WL.q, exact.orientation(static_cast<Real>(t))));
        worst[2] = largest(worst[2], norm(spin() - spin_before) / norm(spin_before));
        worst[3] = largest(worst[3], std::fabs(trial.energy() - energy) / kinetic);
    });
    return trial.outcome(worst);
}

constexpr double kLevel = -kPi / 2;  // about y: along +x

/// Of all links hanging straight down.
double lowest_energy(const Contender& contender, const World& world) {
    Trial trial(contender, world);
    trial.begin();
    return trial.energy();
}

Outcome swing_arm(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, test::arm(), "arm");
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(2);
    const double lowest = lowest_energy(contender, world);
    trial.engine().set_joint({0, 1, 0}, {kLevel, 0});
    trial.begin();
    const double energy = trial.energy();
    const Vec3 tip_L{0, 0, -0.25};
    test::HingeChain chain(world.prototypes[0], world.gravity);
    test::RealVector exact(8);
    exact[1] = kLevel;
    chain.advance(2, exact);
    const Vec3 tip = narrowed(chain.place(3, world.prototypes[0].links[3].X_ML * tip_L, exact));
    double drift = 0, miss = 0;
    std::vector<std::pair<double, double>> trace;
    trial.run(10, 0.05, [&] {
        const double now = std::fabs(trial.energy() - energy) / (energy - lowest);
        drift = largest(drift, now);
        trace.emplace_back(trial.time_s(), now);
        if (std::fabs(trial.time_s() - 2) < 1e-9) miss = norm(trial.place(0, 3, tip_L) - tip);
    });
    Outcome out = trial.outcome({drift, miss});
    out.trace = std::move(trace);
    return out;
}

Outcome swing_double_pendulum(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, test::double_pendulum(), "pendulum");
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(1);
    const double start[] = {2.6, 0.4};
    for (std::size_t j = 0; j < 2; ++j) trial.engine().set_joint({0, j, 0}, {start[j], 0});
    test::HingeChain chain(world.prototypes[0], world.gravity);
    test::RealVector exact{start[0], start[1], 0, 0};
    chain.advance(2, exact);
    const Vec3 tip_L{0, 0, -0.5};
    const Vec3 tip = narrowed(chain.place(1, world.prototypes[0].links[1].X_ML * tip_L, exact));
    trial.run(2);
    return trial.outcome({norm(trial.place(0, 1, tip_L) - tip)});
}

constexpr std::size_t kChainLinks = 50;
constexpr double kChainLink = 0.1;  // m

/// Light links and a bob a hundred times heavier at the end.
ModelSpec long_chain() {
    ModelSpec m;
    m.name = "chain";
    m.canonical_link = "link_0";
    std::string parent = "world";
    for (std::size_t i = 0; i < kChainLinks; ++i) {
        const Pose X{{0, 0, -kChainLink * static_cast<double>(i)}, {}};
        const double mass = i + 1 < kChainLinks ? 0.05 : 5.0;
        m.links.push_back(test::rod("link_" + std::to_string(i), mass, kChainLink, X));
        m.joints.push_back(test::joint(JointSpecKind::kRevolute, "hinge_" + std::to_string(i), parent,
                                       m.links.back().name, X, {0, 1, 0}));
        parent = m.links.back().name;
    }
    return m;
}

Outcome swing_chain(const Contender& contender) {
    World world = test::empty_world(contender.dt_s);
    test::place(world, long_chain(), "chain", {{0, 0, 6}, {}});
    Trial trial(contender, world);
    if (!trial.possible()) return Trial::impossible(2);
    const double lowest = lowest_energy(contender, world);
    trial.engine().set_joint({0, 0, 0}, {-0.5, 0});
    trial.begin();
    const double energy = trial.energy();
    double gap = 0, drift = 0;
    trial.run(10, 0.1, [&] {
        gap = largest(gap, trial.widest_gap(0));
        drift = largest(drift, std::fabs(trial.energy() - energy) / (energy - lowest));
    });
    return trial.outcome({gap, drift});
}

}  // namespace

std::vector<Case> free_motion_cases() {
    Case block{
        "block",
        "Tumbling 1 x 4 x 9 block, thrown, 10 s",
        "parabola; Jacobi elliptic functions and the precession's quadrature (Landau, Lifshitz, section 37); "
        "angular momentum about the centre of mass and energy stay",
        {{"position of the centre", "m", 1e-6},
         {"position of the worst corner about it", "m", 1e-6},
         {"angular momentum, relative", "", 1e-6},
         {"energy, relative to the kinetic", "", 1e-6}},
        throw_block};
    block.also_coarse = true;
    Case arm{"arm",
             "4-DOF arm swinging freely from horizontal, 10 s",
             "energy stays (relative to that above the lowest pose); end point: product of exponentials, "
             "extrapolated "
             "midpoint rule of order 16 in long double, converged to 1e-13",
             {{"energy drift, largest in 10 s", "", 1e-6}, {"end point at 2 s", "m", 1e-6}},
             swing_arm};
    arm.also_coarse = true;
    Case pendulum{"double-pendulum",
                  "Double pendulum from 149 degrees, chaotic, 2 s",
                  "the same reference as the arm's",
                  {{"end point at 2 s", "m", 1e-6}},
                  swing_double_pendulum};
    pendulum.from_issue = false;
    Case chain{"chain",
               "Chain of 50 hinges with a bob 100 times a link, swinging from 29 degrees, 10 s",
               "joints do not come apart; energy stays",
               {{"widest gap at a joint", "m", 1e-9}, {"energy drift, relative", "", 1e-3}},
               swing_chain};
    chain.from_issue = false;
    return {block, arm, pendulum, chain};
}

}  // namespace roboss::bench
