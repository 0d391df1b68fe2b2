// The Model hash: every number that the physics or the sensors read changes it, and nothing else does.
#include <gtest/gtest.h>

#include <functional>
#include <type_traits>

#include <support/robots.h>

#include "model/accuracy.h"
#include "model/model.h"

namespace roboss::test {
namespace {

World base_world() {
    World world = empty_world(1e-3);
    place(world, scenery(box_shape({1, 2, 3}, surface(0.5))), "wall");
    ModelSpec m = mixed_tree();
    for (LinkSpec& l : m.links) l.collisions.push_back(box_shape({0.1, 0.1, 0.1}, surface(0.5)));
    m.links[0].collisions.push_back(sphere_shape(0.1, surface(0.5)));
    m.links[1].collisions.push_back(cylinder_shape(0.1, 0.2, surface(0.5)));
    SensorSpec sensor;
    sensor.name = "laser";
    LaserSpec laser;
    laser.range_max = 10;
    sensor.parameters = laser;
    m.links[2].sensors.push_back(sensor);
    place(world, m, "robot");
    return world;
}

std::uint64_t hash_of(const World& world, const CompileOptions& options = {}) {
    Diagnostics diagnostics;
    const auto model = compile(world, options, diagnostics);
    return model ? model->hash : 0;
}

struct Change {
    const char* what;
    std::function<void(World&)> apply;
};

void expect_each_changes_the_hash(const std::vector<Change>& changes) {
    const std::uint64_t before = hash_of(base_world());
    for (const Change& change : changes) {
        World world = base_world();
        change.apply(world);
        EXPECT_NE(hash_of(world), before) << change.what;
    }
}

ModelSpec& robot(World& w) {
    return w.prototypes[1];
}
AxisSpec& axis(World& w) {
    return robot(w).joints.back().axes[0];
}
SurfaceSpec& robot_surface(World& w) {
    return robot(w).links[0].collisions[0].surface;
}
SensorSpec& sensor(World& w) {
    return robot(w).links[2].sensors[0];
}
LaserSpec& laser(World& w) {
    return *sensor(w).as<LaserSpec>();
}
/// Gives the robot a sensor with these parameters instead.
void replace(World& w, const SensorParameters& parameters) {
    sensor(w).parameters = parameters;
}

TEST(ModelHash, IsTheSameForTheSameWorld) {
    EXPECT_EQ(hash_of(base_world()), hash_of(base_world()));
    World renamed = base_world();
    renamed.file = "elsewhere.sdf";
    renamed.prototypes[1].where = {"elsewhere.sdf", 7};
    EXPECT_EQ(hash_of(renamed), hash_of(base_world()));
}

TEST(ModelHash, ChangesWithTheWorld) {
    expect_each_changes_the_hash({
        {"dt", [](World& w) { w.dt_s = 2e-3; }},
        {"gravity", [](World& w) { w.gravity.x = 1e-9; }},
        {"wind",
         [](World& w) {
             w.wind = {1, 0, 0};
         }},
        {"sleep", [](World& w) { w.sleep = true; }},
        {"precision", [](World& w) { w.precision = Precision::kFloat; }},
        {"air", [](World& w) { w.air_density = 1; }},
        {"magnetic field", [](World& w) { w.magnetic_field_T.y = 0; }},
        {"spherical coordinates",
         [](World& w) {
             w.spherical = SphericalCoordinates{0.8, 0.2, 100, 0};
         }},
        {"place", [](World& w) { w.instances[1].X_WM.p.z = 1e-12; }},
        {"name", [](World& w) { w.instances[1].name = "other"; }},
        {"another robot",
         [](World& w) {
             w.instances.push_back({"second", 1, {{5, 0, 0}, {}}, {}});
         }},
        {"scenery size", [](World& w) { w.prototypes[0].links[0].collisions[0].geometry.size.x = 1.5; }},
        {"scenery friction", [](World& w) { w.prototypes[0].links[0].collisions[0].surface.mu = 0.4; }},
        {"scenery place", [](World& w) { w.instances[0].X_WM.p.y = 1; }},
        {"scenery retro", [](World& w) { w.prototypes[0].links[0].collisions[0].laser_retro = 3; }},
    });
}

TEST(ModelHash, ChangesWithLinksAndShapes) {
    expect_each_changes_the_hash({
        {"mass", [](World& w) { robot(w).links[3].mass *= 1 + 1e-15; }},
        {"centre", [](World& w) { robot(w).links[3].p_LC.x += 1e-12; }},
        {"inertia", [](World& w) { robot(w).links[3].inertia_C(0, 0) *= 1.001; }},
        {"link place", [](World& w) { robot(w).links[3].X_ML.p.x += 1e-12; }},
        {"drag",
         [](World& w) {
             robot(w).links[3].drag = {true, false, 1, 0.1, 0};
         }},
        {"gravity off", [](World& w) { robot(w).links[3].gravity = false; }},
        {"gravity off of a welded link", [](World& w) { robot(w).links[1].gravity = false; }},
        {"link name", [](World& w) { robot(w).links[6].name = robot(w).joints.back().child = "paw"; }},
        {"shape size", [](World& w) { robot(w).links[3].collisions[0].geometry.size.y = 0.2; }},
        {"shape kind",
         [](World& w) { robot(w).links[3].collisions[0].geometry.kind = GeometryKind::kSphere; }},
        {"shape place", [](World& w) { robot(w).links[3].collisions[0].X_LS.p.z = 0.01; }},
        {"retro", [](World& w) { robot(w).links[3].collisions[0].laser_retro = 3; }},
        {"radius", [](World& w) { robot(w).links[0].collisions[1].geometry.radius = 0.11; }},
        {"length", [](World& w) { robot(w).links[1].collisions[1].geometry.length = 0.21; }},
        {"friction", [](World& w) { robot_surface(w).mu = 0.6; }},
        {"restitution", [](World& w) { robot_surface(w).restitution = 0.1; }},
        {"bounce threshold", [](World& w) { robot_surface(w).bounce_threshold = 0.02; }},
        {"torsional friction",
         [](World& w) { robot_surface(w).torsional_mu = robot_surface(w).torsional_radius = 0.1; }},
        {"torsional surface", [](World& w) { robot_surface(w).torsional_surface_radius = 0.1; }},
        {"friction direction",
         [](World& w) {
             robot_surface(w).fdir1 = {1, 0, 0};
         }},
        {"stiffness", [](World& w) { robot_surface(w).stiffness = 1e4; }},
        {"contact damping", [](World& w) { robot_surface(w).damping = 10; }},
        {"depth left alone", [](World& w) { robot_surface(w).min_depth = 1e-3; }},
        {"speed of mending", [](World& w) { robot_surface(w).max_vel = 0.1; }},
        {"most contacts", [](World& w) { robot_surface(w).max_contacts = 3; }},
        {"category bitmask", [](World& w) { robot_surface(w).category_bitmask = 4; }},
        {"rolling friction", [](World& w) { robot_surface(w).rolling_mu = 0.001; }},
        {"bitmask", [](World& w) { robot_surface(w).collide_bitmask = 2; }},
        {"sleep forbidden", [](World& w) { robot(w).may_sleep = false; }},
        {"self collision", [](World& w) { robot(w).self_collide = true; }},
    });
}

TEST(ModelHash, ChangesWithJointsAndMotors) {
    expect_each_changes_the_hash({
        {"axis",
         [](World& w) {
             axis(w).xyz = {1, 0, 0};
         }},
        {"lower", [](World& w) { axis(w).lower = -1; }},
        {"upper", [](World& w) { axis(w).upper = 1; }},
        {"effort", [](World& w) { axis(w).max_effort = 1; }},
        {"velocity", [](World& w) { axis(w).max_velocity = 1; }},
        {"damping", [](World& w) { axis(w).damping += 1e-9; }},
        {"friction", [](World& w) { axis(w).friction = 0.1; }},
        {"stiffness", [](World& w) { axis(w).spring_stiffness = 5; }},
        {"reference", [](World& w) { axis(w).spring_reference = 0.2; }},
        {"initial position", [](World& w) { axis(w).initial_position = 0.2; }},
        {"position gain", [](World& w) { axis(w).position_gain = 10; }},
        {"velocity gain", [](World& w) { axis(w).velocity_gain = 10; }},
        {"armature", [](World& w) { axis(w).armature = 0.06; }},
        {"joint place", [](World& w) { robot(w).joints.back().X_MJ.p.x += 1e-12; }},
        {"joint name", [](World& w) { robot(w).joints.back().name = "ankle"; }},
        {"joint kind", [](World& w) { robot(w).joints.back().kind = JointSpecKind::kPrismatic; }},
    });
}

TEST(ModelHash, ChangesWithSensors) {
    expect_each_changes_the_hash({
        {"name", [](World& w) { sensor(w).name = "eye"; }},
        {"kind", [](World& w) { replace(w, GpsSpec{}); }},
        {"place", [](World& w) { sensor(w).X_LS.p.x = 1; }},
        {"turn", [](World& w) { sensor(w).X_LS.q = from_rpy(0, 0, 1); }},
        {"rate", [](World& w) { sensor(w).update_rate_hz = 5; }},
        {"samples", [](World& w) { laser(w).samples = 5; }},
        {"vertical samples", [](World& w) { laser(w).vertical_samples = 5; }},
        {"angles", [](World& w) { laser(w).max_angle = 1; }},
        {"range", [](World& w) { laser(w).range_max = 9; }},
        {"noise", [](World& w) { laser(w).noise.stddev = 0.1; }},
        {"link",
         [](World& w) { robot(w).links[3].sensors.push_back(sensor(w)), robot(w).links[2].sensors.clear(); }},
    });
}

TEST(ModelHash, ChangesWithEveryParameterOfEverySensor) {
    const auto changes = [](const SensorParameters& kind) {
        std::size_t count = 0;
        visit_parameters(kind, [&](const Parameter&, const auto&) { ++count; });
        World plain = base_world();
        replace(plain, kind);
        for (std::size_t changed = 0; changed < count; ++changed) {
            SensorParameters other = kind;
            std::size_t at = 0;
            const char* name = "";
            visit_parameters(other, [&]<class Value>(const Parameter& parameter, Value& value) {
                if (at++ != changed) return;
                name = parameter.name;
                if constexpr (std::is_same_v<Value, NoiseSpec>)
                    value.bias_stddev = 0.5;
                else if constexpr (std::is_same_v<Value, JointNames>)
                    value = {"slider"};
                else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
                    value = {"slider"};
                else if constexpr (std::is_same_v<Value, std::string>)
                    value = "slider";
                else if constexpr (std::is_same_v<Value, Vec3>)
                    value = {0, 7, 0};
                else if constexpr (std::is_same_v<Value, Pose>)
                    value.p = {0, 7, 0};
                else if constexpr (std::is_same_v<Value, std::vector<double>>)
                    value = {7};
                else if constexpr (std::is_same_v<Value, bool>)
                    value = !value;
                else
                    value = 7;
            });
            // compile() makes numbers of shapes of the names of collisions
            if (std::string_view(name) == "collisions") continue;
            World world = base_world();
            replace(world, other);
            EXPECT_NE(hash_of(world), hash_of(plain)) << name;
        }
    };
    [&]<class... Kinds>(std::in_place_type_t<std::variant<Kinds...>>) {
        (changes(Kinds{}), ...);
    }(std::in_place_type<SensorParameters>);
}

TEST(ModelHash, ChangesWithABiasThatWanders) {
    expect_each_changes_the_hash({
        {"bias that wanders", [](World& w) { sensor(w).as<LaserSpec>()->noise.dynamic_bias_stddev = 0.1; }},
        {"its correlation time",
         [](World& w) { sensor(w).as<LaserSpec>()->noise.dynamic_bias_correlation_time = 10; }},
    });
}

TEST(ModelHash, ChangesWithTheAccuracy) {
    const std::uint64_t before = hash_of(base_world());
    for (const AccuracyNumber& number : accuracy_numbers()) {
        CompileOptions options;
        options.accuracy.numbers = {{number.name, number.low}};
        EXPECT_NE(hash_of(base_world(), options), before) << number.name;
        World world = base_world();
        world.accuracy.push_back(options.accuracy);
        EXPECT_EQ(hash_of(world), hash_of(base_world(), options)) << "from the file as from the command line";
    }
}

}  // namespace
}  // namespace roboss::test
