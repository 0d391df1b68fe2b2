#include "fuzz/shot.h"

#include <algorithm>
#include <cmath>

#include <support/bodies.h>
#include <support/meshes.h>

#include "core/check.h"

namespace roboss::fuzz {
namespace {

bool chance(Random& random, double probability) {
    return random.uniform(0, 1) < probability;
}

Vec3 direction(Random& random) {
    for (;;) {
        const Vec3 v = random.vector(1);
        const double n = norm(v);
        if (n > 0.1 && n <= 1) return v / n;
    }
}

const SurfaceSpec kSurface = test::surface(0.5);

/// A model with the radius of the sphere about its origin that holds it.
struct Body {
    ModelSpec model;
    double radius = 0;
};

Body ball() {
    return {test::solid_sphere(0.05, 0.01, kSurface), 0.01};
}
Body cube() {
    return {test::solid_box(0.1, {0.04, 0.04, 0.04}, kSurface), 0.035};
}
Body rod() {
    return {test::solid_cylinder(0.05, 0.0025, 0.3, kSurface), 0.151};
}
Body hull() {
    return {test::ball_like(0.05, 0.03, test::mesh_shape(test::ball_mesh(0.03, 1), kSurface)), 0.03};
}
Body small(Random& random) {
    switch (random.integer(0, 3)) {
        case 0:
            return ball();
        case 1:
            return cube();
        case 2:
            return rod();
        default:
            return hull();
    }
}
Body limbs(Random& random) {
    MechanismOptions options;
    options.bare = options.shapes = true;
    options.links_least = 2, options.links_most = 4;
    ModelSpec m = random_tree(random, options);
    return {m, start_radius(m)};
}

Launch spinning(Random& random, const Setting& setting, const Vec3& linear) {
    return {random.vector(setting.spin), linear, setting.spin};
}

/// From where it starts to where it ends, past the origin at distance `miss`; begins at any part of a tick.
struct Line {
    Vec3 along, start;
    double length = 0;
};

Line line_past(Random& random, const Setting& setting, double miss, double clear) {
    const Vec3 along = direction(random);
    Vec3 across = cross(along, direction(random));
    while (norm(across) < 0.1) across = cross(along, direction(random));
    const double back =
        clear + random.uniform(0.1, 0.4) + random.uniform(0, 1) * setting.speed * setting.dt_s;
    return {along, normalized(across) * miss - along * back, 2 * back};
}

double flight_of(const Line& line, const Setting& setting) {
    return line.length / setting.speed + 2 * setting.dt_s;
}

/// Something flies past a fixed thing at the origin, which may be in any orientation.
Shot past_scenery(Random& random, const Setting& setting, const Body& body, const CollisionSpec& thing,
                  double radius) {
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    test::place(shot.world, test::scenery(thing), "thing", {{}, random.rotation()});
    const double miss = random.uniform(0.1, 1.1) * (radius + body.radius);
    const Line line = line_past(random, setting, miss, radius + body.radius);
    test::place(shot.world, body.model, "body", {line.start, random.rotation()});
    shot.launches = {spinning(random, setting, line.along * setting.speed)};
    shot.stand_ins.resize(1);
    shot.flight_s = flight_of(line, setting);
    return shot;
}

/// Two free things fly past each other; each has its share of the speed.
Shot past_each_other(Random& random, const Setting& setting, const Body& a, const Body& b) {
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    const double miss = random.uniform(0.1, 1.1) * (a.radius + b.radius);
    const Line line = line_past(random, setting, miss, a.radius + b.radius);
    const double share = chance(random, 0.3) ? 1.0 : random.uniform(0, 1);
    const double time = 0.5 * line.length / setting.speed;  // to the place of meeting
    const Vec3 va = line.along * (share * setting.speed), vb = line.along * ((share - 1) * setting.speed);
    const Vec3 meeting = line.start + line.along * (0.5 * line.length);
    test::place(shot.world, a.model, "a", {meeting - va * time, random.rotation()});
    test::place(shot.world, b.model, "b", {-vb * time, random.rotation()});
    shot.launches = {spinning(random, setting, va), spinning(random, setting, vb)};
    shot.flight_s = flight_of(line, setting);
    return shot;
}

struct Box {
    CollisionSpec shape;
    Vec3 size;
    double radius = 0;
};

Box random_box(Random& random) {
    const auto edge = [&] { return random.uniform(0.05, 0.3); };
    const double x = edge(), y = edge();
    const Vec3 size{x, y, edge()};
    return {test::box_shape(size, kSurface), size, 0.5 * norm(size)};
}

Shot ball_past_box(Random& random, const Setting& setting) {
    const Box box = random_box(random);
    return past_scenery(random, setting, ball(), box.shape, box.radius);
}

Shot box_past_box(Random& random, const Setting& setting) {
    const Box box = random_box(random);
    return past_scenery(random, setting, cube(), box.shape, box.radius);
}

Shot rod_past_cylinder(Random& random, const Setting& setting) {
    const double radius = random.uniform(0.03, 0.15), length = random.uniform(0.05, 0.3);
    return past_scenery(random, setting, rod(), test::cylinder_shape(radius, length, kSurface),
                        std::hypot(radius, 0.5 * length));
}

/// A closed mesh, equal to a box.
Shot past_mesh(Random& random, const Setting& setting, const Body& body) {
    const Box box = random_box(random);
    Shot shot =
        past_scenery(random, setting, body, test::mesh_shape(test::box_mesh(box.size), kSurface), box.radius);
    shot.stand_ins[0].kind = ShapeKind::kBox;
    shot.stand_ins[0].half = box.size * 0.5;
    return shot;
}

Shot ball_past_mesh(Random& random, const Setting& setting) {
    return past_mesh(random, setting, ball());
}
Shot rod_past_mesh(Random& random, const Setting& setting) {
    return past_mesh(random, setting, rod());
}
Shot ball_past_ball(Random& random, const Setting& setting) {
    return past_each_other(random, setting, ball(), ball());
}
Shot cube_past_cube(Random& random, const Setting& setting) {
    return past_each_other(random, setting, cube(), cube());
}
Shot small_past_small(Random& random, const Setting& setting) {
    const Body a = small(random);
    return past_each_other(random, setting, a, small(random));
}

Shot limbs_past_box(Random& random, const Setting& setting) {
    const Box box = random_box(random);
    return past_scenery(random, setting, limbs(random), box.shape, box.radius);
}

Shot limbs_past_limbs(Random& random, const Setting& setting) {
    const Body a = limbs(random);
    return past_each_other(random, setting, a, limbs(random));
}

constexpr double kWallSize = 4.0, kThickness = 0.01;

/// A shot at the wall placed already, from its -x side, up to 60 degrees off its normal.
void aim_at_wall(Random& random, const Setting& setting, RobotId wall, double thickness, Shot& shot) {
    const Body body = small(random);
    const double distance =
        body.radius + 0.06 + random.uniform(0.1, 0.3) + random.uniform(0, 1) * setting.speed * setting.dt_s;
    const double angle = random.uniform(0, kPi / 3), about = random.uniform(0, 2 * kPi);
    const Vec3 along{std::cos(angle), std::sin(angle) * std::cos(about), std::sin(angle) * std::sin(about)};
    const Vec3 target{0, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    test::place(shot.world, body.model, "body", {target - along * (distance / along.x), random.rotation()});
    shot.launches.push_back(spinning(random, setting, along * setting.speed));
    shot.wall = Wall{{}, wall, thickness, 0.45 * kWallSize};
    shot.flight_s = 3 * distance / (along.x * setting.speed) + 10 * setting.dt_s;
}

Shot at_scenery(Random& random, const Setting& setting, const CollisionSpec& shape, const Quat& q_WP,
                double thickness) {
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    test::place(shot.world, test::scenery(shape), "wall", {{}, q_WP});
    shot.stand_ins.resize(1);
    aim_at_wall(random, setting, {}, thickness, shot);
    return shot;
}

const Vec3 kWall{kThickness, kWallSize, kWallSize};

Shot at_box_wall(Random& random, const Setting& setting) {
    return at_scenery(random, setting, test::box_shape(kWall, kSurface), {}, kThickness);
}

Shot at_mesh_wall(Random& random, const Setting& setting) {
    Shot shot =
        at_scenery(random, setting, test::mesh_shape(test::box_mesh(kWall), kSurface), {}, kThickness);
    shot.stand_ins[0].kind = ShapeKind::kBox, shot.stand_ins[0].half = kWall * 0.5;
    return shot;
}

const Quat kLaid = from_rpy(0, -kPi / 2, 0);  // its z is -x

Shot at_sheet(Random& random, const Setting& setting) {
    const MeshSpec sheet = test::sheet_mesh(kWallSize, kWallSize, 20, 20, [](double, double) { return 0.0; });
    Shot shot = at_scenery(random, setting, test::mesh_shape(sheet, kSurface), kLaid, 0);
    shot.has_oracle = false;
    return shot;
}

Shot at_heightmap(Random& random, const Setting& setting) {
    std::vector<double> heights(21 * 21);
    for (double& h : heights) h = random.uniform(0, 0.05);
    Shot shot = at_scenery(random, setting,
                           test::heightmap_shape(21, 21, heights, kWallSize, kWallSize, kSurface), kLaid, 0);
    shot.has_oracle = false;
    return shot;
}

Shot at_plate(Random& random, const Setting& setting) {
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    test::place(shot.world, test::solid_box(5, kWall, kSurface), "plate");
    shot.launches.push_back({});
    aim_at_wall(random, setting, RobotId(std::size_t{0}), kThickness, shot);
    return shot;
}

/// Two equal things, the middle of one on the line of the other's, each at the full speed.
Shot head_on(Random& random, const Setting& setting) {
    Setting twice = setting;
    twice.speed = 2 * setting.speed;
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    const Body body = chance(random, 0.5) ? ball() : small(random);
    const Line line = line_past(random, twice, random.uniform(0, 0.005), body.radius * 2);
    const Vec3 v = line.along * setting.speed, offset = line.start + line.along * (0.5 * line.length);
    const double time = 0.5 * line.length / twice.speed;
    test::place(shot.world, body.model, "a", {offset - v * time, random.rotation()});
    test::place(shot.world, body.model, "b", {v * time, random.rotation()});
    shot.launches = {spinning(random, setting, v), spinning(random, setting, -v)};
    shot.flight_s = flight_of(line, twice);
    return shot;
}

/// A golf ball at an edge of a MiroSot robot, a free cube of 7.5 cm.
Shot golf(Random& random, const Setting& setting) {
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    const Line line = line_past(random, setting, random.uniform(0.02, 0.07), 0.1);
    test::place(shot.world, test::solid_sphere(0.046, 0.0213, kSurface), "ball", {line.start, {}});
    test::place(shot.world, test::solid_box(0.6, {0.075, 0.075, 0.075}, kSurface), "robot",
                {{}, random.rotation()});
    shot.launches = {{random.vector(setting.spin), line.along * setting.speed, 0}, {}};
    shot.flight_s = flight_of(line, setting);
    return shot;
}

/// A blade that turns on a fixed hinge, 60 cm long and 5 mm thick, and something that flies into its circle.
Shot blade(Random& random, const Setting& setting) {
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    const Vec3 size{0.6, 0.03, 0.005};
    ModelSpec m = test::solid_box(0.5, size, kSurface);
    const Quat tilt = from_rpy(random.uniform(-kPi / 2, kPi / 2), 0, 0);
    m.joints.push_back(
        test::joint(JointSpecKind::kContinuous, "hinge", "world", "box", {}, rotate(tilt, Vec3{0, 0, 1})));
    test::place(shot.world, m, "blade", {{}, from_rpy(0, 0, random.uniform(-kPi, kPi))});
    const Body body = chance(random, 0.5) ? ball() : cube();
    const Line line = line_past(random, setting, random.uniform(0.05, 0.28), 0.3 + body.radius);
    test::place(shot.world, body.model, "body", {line.start, random.rotation()});
    shot.launches = {{{}, {}, setting.spin}, {{}, line.along * setting.speed, 0}};
    shot.flight_s = flight_of(line, setting);
    return shot;
}

/// Four fast things in a closed room with walls of 1 cm.
Shot thin_room(Random& random, const Setting& setting) {
    constexpr double kEdge = 1.0;
    Shot shot;
    shot.world = test::empty_world(setting.dt_s, {});
    const SurfaceSpec s =
        test::surface(random.uniform(0, 1), chance(random, 0.5) ? 0 : random.uniform(0, 0.97));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 size{kEdge + 2 * kThickness, kEdge + 2 * kThickness, kEdge + 2 * kThickness}, p;
            size[axis] = kThickness, p[axis] = side * 0.5 * (kEdge + kThickness);
            test::place(shot.world, test::scenery(test::box_shape(size, s)),
                        "wall_" + std::to_string(2 * axis) + (side < 0 ? "a" : "b"), {p, {}});
        }
    }
    for (int i = 0; i < 4; ++i) {
        const Body body = small(random);
        const Vec3 p{i & 1 ? 0.25 : -0.25, i & 2 ? 0.25 : -0.25, random.uniform(-0.3, 0.3)};
        test::place(shot.world, body.model, "body_" + std::to_string(i), {p, random.rotation()});
        shot.launches.push_back(spinning(random, setting, direction(random) * setting.speed));
    }
    shot.has_oracle = false;
    shot.room = 0.5 * kEdge;
    shot.flight_s = 1;
    return shot;
}

constexpr ShotKind kKinds[] = {
    {"ball-box", "a ball of 2 cm past a fixed box", ball_past_box, true},
    {"box-box", "a cube of 4 cm past a fixed box", box_past_box, true},
    {"rod-cylinder", "a rod of 30 x .5 cm past a fixed cylinder", rod_past_cylinder, true},
    {"ball-mesh", "a ball past a fixed mesh", ball_past_mesh, true},
    {"rod-mesh", "a rod past a fixed mesh", rod_past_mesh, true},
    {"balls", "two balls past each other", ball_past_ball, true},
    {"boxes", "two cubes past each other", cube_past_cube, true},
    {"pair", "two small solids past each other", small_past_small, true},
    {"limbs-box", "a mechanism past a fixed box", limbs_past_box, true},
    {"limbs", "two mechanisms past each other", limbs_past_limbs, true},
    {"wall-box", "a small solid at a wall of 1 cm", at_box_wall, false},
    {"wall-mesh", "a small solid at a closed mesh of 1 cm", at_mesh_wall, false},
    {"wall-sheet", "a small solid at a mesh without thickness", at_sheet, false},
    {"wall-heightmap", "a small solid at a heightmap", at_heightmap, false},
    {"wall-plate", "a small solid at a free plate of 1 cm", at_plate, false},
    {"head-on", "two equal solids that meet head-on, each at the full speed", head_on, false},
    {"golf", "a golf ball at the edge of a MiroSot robot", golf, false},
    {"blade", "a ball or cube into the circle of a spinning blade", blade, false},
    {"thin-room", "four small solids in a closed room with walls of 1 cm", thin_room, false},
};

std::vector<RobotState> launched(const Model& model, const Shot& shot, Random& random) {
    std::vector<RobotState> states;
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const RobotType& type = model.type_of(RobotId(r));
        const Launch& launch = shot.launches.at(r);
        RobotState state = initial_state(model, RobotId(r));
        const auto base = static_cast<std::size_t>(type.base_nv());
        for (std::size_t k = 0; k < 3 && base > 0; ++k)
            state.v[k] = launch.angular[k], state.v[k + 3] = launch.linear[k];
        for (std::size_t d = 0; d < type.dofs.size(); ++d) {
            const bool slides =
                type.bodies[static_cast<std::size_t>(type.dofs[d].body)].joint == JointKind::kPrismatic;
            state.v[base + d] = random.uniform(-1, 1) * launch.spin * (slides ? 0.05 : 1.0);
        }
        states.push_back(std::move(state));
    }
    return states;
}

