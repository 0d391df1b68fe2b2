// See mjcf.h. All numbers with 17 digits; bodies are numbered in the order of writing, as MuJoCo does.
#include "engines/mjcf.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <numbers>
#include <span>
#include <vector>

namespace roboss::bench {
namespace {

std::string attribute(const char* name, std::span<const double> values) {
    std::string text = std::string(" ") + name + "=\"";
    char buffer[40];
    for (double x : values) {
        std::snprintf(buffer, sizeof buffer, "%.17g ", x);
        text += buffer;
    }
    text.back() = '"';
    return text;
}
std::string attribute(const char* name, std::initializer_list<double> values) {
    return attribute(name, std::span(values.begin(), values.size()));
}

std::string pose(const Pose& X) {
    return attribute("pos", {X.p.x, X.p.y, X.p.z}) + attribute("quat", {X.q.w, X.q.x, X.q.y, X.q.z});
}

/// A mesh over a regular grid, as its heights: of other meshes MuJoCo takes the convex hull. Its vertices go
/// row by row.
std::shared_ptr<const HeightGridSpec> grid_of(const MeshSpec& mesh) {
    const std::vector<Vec3>& v = mesh.vertices;
    std::size_t columns = 1;
    while (columns < v.size() && v[columns].y == v[0].y) ++columns;
    if (columns < 2 || v.size() % columns != 0 || v.size() < 2 * columns) return nullptr;
    auto grid = std::make_shared<HeightGridSpec>();
    grid->source = mesh.source, grid->columns = columns, grid->rows = v.size() / columns;
    grid->size_x = v.back().x - v[0].x, grid->size_y = v.back().y - v[0].y;
    grid->centre = {0.5 * (v[0].x + v.back().x), 0.5 * (v[0].y + v.back().y), 0};
    for (std::size_t k = 0; k < v.size(); ++k) {
        const auto i = static_cast<double>(k % columns), j = static_cast<double>(k / columns);
        const double x = v[0].x + grid->size_x * i / static_cast<double>(columns - 1),
                     y = v[0].y + grid->size_y * j / static_cast<double>(grid->rows - 1);
        constexpr double kSame = 1e-9;  // m
        if (std::fabs(v[k].x - x) > kSame || std::fabs(v[k].y - y) > kSame) return nullptr;
        grid->heights.push_back(v[k].z);
    }
    return grid;
}

std::shared_ptr<const HeightGridSpec> heights_of(const GeometrySpec& g) {
    if (g.kind == GeometryKind::kHeightmap) return g.heights;
    return g.kind == GeometryKind::kMesh && g.mesh && !g.as_hull ? grid_of(*g.mesh) : nullptr;
}

class Writer {
  public:
    Writer(const World& world, const MjcfOptions& options) : world_(world), options_(options) {}

    std::optional<MjcfPlaces> write() {
        for (const ModelInstance& instance : world_.instances) {
            places_.instances.emplace_back();
            place_ = &places_.instances.back();
            model_ = &world_.prototypes[instance.prototype];
            place_->assembly = assemble(*model_);
            instance_body(instance);
        }
        if (!expressible_) return std::nullopt;
        places_.xml = head() + "<asset>\n" + assets_ + "</asset>\n<worldbody>\n" + bodies_ +
                      "</worldbody>\n<contact>\n" + excludes_ + "</contact>\n<equality>\n" + equalities_ +
                      "</equality>\n</mujoco>\n";
        return std::move(places_);
    }

  private:
    std::string head() const {
        const Vec3& g = world_.gravity;
        return "<mujoco>\n<compiler angle=\"radian\" balanceinertia=\"false\" boundmass=\"0\" "
               "boundinertia=\"0\"/>\n" +
               sizes() + "<option integrator=\"" + options_.integrator + "\" solver=\"" + options_.solver +
               "\" cone=\"" + options_.cone + "\" jacobian=\"" + options_.jacobian + "\" iterations=\"" +
               std::to_string(options_.iterations) + "\"" + attribute("timestep", {options_.dt_s}) +
               attribute("tolerance", {options_.tolerance}) + attribute("impratio", {options_.impratio}) +
               attribute("gravity", {g.x, g.y, g.z}) + ">" +
               (options_.speculative ? "<flag speculative=\"enable\"/>" : "") +
               (options_.sleep ? "<flag sleep=\"enable\"/>" : "") + "</option>\n";
    }

