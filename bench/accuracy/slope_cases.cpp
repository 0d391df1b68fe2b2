// Bodies on an incline of 20 degrees: Coulomb's law, with closed forms.
#include <support/bodies.h>

#include <memory>

#include "accuracy/figures.h"
#include "accuracy/trial.h"

namespace roboss::bench {
namespace {

constexpr double kGravity = 9.81, kEdge = 0.2, kRadius = 0.1;
const double kAngle = 20 * kPi / 180;

/// A plane that falls towards +x, and one body that touches it.
struct Incline {
    /// X: of the body on level ground.
    Incline(const Contender& contender, ModelSpec body, double mu, const Pose& X) {
        World world = test::empty_world(contender.dt_s, {0, 0, -kGravity});
        const Pose tilt{{}, from_rpy(0, kAngle, 0)};
        test::place(world, test::ground(test::surface(mu)), "incline", tilt);
        test::place(world, std::move(body), "body", tilt * X);
        down = rotate(tilt.q, Vec3{1, 0, 0});
        trial = std::make_unique<Trial>(contender, world);
    }
    double way() const { return dot(trial->centre(1), down); }

    Vec3 down;
    std::unique_ptr<Trial> trial;
};

Incline box_on_incline(const Contender& contender, double mu) {
    const Pose X{{0, 0, 0.5 * kEdge}, {}};
    return {contender, test::solid_box(1.0, {kEdge, kEdge, kEdge}, test::surface(mu)), mu, X};
}

Outcome slide_box(const Contender& contender) {
    const double mu = 0.2, duration = 2, a = kGravity * (std::sin(kAngle) - mu * std::cos(kAngle));
    Incline incline = box_on_incline(contender, mu);
    if (!incline.trial->possible()) return Trial::impossible(3);
    incline.trial->run(duration);
    const double speed = dot(incline.trial->link(1).v_WC, incline.down);
    Contender half = contender;
    half.dt_s *= 0.5;
    Incline fine = box_on_incline(half, mu);
    fine.trial->run(duration);
    const double exact = 0.5 * a * duration * duration;
    return incline.trial->outcome({std::fabs(incline.way() / exact - 1),
                                   std::fabs(speed / (a * duration) - 1), std::fabs(fine.way() / exact - 1)});
}

Outcome stand_box(const Contender& contender) {
    Incline incline = box_on_incline(contender, 0.4);  // the tangent is 0.364
    if (!incline.trial->possible()) return Trial::impossible(2);
    const double start = incline.way();
    incline.trial->run(1);
    const double settled = incline.way();
    incline.trial->run(9);
    return incline.trial->outcome({std::fabs(incline.way() - settled) / 9, std::fabs(incline.way() - start)});
}

/// `inertia_ratio`: moment of inertia over mass times radius squared.
Outcome roll(const Contender& contender, ModelSpec body, const Quat& q, double inertia_ratio) {
    const double duration = 2, a = kGravity * std::sin(kAngle) / (1 + inertia_ratio);
    Incline incline(contender, std::move(body), 0.9, {{0, 0, kRadius}, q});
    if (!incline.trial->possible()) return Trial::impossible(2);
    incline.trial->run(duration);
    const LinkState state = incline.trial->link(1);
    const double speed = dot(state.v_WC, incline.down);
    return incline.trial->outcome({std::fabs(incline.way() / (0.5 * a * duration * duration) - 1),
                                   std::fabs(1 - state.angular.y * kRadius / speed)});
}

Outcome roll_sphere(const Contender& contender) {
    return roll(contender, test::solid_sphere(1.0, kRadius, test::surface(0.9)), {}, 0.4);
}

Outcome roll_cylinder(const Contender& contender) {
    return roll(contender, test::solid_cylinder(1.0, kRadius, 0.2, test::surface(0.9)),
                from_rpy(-kPi / 2, 0, 0), 0.5);
}

}  // namespace

std::vector<Case> slope_cases() {
    Case sliding{
        "slide",
        "Box sliding down 20 degrees, mu 0.2, 2 s",
        "way a t^2 / 2 with a = g (sin - mu cos)",
        {{"way, relative", "", 5e-4}, {"speed, relative", "", 5e-4}, {"way at half the step", "", {}}},
        slide_box};
    sliding.also_coarse = true;
    Case standing{"stand",
                  "Box standing on 20 degrees, mu 0.4, 10 s",
                  "it does not move",
                  {{"creep, from 1 s to 10 s", "m/s", 1e-6}, {"whole way in 10 s", "m", {}}},
                  stand_box};
    standing.also_coarse = true;
    const std::vector<Quantity> rolling{{"way, relative", "", 1e-3},
                                        {"slip, relative to the speed", "", 1e-3}};
    Case sphere{"roll-sphere", "Sphere rolling down 20 degrees, 2 s", "a = g sin / (1 + 2/5)", rolling,
                roll_sphere};
    Case cylinder{"roll-cylinder", "Cylinder rolling down 20 degrees, 2 s", "a = g sin / (1 + 1/2)", rolling,
                  roll_cylinder};
    sphere.also_coarse = cylinder.also_coarse = true;
    return {sliding, standing, sphere, cylinder};
}

}  // namespace roboss::bench
