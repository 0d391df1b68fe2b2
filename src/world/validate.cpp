// Judges a World: what no physics could make sense of is an error, what looks like a slip is a warning.
#include <algorithm>
#include <cmath>
#include <set>

#include "math/inertia_checks.h"
#include "world/joint_type.h"
#include "world/world.h"

namespace roboss {
namespace {

std::string text(double value) {
    std::string result = std::to_string(value);
    if (value != 0 && std::fabs(value) < 1e-3) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.4g", value);
        result = buffer;
    }
    return result;
}

std::string numbers(const Mat3& i) {
    return "ixx " + text(i(0, 0)) + ", iyy " + text(i(1, 1)) + ", izz " + text(i(2, 2)) + ", ixy " +
           text(i(0, 1)) + ", ixz " + text(i(0, 2)) + ", iyz " + text(i(1, 2));
}

bool is_finite(const Mat3& m) {
    return roboss::is_finite(m.r0) && roboss::is_finite(m.r1) && roboss::is_finite(m.r2);
}

class ModelCheck {
  public:
    ModelCheck(const ModelSpec& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    void run() {
        for (const LinkSpec& link : model_.links) check_link(link);
        for (const JointSpec& joint : model_.joints) check_joint(joint);
        for (const LinkSpec& link : model_.links) check_sensors(link);
    }

  private:
    void check_link(const LinkSpec& link) {
        const std::string name = named("link", link.name);
        if (!names_.insert(link.name).second) {
            diagnostics_.error(link.where, "duplicate-name",
                               name + ": the model has two links or joints of that name",
                               "Give each a name of its own.");
        }
        links_.insert(link.name);
        if (!is_finite(link.X_ML))
            diagnostics_.error(link.where, "not-finite", name + " has a pose that is not finite",
                               "Correct its <pose>.");
        if (!model_.is_static) check_mass(link, name);
        for (const CollisionSpec& collision : link.collisions) check_collision(collision);
    }

    void check_mass(const LinkSpec& link, const std::string& name) {
        // Without mass a link can still be a frame that others carry; compile() says what becomes of it.
        if (!(link.mass >= 0) || !std::isfinite(link.mass)) {
            diagnostics_.error(link.where, "bad-mass", name + " has a mass of " + text(link.mass) + " kg",
                               "Give it a mass greater than 0, or make the model static.");
        }
        if (!is_finite(link.inertia_C) || !is_finite(link.p_LC)) {
            diagnostics_.error(link.where, "not-finite", name + " has an inertia that is not finite",
                               "Correct its <inertial>.");
        } else if (link.mass > 0 && !positive_definite(link.inertia_C)) {
            diagnostics_.warning(
                link.where, "bad-inertia",
                name + " has an inertia that is not positive definite: " + numbers(link.inertia_C),
                "Write the moments of inertia about the centre of mass; all must be greater than 0.");
        } else if (link.mass > 0 && !obeys_triangle_inequality(link.inertia_C)) {
            diagnostics_.warning(
                link.where, "unreal-inertia",
                name +
                    " has an inertia that no body can have (one principal moment exceeds the sum of the "
                    "others): " +
                    numbers(link.inertia_C),
                "Compute it anew; a common slip is to mix up mm and m, or the axes.");
        }
    }

    void check_collision(const CollisionSpec& collision) {
        const std::string name = named("collision", collision.name);
        const GeometrySpec& g = collision.geometry;
        if (!is_finite(collision.X_LS)) {
            diagnostics_.error(collision.where, "not-finite", name + " has a pose that is not finite",
                               "Correct its <pose>.");
        }
        const bool box = g.kind == GeometryKind::kBox || g.kind == GeometryKind::kEllipsoid;
        const bool round = g.kind == GeometryKind::kSphere || g.kind == GeometryKind::kCylinder ||
                           g.kind == GeometryKind::kCapsule || g.kind == GeometryKind::kCone;
        const bool bad_box = box && !(g.size.x > 0 && g.size.y > 0 && g.size.z > 0 && is_finite(g.size));
        const bool bad_radius = round && !(g.radius > 0 && std::isfinite(g.radius));
        const bool bad_length =
            round && g.kind != GeometryKind::kSphere && !(g.length > 0 && std::isfinite(g.length));
        if (bad_box || bad_radius || bad_length) {
            diagnostics_.error(collision.where, "bad-size", name + " has a size that is not greater than 0",
                               "Correct its <geometry>.");
        }
        const SurfaceSpec& s = collision.surface;
        if (!(s.mu >= 0) || !(s.mu2 >= 0) || !(s.restitution >= 0) || !(s.torsional_mu >= 0) ||
            !(s.torsional_radius >= 0) || !(s.torsional_surface_radius >= 0) || !(s.rolling_mu >= 0) ||
            !(s.stiffness >= 0) || !(s.damping >= 0) || !(s.min_depth >= 0)) {
            diagnostics_.error(collision.where, "bad-surface",
                               name + " has a negative coefficient of friction, restitution or softness",
                               "Write coefficients of at least 0.");
        }
        if (s.restitution > 1) {
            diagnostics_.warning(
                collision.where, "bad-surface",
                name + " has a restitution of " + text(s.restitution) + ": every bounce adds energy",
                "Write a <restitution_coefficient> from 0 to 1.");
        }
    }

    void check_joint(const JointSpec& joint) {
        const std::string name = named("joint", joint.name);
        auto& taken = model_.shared_names ? joints_ : names_;
        if (!taken.insert(joint.name).second) {
            diagnostics_.error(joint.where, "duplicate-name",
                               name + ": the model has two links or joints of that name",
                               "Give each a name of its own.");
        }
        joints_.insert(joint.name);
        if (joint.parent != "world" && !links_.count(joint.parent)) to_nowhere(joint, "parent", joint.parent);
        if (!links_.count(joint.child)) to_nowhere(joint, "child", joint.child);
        if (joint.parent == joint.child) {
            diagnostics_.error(joint.where, "joint-to-itself",
                               name + " joins link '" + joint.child + "' to itself", "Name two links.");
        }
        if (!is_finite(joint.X_MJ))
            diagnostics_.error(joint.where, "not-finite", name + " has a pose that is not finite",
                               "Correct its <pose>.");
        if (joint_type(joint.kind).count(JointKind::kScrew) > 0 &&
            !(std::isfinite(joint.screw_pitch) && joint.screw_pitch != 0)) {
            diagnostics_.error(joint.where, "bad-pitch", name + " has a thread without pitch",
                               "Write <screw_thread_pitch> in metres a turn, other than 0.");
        }
        if (!(joint.ball_damping >= 0) || !(joint.ball_armature >= 0)) {
            diagnostics_.error(joint.where, "bad-dynamics", name + " has a negative damping or armature",
                               "Write values of at least 0.");
        }
        if (joint.axes.size() == 3 &&
            norm(cross(joint.axes[0].xyz, joint.axes[1].xyz) - joint.axes[2].xyz) > 1e-9) {
            diagnostics_.error(joint.where, "bad-axes", name + " has axes that are not at right angles",
                               "Give three unit vectors at right angles, right-handed.");
        }
        for (const AxisSpec& axis : joint.axes) check_axis(joint, axis);
    }

    void to_nowhere(const JointSpec& joint, const std::string& end, const std::string& link) {
        diagnostics_.error(
            joint.where, "joint-to-nowhere",
            named("joint", joint.name) + " has the " + end + " '" + link + "', which is no link of the model",
            end == "child" && link == "world" ? "Swap parent and child: world can only be the parent."
                                              : "Check the name; links of nested models are NESTED::LINK.");
    }

    void check_axis(const JointSpec& joint, const AxisSpec& axis) {
        const std::string name = named("joint", joint.name);
        if (axis.lower > axis.upper) {
            diagnostics_.error(joint.where, "bad-limit",
                               name + " has the limits " + text(axis.lower) + " to " + text(axis.upper) +
                                   ": lower is above upper",
                               "Swap them.");
        }
        if (!(axis.damping >= 0) || !(axis.friction >= 0) || !(axis.spring_stiffness >= 0) ||
            !(axis.armature >= 0) || !(axis.limit_stiffness >= 0) || !(axis.limit_dissipation >= 0)) {
            diagnostics_.error(joint.where, "bad-dynamics",
                               name +
                                   " has a negative damping, friction, spring, armature, or stiffness or "
                                   "dissipation of its limits",
                               "Write values of at least 0.");
        }
        if (!(axis.position_gain >= 0 && std::isfinite(axis.position_gain)) ||
            !(axis.velocity_gain >= 0 && std::isfinite(axis.velocity_gain))) {
            diagnostics_.error(joint.where, "bad-gain",
                               name + " has a motor with a gain that is negative or not finite",
                               "Write gains of at least 0; 0 is as stiff as the solver allows.");
        }
    }

    void check_sensors(const LinkSpec& link) {
        for (const SensorSpec& sensor : link.sensors) {
            const std::string name = named("sensor", sensor.name);
            for (const SensorProblem& problem : problems_of(sensor))
                diagnostics_.error(sensor.where, "bad-sensor", name + " " + problem.text, problem.remedy);
            for (const std::string& joint : joints_read(sensor)) check_joint_read(sensor, name, joint);
        }
    }

    void check_joint_read(const SensorSpec& sensor, const std::string& name, const std::string& joint) {
        const auto read = std::find_if(model_.joints.begin(), model_.joints.end(),
                                       [&](const JointSpec& j) { return j.name == joint; });
        if (read == model_.joints.end())
            diagnostics_.error(sensor.where, "unknown-joint",
                               name + " reads the joint '" + joint + "', which the model does not have",
                               "Check the name.");
        else if (read->axes.size() != 1)
            diagnostics_.error(sensor.where, "bad-sensor",
                               name + " reads the joint '" + joint + "', which does not have one axis",
                               "Let it read revolute, continuous, prismatic or screw joints.");
    }

    std::string named(const std::string& kind, const std::string& name) const {
        return kind + " '" + name + "' of model '" + model_.name + "'";
    }

    const ModelSpec& model_;
    Diagnostics& diagnostics_;
    std::set<std::string> names_, links_, joints_;
};

void check_air(const World& world, Diagnostics& diagnostics) {
    if (!is_finite(world.wind) || !(world.air_density >= 0) || !std::isfinite(world.air_density))
        diagnostics.error({world.file, 0}, "not-finite", "wind or air are not finite",
                          "Correct <wind> and <atmosphere>.");
    if (world.wind == Vec3{}) return;
    for (const ModelSpec& model : world.prototypes)
        for (const LinkSpec& link : model.links)
            if (link.drag.wind) return;
    diagnostics.note({world.file, 0}, "wind", "there is wind, but it acts on no link",
                     "Write <enable_wind>true</enable_wind> in the links that it carries.");
}

}  // namespace

void InstanceCheck::check(const ModelInstance& instance, Diagnostics& diagnostics) {
    const auto [known, is_new] = names_.try_emplace(instance.name, instance.where);
    if (!is_new) {
        diagnostics.error(instance.where, "duplicate-name",
                          "two models are named '" + instance.name + "' (the other: line " +
                              std::to_string(known->second.line) + ")",
                          "Give each a name of its own.");
    }
    if (instance.name.empty())
        diagnostics.error(instance.where, "no-name", "a model has no name", "Give it one.");
    if (!is_finite(instance.X_WM)) {
        diagnostics.error(instance.where, "not-finite",
                          "model '" + instance.name + "' has a pose that is not finite",
                          "Correct its <pose>.");
    }
}

void validate(const ModelSpec& model, Diagnostics& diagnostics) {
    ModelCheck(model, diagnostics).run();
}

void validate_settings(const World& world, Diagnostics& diagnostics) {
    if (!is_finite(world.gravity))
        diagnostics.error({world.file, 0}, "not-finite", "gravity is not finite", "Correct <gravity>.");
    if (!(world.dt_s > 0) || !std::isfinite(world.dt_s)) {
        diagnostics.error({world.file, 0}, "bad-step", "the time step is " + text(world.dt_s) + " s",
                          "Write <max_step_size> greater than 0.");
    }
    check_air(world, diagnostics);
}

void validate(const World& world, Diagnostics& diagnostics) {
    validate_settings(world, diagnostics);
    for (const ModelSpec& model : world.prototypes) validate(model, diagnostics);
    InstanceCheck instances;
    for (const ModelInstance& instance : world.instances) instances.check(instance, diagnostics);
}

}  // namespace roboss