World without_collisions(World world) {
    for (ModelSpec& m : world.prototypes)
        for (LinkSpec& l : m.links)
            for (CollisionSpec& c : l.collisions) c.surface.collide_bitmask = c.surface.category_bitmask = 0;
    return world;
}

void step_all(const Model& model, Tick tick, std::vector<RobotState>& states, StepScratch& scratch) {
    std::vector<RobotId> ids;
    std::vector<RobotState*> pointers;
    for (std::size_t r = 0; r < states.size(); ++r) ids.emplace_back(r), pointers.push_back(&states[r]);
    std::vector<Aabb> bounds(states.size());
    step_island(model, tick, ids, pointers, {}, bounds, scratch);
}

}  // namespace

std::span<const ShotKind> shot_kinds() {
    return kKinds;
}

const ShotKind* find_shot_kind(const std::string& name) {
    for (const ShotKind& kind : kKinds)
        if (name == kind.name) return &kind;
    return nullptr;
}

namespace {

struct Loaded {
    Shot shot;
    std::shared_ptr<const Model> model;
    std::vector<RobotState> states;
};

Loaded load(const Setting& setting) {
    const ShotKind* kind = find_shot_kind(setting.kind);
    ROBOSS_CHECK(kind != nullptr, "there is no such kind of shot");
    Random random(setting.seed);
    Loaded loaded;
    loaded.shot = kind->make(random, setting);
    loaded.model = compile_scene(loaded.shot.world);
    loaded.states = launched(*loaded.model, loaded.shot, random);
    return loaded;
}

/// The same world at a fraction of the step, and nothing in it collides.
std::shared_ptr<const Model> without_collisions(const World& world, int parts) {
    World free = without_collisions(world);
    free.dt_s /= parts;
    return compile_scene(free);
}

}  // namespace