    std::string sizes() const {
        if (options_.memory_bytes > 0)
            return "<size memory=\"" + std::to_string(options_.memory_bytes) + "\"/>\n";
        return "<size njmax=\"" + std::to_string(options_.rows_max) + "\" nconmax=\"" +
               std::to_string(options_.contacts_max) + "\" nstack=\"" +
               std::to_string(options_.stack_numbers) + "\"/>\n";
    }

    void instance_body(const ModelInstance& instance) {
        const Assembly& assembly = place_->assembly;
        place_->first_body = next_body_;
        place_->joints.resize(model_->joints.size());
        for (std::size_t j = 0; j < model_->joints.size(); ++j)
            place_->joints[j].assign(std::max<std::size_t>(model_->joints[j].axes.size(), 1), -1);
        place_->free_joints.assign(assembly.bodies.size(), -1);
        for (const PartShape& shape : assembly.scenery) geometry(shape, instance.X_WM);
        for (std::size_t b = 0; b < assembly.bodies.size(); ++b)
            if (parent_of(b) < 0) body(b, instance.X_WM);
        exclude();
        for (const PartJoint& joint : assembly.joints)
            if (joint.closes_loop) close_loop(joint);
    }

    int parent_of(std::size_t b) const {
        const int joint = place_->assembly.bodies[b].joint;
        return joint < 0 ? -1 : place_->assembly.joints[static_cast<std::size_t>(joint)].parent;
    }

    /// The body and what hangs on it; X_PM: the model frame in the parent's.
    void body(std::size_t b, const Pose& X_PM) {
        const PartBody& part = place_->assembly.bodies[b];
        expressible_ &= part.gravity && part.mass > 0;
        const int id = place_->first_body + static_cast<int>(b);
        expressible_ &= id == next_body_++;  // the assembly is depth first, so the numbers agree
        bodies_ += "<body name=\"b" + std::to_string(id) + "\"" + pose(X_PM * part.X_MB) + ">\n";
        if (part.joint < 0) {
            place_->free_joints[b] = next_joint_++;
            bodies_ += "<freejoint/>\n";
        } else {
            joint(part, place_->assembly.joints[static_cast<std::size_t>(part.joint)]);
        }
        const PrincipalAxes axes = principal_axes(part.inertia_C);
        const Vec3& m = axes.moments;
        bodies_ += "<inertial" + attribute("mass", {part.mass}) + pose({part.p_BC, to_quat(axes.R)}) +
                   attribute("diaginertia", {m.x, m.y, m.z}) + "/>\n";
        for (const PartShape& shape : part.shapes) geometry(shape, {});
        for (std::size_t c = b + 1; c < place_->assembly.bodies.size(); ++c)
            if (parent_of(c) == static_cast<int>(b)) body(c, inverse(part.X_MB));
        bodies_ += "</body>\n";
    }

    void joint(const PartBody& part, const PartJoint& joint) {
        const JointSpec& spec = *joint.spec;
        const Pose X_BJ = inverse(part.X_MB) * spec.X_MJ;
        const std::string pos = attribute("pos", {X_BJ.p.x, X_BJ.p.y, X_BJ.p.z});
        if (spec.kind == JointSpecKind::kBall) {
            place_->joints[joint.index][0] = next_joint_++;
            bodies_ += "<joint type=\"ball\"" + pos + "/>\n";
            return;
        }
        expressible_ &= spec.kind != JointSpecKind::kScrew && spec.kind != JointSpecKind::kPlanar;
        for (std::size_t a = 0; a < spec.axes.size(); ++a) {
            const std::size_t pick = joint.reversed ? spec.axes.size() - 1 - a : a;
            place_->joints[joint.index][pick] = next_joint_++;
            const char* type = spec.kind == JointSpecKind::kPrismatic ? "slide" : "hinge";
            const Vec3 d = rotate(X_BJ.q, joint.reversed ? -spec.axes[pick].xyz : spec.axes[pick].xyz);
            bodies_ += std::string("<joint type=\"") + type + "\"" + pos +
                       attribute("axis", {d.x, d.y, d.z}) + axis_attributes(spec, spec.axes[pick]) + "/>\n";
        }
    }

    std::string axis_attributes(const JointSpec& spec, const AxisSpec& axis) const {
        std::string text = attribute("damping", {axis.damping}) + attribute("armature", {axis.armature}) +
                           attribute("stiffness", {axis.spring_stiffness}) +
                           attribute("springref", {axis.spring_reference}) +
                           attribute("frictionloss", {axis.friction});
        const bool limited = spec.kind != JointSpecKind::kContinuous && axis.lower > -1e15;
        if (limited)
            text += " limited=\"true\"" + attribute("range", {axis.lower, axis.upper}) +
                    attribute("solreflimit", {options_.contact_time_s, 1.0});
        return text;
    }

    void geometry(const PartShape& shape, const Pose& X_PB) {
        const GeometrySpec& g = shape.collision->geometry;
        if (const auto heights = heights_of(g)) return height_field(shape, heights, X_PB);
        bodies_ += "<geom" + pose(X_PB * shape.X_BS) + surface(shape.collision->surface);
        const double half = 0.5 * g.length;
        switch (g.kind) {
            case GeometryKind::kPlane:
                bodies_ += " type=\"plane\"" + attribute("size", {0.0, 0.0, 1.0});
                break;
            case GeometryKind::kBox:
                bodies_ += " type=\"box\"" + attribute("size", {g.size.x / 2, g.size.y / 2, g.size.z / 2});
                break;
            case GeometryKind::kSphere:
                bodies_ += " type=\"sphere\"" + attribute("size", {g.radius});
                break;
            case GeometryKind::kCylinder:
                bodies_ += " type=\"cylinder\"" + attribute("size", {g.radius, half});
                break;
            case GeometryKind::kCapsule:
                bodies_ += " type=\"capsule\"" + attribute("size", {g.radius, half});
                break;
            case GeometryKind::kEllipsoid:
                bodies_ += " type=\"ellipsoid\"" + attribute("size", {g.size.x, g.size.y, g.size.z});
                break;
            case GeometryKind::kMesh:
                mesh(g);
                break;
            default:
                expressible_ = false;
        }
        bodies_ += "/>\n";
    }

    /// The hull of a mesh: all that MuJoCo makes of one. Of triangles that never move RoBOSS keeps each.
    void mesh(const GeometrySpec& g) {
        expressible_ &= g.mesh != nullptr && (g.as_hull || !model_->is_static);
        if (!expressible_) return;
        const auto [entry, is_new] = meshes_.try_emplace(g.mesh.get(), "m" + std::to_string(meshes_.size()));
        bodies_ += " type=\"mesh\" mesh=\"" + entry->second + "\"";
        if (!is_new) return;
        std::vector<double> corners;
        for (const Vec3& v : g.mesh->vertices) corners.insert(corners.end(), {v.x, v.y, v.z});
        assets_ += "<mesh name=\"" + entry->second + "\"" + attribute("vertex", corners) + "/>\n";
    }

    /// Heights are relative to the lowest, which is where the geom is.
    void height_field(const PartShape& shape, const std::shared_ptr<const HeightGridSpec>& grid,
                      const Pose& X_PB) {
        const auto [low, high] = std::ranges::minmax(grid->heights);
        const std::string name = "h" + std::to_string(places_.heights.size());
        places_.heights.push_back(grid);
        assets_ += "<hfield name=\"" + name + "\" nrow=\"" + std::to_string(grid->rows) + "\" ncol=\"" +
                   std::to_string(grid->columns) + "\"" +
                   attribute("size", {0.5 * grid->size_x, 0.5 * grid->size_y, high - low, 0.5}) + "/>\n";
        const Pose X_BH{grid->centre + Vec3{0, 0, low}, {}};
        bodies_ += "<geom type=\"hfield\" hfield=\"" + name + "\"" + pose(X_PB * shape.X_BS * X_BH) +
                   surface(shape.collision->surface) + "/>\n";
    }