Shot make_shot(const Setting& setting) {
    return load(setting).shot;
}

std::vector<std::vector<RobotState>> unhindered_flight(const Setting& setting) {
    const Loaded loaded = load(setting);
    const auto model = without_collisions(loaded.shot.world, Flight::kFine);
    std::vector<std::vector<RobotState>> way{loaded.states};
    StepScratch scratch;
    const auto ticks = static_cast<Tick>(loaded.shot.flight_s / model->dt_s + 0.5);
    for (Tick t = 0; t < ticks; ++t) {
        way.push_back(way.back());
        step_all(*model, t, way.back(), scratch);
    }
    return way;
}

Flight::Flight(const Setting& setting) {
    Loaded loaded = load(setting);
    free_model_ = without_collisions(loaded.shot.world, 1);
    fine_model_ = without_collisions(loaded.shot.world, kFine);
    shot_ = std::move(loaded.shot), model_ = std::move(loaded.model), states_ = std::move(loaded.states);
}

void Flight::step() {
    before_ = unhindered_ = states_;
    step_all(*model_, tick_, states_, scratch_);
    step_all(*free_model_, tick_, unhindered_, free_scratch_);
    ++tick_;
}

bool Flight::finite() const {
    return !find_not_finite(states_).valid();
}

std::vector<std::vector<RobotState>> Flight::fine_way() const {
    std::vector<std::vector<RobotState>> way{before_};
    for (int i = 0; i < kFine; ++i) {
        way.push_back(way.back());
        step_all(*fine_model_, i, way.back(), free_scratch_);
    }
    return way;
}

double Flight::turn(const std::vector<RobotState>& states) const {
    double most = 0;
    for (std::size_t r = 0; r < states.size(); ++r) {
        const RobotType& type = model_->type_of(RobotId(r));
        for (std::size_t k = 0; k < states[r].v.size(); ++k)
            if (!type.free_base || k < 3 || k > 5) most = std::fmax(most, std::fabs(states[r].v[k]));
    }
    return most * model_->dt_s;
}

double Flight::change() const {
    double most = 0;
    for (std::size_t r = 0; r < states_.size(); ++r) {
        const RobotState &is = states_[r], &was = unhindered_[r];
        if (is.q == was.q && is.v == was.v) continue;
        most = std::fmax(most, 1e-300);  // a bit of a position at least
        for (std::size_t i = 0; i < is.v.size(); ++i) most = std::fmax(most, std::fabs(is.v[i] - was.v[i]));
    }
    return most;
}

}  // namespace roboss::fuzz