    std::string surface(const SurfaceSpec& s) const {
        const int condim = s.rolling_mu > 0 ? 6 : s.torsional_mu * s.torsional_radius > 0 ? 4 : 3;
        std::string text = " condim=\"" + std::to_string(condim) + "\"" +
                           attribute("friction", {s.mu, s.torsional_mu * s.torsional_radius, s.rolling_mu}) +
                           " contype=\"" + std::to_string(s.collide_bitmask) + "\" conaffinity=\"" +
                           std::to_string(s.collide_bitmask) + "\"";
        if (s.restitution > 0) {  // the bouncier of two surfaces decides
            const SolverReference reference = bouncing_reference(s.restitution, options_.dt_s);
            return text + " priority=\"1\"" + attribute("solref", {reference.time_s, reference.ratio});
        }
        return text + attribute("solref", {options_.contact_time_s, 1.0});
    }

    /// Bodies of one model do not meet, unless it says so. MuJoCo leaves out only parent and child.
    void exclude() {
        const auto& bodies = place_->assembly.bodies;
        if (model_->self_collide) return;
        for (std::size_t a = 0; a < bodies.size(); ++a)
            for (std::size_t b = a + 1; b < bodies.size(); ++b) {
                const bool bare = bodies[a].shapes.empty() || bodies[b].shapes.empty();
                if (bare || parent_of(b) == static_cast<int>(a)) continue;
                excludes_ += "<exclude body1=\"b" + std::to_string(place_->first_body + static_cast<int>(a)) +
                             "\" body2=\"b" + std::to_string(place_->first_body + static_cast<int>(b)) +
                             "\"/>\n";
            }
    }

    /// A hinge is held at two points of its axis, a ball joint at one.
    void close_loop(const PartJoint& joint) {
        const JointSpec& spec = *joint.spec;
        const bool hinge = spec.kind == JointSpecKind::kRevolute || spec.kind == JointSpecKind::kContinuous;
        expressible_ &= joint.parent >= 0 && (hinge || spec.kind == JointSpecKind::kBall);
        if (!expressible_) return;
        const PartBody& parent = place_->assembly.bodies[static_cast<std::size_t>(joint.parent)];
        for (double shift : {-0.05, 0.05}) {
            const Vec3 along = hinge ? spec.axes[0].xyz * shift : Vec3{};
            const Vec3 p = inverse(parent.X_MB) * (spec.X_MJ * along);
            equalities_ += "<connect body1=\"b" + std::to_string(place_->first_body + joint.parent) + "\"";
            if (joint.child >= 0)
                equalities_ += " body2=\"b" + std::to_string(place_->first_body + joint.child) + "\"";
            equalities_ += attribute("anchor", {p.x, p.y, p.z}) +
                           attribute("solref", {options_.contact_time_s, 1.0}) + "/>\n";
            if (!hinge) break;
        }
    }

    const World& world_;
    const MjcfOptions& options_;
    const ModelSpec* model_ = nullptr;
    MjcfPlaces::Instance* place_ = nullptr;
    MjcfPlaces places_;
    std::map<const MeshSpec*, std::string> meshes_;  // names
    std::string assets_, bodies_, excludes_, equalities_;
    int next_body_ = 1, next_joint_ = 0;
    bool expressible_ = true;
};

}  // namespace

SolverReference bouncing_reference(double restitution, double dt_s) {
    // A damped oscillator that comes back with e = exp(-pi z / sqrt(1 - z^2)).
    const double log_e = std::log(std::clamp(restitution, 1e-3, 0.999));
    const double ratio = -log_e / std::hypot(log_e, std::numbers::pi);
    const double omega = 0.1 / dt_s;  // some thirty steps a contact: fewer lose the bounce
    return {1.0 / (ratio * omega), ratio};
}

std::optional<MjcfPlaces> write_mjcf(const World& world, const MjcfOptions& options) {
    return Writer(world, options).write();
}

}  // namespace roboss::bench
