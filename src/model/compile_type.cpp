// Builds the dynamics tree of one robot: spanning tree over the joints, links welded into bodies, all poses
// taken at the zero configuration in the SDF model frame, where every joint frame coincides in parent and
// child.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "model/compile_loops.h"
#include "model/compile_type.h"
#include "model/joint_graph.h"
#include "model/joint_motion.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

/// A rotation by quarter turns that only rounding keeps from being one.
Mat3 without_rounding(const Mat3& R) {
    constexpr double kRounding = 4e-15;  // of quaternions, their matrices and a product
    Mat3 whole;
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            whole(i, j) = std::nearbyint(R(i, j)) + 0.0;  // no negative zeros
            error = std::max(error, std::fabs(R(i, j) - whole(i, j)));
        }
    }
    return error <= kRounding ? whole : R;
}

/// Pose of frame B in frame A, both given in the model frame.
Transform between(const Transform& X_MA, const Transform& X_MB) {
    Transform X_AB = inverse(X_MA) * X_MB;
    X_AB.R = without_rounding(X_AB.R);
    return X_AB;
}

/// Builds one RobotType by walking the joint graph from its root.
class PartBuilder {
  public:
    PartBuilder(const ModelSpec& spec, const Surroundings& around, const JointGraph& graph,
                const std::vector<CouplingSpec>& couplings, ShapeStore& shapes, Diagnostics& diagnostics)
        : spec_(spec),
          around_(around),
          graph_(graph),
          couplings_(couplings),
          shapes_(shapes),
          diagnostics_(diagnostics) {}

    CompiledPart build(const std::vector<std::size_t>& links, bool fixed_base, bool is_main) {
        links_ = &links;
        RobotType& type = part_.type;
        type.name = spec_.name;
        type.free_base = !fixed_base;
        type.self_collide = spec_.self_collide;
        type.may_sleep = spec_.may_sleep;
        type.kinematic = spec_.kinematic && fixed_base;
        body_of_link_.assign(spec_.links.size() + 1, kUnplaced);
        hangs_on_.assign(spec_.links.size() + 1, {});
        X_MB_.clear();
        joint_done_.assign(spec_.joints.size(), 0);
        const std::size_t root = fixed_base ? graph_.world : pick_root();
        const std::size_t name_link = fixed_base ? links.front() : root;
        part_.suffix = is_main ? "" : "::" + spec_.links[name_link].name;
        if (fixed_base) {
            body_of_link_[root] = -1;
        } else {
            add_free_base(root, is_main);
        }
        walk(root);
        if (!report_long_chains(type, spec_, diagnostics_)) return std::move(part_);
        type.paths = DofPaths(type.dof_parent);
        for (std::size_t j : graph_.cut) add_loop(j);
        add_couplings(couplings_, type, diagnostics_);
        add_links();
        turn_directions();
        add_onboard(spec_, is_main, part_.type, diagnostics_);
        if (around_.wind != nullptr) add_wind(*around_.wind, part_.type);
        mend_inertia(part_.type, spec_, links, diagnostics_);
        finish();
        return std::move(part_);
    }

  private:
    static constexpr int kUnplaced = -2;

    std::size_t pick_root() const {
        std::optional<std::size_t> orphan;
        for (std::size_t l : *links_) {
            if (graph_.is_child[l]) continue;
            if (spec_.links[l].name == spec_.canonical_link) return l;
            if (!orphan) orphan = l;
        }
        return orphan ? *orphan : links_->front();
    }

    void add_free_base(std::size_t root, bool is_main) {
        Body body;
        body.nv = 6;
        const Pose& X_ML = spec_.links[root].X_ML;
        part_.X_MR = is_main ? Pose{} : X_ML;
        part_.type.X_RB = is_main ? to_transform(X_ML) : Transform{};
        part_.type.bodies.push_back(body);
        part_.type.nv = 6;
        part_.type.dof_parent = {-1, 0, 1, 2, 3, 4};
        X_MB_.push_back(to_transform(X_ML));
        body_of_link_[root] = 0;
    }

    /// Depth first, joints in file order; parents come before children in `bodies`.
    void walk(std::size_t root) {
        struct Visit {
            std::size_t node, edge = 0;  // the next one
        };
        std::vector<Visit> path{{root}};
        while (!path.empty()) {
            const std::size_t node = path.back().node;
            if (path.back().edge == graph_.edges[node].size()) {
                path.pop_back();
                continue;
            }
            const JointEdge& edge = graph_.edges[node][path.back().edge++];
            if (joint_done_[edge.joint]) continue;
            if (node == graph_.world && !in_part(edge.to)) continue;
            joint_done_[edge.joint] = 1;
            hangs_on_[edge.to] = {static_cast<int>(part_.type.joints.size()), id_in_part(node)};
            body_of_link_[edge.to] = add_joint(edge, body_of_link_[node]);
            path.push_back({edge.to});
        }
    }

    bool in_part(std::size_t link) const { return std::binary_search(links_->begin(), links_->end(), link); }

    /// Of a link of the file, in RobotType::links; -1: the world.
    int id_in_part(std::size_t node) const {
        if (node == graph_.world) return -1;
        return static_cast<int>(std::lower_bound(links_->begin(), links_->end(), node) - links_->begin());
    }

    /// Where a body's frame stands in the model frame at the zero configuration.
    Transform placed(int body) const {
        return body < 0 ? Transform{} : X_MB_[static_cast<std::size_t>(body)];
    }

    void add_loop(std::size_t index) {
        const JointSpec& spec = spec_.joints[index];
        const auto [parent, child] = *graph_.ends[index];
        if (!in_part(child)) return;
        RobotType& type = part_.type;
        Joint joint;
        joint.name = spec.name;
        joint.kind = spec.kind;
        const int body_a = body_of_link_[parent], body_b = body_of_link_[child];
        if (body_a == body_b) {  // other joints weld the two links together
            if (!joint_type(spec.kind).welds()) report_immobile(spec, spec_.name, diagnostics_);
            type.joints.push_back(joint);
            return;
        }
        LoopJoint loop = to_loop_joint(spec, placed(body_a), placed(body_b));
        loop.joint = JointId(type.joints.size());
        loop.body_a = body_a, loop.body_b = body_b;
        loop.link_a = id_in_part(parent), loop.link_b = id_in_part(child);
        loop.motor_index = static_cast<int>(type.motor_count());
        for (Dof& dof : loop.dofs) dof.body = body_b, dof.joint = loop.joint;
        joint.nv = static_cast<int>(loop.dofs.size());
        joint.loop = static_cast<int>(type.loops.size());
        type.joints.push_back(joint);
        type.loops.push_back(loop);
        report_loop(spec, spec_, diagnostics_);
    }

    /// The numbers of motion k; nullopt: the file's joint lacks them.
    static std::optional<AxisSpec> axis_of(const JointSpec& spec, const JointType& type, std::size_t k) {
        if (!type.is_isotropic()) return k < spec.axes.size() ? std::optional(spec.axes[k]) : std::nullopt;
        AxisSpec each;
        each.damping = spec.ball_damping;
        each.armature = spec.ball_armature;
        return each;
    }

    int add_joint(const JointEdge& edge, int parent_body) {
        const JointSpec& spec = spec_.joints[edge.joint];
        Joint joint;
        joint.name = spec.name;
        joint.kind = spec.kind;
        joint.reversed = edge.reversed;
        const JointId id(part_.type.joints.size());
        int body = parent_body;
        const JointType& type = joint_type(spec.kind);
        for (std::size_t k = 0; k < type.motions.size(); ++k) {
            const std::size_t pick = edge.reversed ? type.motions.size() - 1 - k : k;
            if (const auto axis = axis_of(spec, type, pick))
                body = add_body(body, spec, type.motions[pick], *axis, edge.reversed, id, joint);
        }
        joint.body = body == parent_body ? -1 : body;
        if (joint.body < 0) joint.p_BJ = inverse(placed(body)) * spec.X_MJ.p;
        part_.type.joints.push_back(joint);
        return body;
    }

    int add_body(int parent, const JointSpec& spec, JointKind kind, const AxisSpec& axis, bool reversed,
                 JointId id, Joint& joint) {
        RobotType& type = part_.type;
        const Transform X_MJ = to_transform(spec.X_MJ);
        Body body;
        body.parent = parent;
        body.joint = kind;
        body.X_PJ = parent < 0 ? X_MJ : between(X_MB_[static_cast<std::size_t>(parent)], X_MJ);
        body.axis_J = reversed ? -axis.xyz : axis.xyz;
        const JointTraits& traits = joint_traits(kind);
        if (traits.has_pitch) body.pitch = spec.screw_pitch;
        body.reversed_ball = reversed && traits.is_quaternion;
        body.q_index = type.nq;
        body.v_index = type.nv;
        body.nv = traits.nv;
        if (joint.v_index < 0) joint.q_index = body.q_index, joint.v_index = body.v_index;
        joint.nv += body.nv;
        const int index = static_cast<int>(type.bodies.size());
        const int parent_dof = parent < 0 ? -1 : last_dof(type.bodies[static_cast<std::size_t>(parent)]);
        for (int k = 0; k < body.nv; ++k) {
            type.dof_parent.push_back(k == 0 ? parent_dof : type.nv + k - 1);
            type.dofs.push_back(to_dof(axis, joint_type(spec.kind).endless));
            type.dofs.back().body = index, type.dofs.back().joint = id;
        }
        if (traits.is_quaternion) {
            type.initial_q.insert(type.initial_q.end(), {1.0, 0.0, 0.0, 0.0});
        } else {
            type.initial_q.push_back(axis.initial_position);
        }
        type.nq += traits.nq;
        type.nv += body.nv;
        type.bodies.push_back(body);
        X_MB_.push_back(X_MJ);
        return index;
    }

    static int last_dof(const Body& body) { return body.v_index + body.nv - 1; }

    void add_links() {
        for (std::size_t l : *links_) {
            const LinkSpec& spec = spec_.links[l];
            const int body = body_of_link_[l];
            Link link =
                to_link(spec, body,
                        body < 0 ? to_transform(spec.X_ML)
                                 : between(X_MB_[static_cast<std::size_t>(body)], to_transform(spec.X_ML)));
            link.carrier = hangs_on_[l].joint, link.parent = hangs_on_[l].parent;
            const LinkId id(part_.type.links.size());
            if (body >= 0) add_mass(part_.type.bodies[static_cast<std::size_t>(body)], link);
            const std::vector<std::size_t> shapes = add_shapes(spec, link, id);
            if (spec.drag.acts && body >= 0) part_.type.drags.push_back(drag_of(spec, id));
            add_fluid(spec, id, body);
            for (const SensorSpec& sensor : spec.sensors)
                part_.type.sensors.push_back({with_chosen_shapes(sensor, spec, shapes, diagnostics_), id});
            part_.type.links.push_back(link);
        }
    }

    /// Where the world has Gazebo's wind, that carries links in proportion to their mass; the areas of shapes
    /// count only where the file writes them.
    LinkDrag drag_of(const LinkSpec& spec, LinkId id) const {
        LinkDrag drag{id, drag_area(spec), spec.drag.linear, spec.drag.wind};
        if (!drag.wind || around_.wind == nullptr) return drag;
        if (spec.drag.area < 0 && spec.drag.coefficient < 0) drag.area = {};
        if (around_.wind->regions.empty())
            drag.linear += spec.mass * around_.wind->scale;
        else
            drag.carried = spec.mass;
        return drag;
    }

    void add_fluid(const LinkSpec& spec, LinkId id, int body) {
        const bool floats = around_.has_fluid && spec.buoyant && !spec.collisions.empty();
        if (body >= 0 && (floats || !spec.added_mass.empty()))
            part_.type.fluids.push_back({id, floats, spec.added_mass});
    }

    /// Returns how many shapes each collision became.
    std::vector<std::size_t> add_shapes(const LinkSpec& spec, const Link& link, LinkId id) {
        std::vector<std::size_t> counts;
        for (const CollisionSpec& collision : spec.collisions) {
            const std::size_t first = part_.type.shapes.size();
            for (const PlacedShape& placed : shapes_.shapes_of(collision, false)) {
                BodyShape shape;
                shape.shape = placed.shape;
                shape.body = link.body;
                shape.link = id;
                shape.X_BS = link.X_BL * to_transform(collision.X_LS);
                shape.X_BS.p += shape.X_BS.R * placed.p_CS;
                shape.material = to_material(collision.surface);
                if (!collision.surface.fdir1_link.empty())
                    turned_.emplace_back(part_.type.shapes.size(), collision.surface.fdir1_link);
                shape.moves = collision.moves;
                shape.laser_retro = collision.laser_retro;
                part_.type.shapes.push_back(shape);
            }
            counts.push_back(part_.type.shapes.size() - first);
        }
        return counts;
    }

    /// Friction directions that are written in the frame of another link: it is in the same nested model.
    void turn_directions() {
        for (const auto& [index, name] : turned_) {
            RobotType& type = part_.type;
            BodyShape& shape = type.shapes[index];
            const std::string& own = type.links[shape.link.index()].name;
            const std::size_t scope = own.rfind("::");
            std::optional<LinkId> id;
            if (scope != std::string::npos) id = type.find_link(own.substr(0, scope + 2) + name);
            if (!id) id = type.find_link(name);
            if (!id) continue;
            const Link& link = type.links[id->index()];
            Vec3& direction = shape.material.direction_S;
            direction = link.X_BL.R * direction;
            if (link.body == shape.body)
                direction = transpose_times(shape.X_BS.R, direction);
            else if (link.body >= 0)
                shape.direction_body = link.body;
        }
    }

    void finish() {
        RobotType& type = part_.type;
        check_joints_read(type, spec_.name + part_.suffix, diagnostics_);
        report_powerless(type, spec_, diagnostics_);
        for (const Body& body : type.bodies) type.mass += body.mass;
        type.reach = reach_of(type);
        if (type.self_collide) type.self_pairs = self_pairs_of(type, &spec_);
        close_start(spec_, type, diagnostics_);
        compute_mobility(type);
        type.hash = type_hash(type);
    }

    const ModelSpec& spec_;
    const Surroundings& around_;
    const JointGraph& graph_;
    const std::vector<CouplingSpec>& couplings_;
    std::vector<std::pair<std::size_t, std::string>> turned_;  // shapes, links that their directions are in
    ShapeStore& shapes_;
    Diagnostics& diagnostics_;
    CompiledPart part_;
    const std::vector<std::size_t>* links_ = nullptr;
    std::vector<int> body_of_link_;  // last: the world
    struct Hold {
        int joint = -1, parent = -1;
    };
    std::vector<Hold> hangs_on_;   // Link::carrier and parent
    std::vector<Transform> X_MB_;  // body frames in the model frame at the zero configuration
    std::vector<char> joint_done_;
};

/// The links that follow each other through couplings of their joints.
std::vector<std::pair<std::size_t, std::size_t>> coupled_links(const ModelSpec& spec, const JointGraph& graph,
                                                               const std::vector<CouplingSpec>& couplings) {
    const auto moved_by = [&](const std::string& name) -> std::optional<std::size_t> {
        const auto joint = std::ranges::find(spec.joints, name, &JointSpec::name);
        if (joint == spec.joints.end()) return std::nullopt;
        const auto& ends = graph.ends[static_cast<std::size_t>(joint - spec.joints.begin())];
        return ends ? std::optional(ends->child) : std::nullopt;
    };
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const CouplingSpec& coupling : couplings) {
        const auto follower = moved_by(coupling.follower), leader = moved_by(coupling.leader);
        if (follower && leader) pairs.emplace_back(*follower, *leader);
    }
    return pairs;
}

}  // namespace

void float_all(RobotType& type) {
    for (const BodyShape& shape : type.shapes) {
        if (shape.body < 0) continue;
        const auto at = std::ranges::lower_bound(type.fluids, shape.link, {}, &LinkFluid::link);
        if (at != type.fluids.end() && at->link == shape.link)
            at->buoyant = true;
        else
            type.fluids.insert(at, {shape.link, true, {}});
    }
}

std::vector<CompiledPart> compile_parts(const ModelSpec& spec, const Surroundings& around, ShapeStore& shapes,
                                        Diagnostics& diagnostics) {
    const JointGraph graph = build_joint_graph(spec);
    const std::vector<CouplingSpec> couplings = find_couplings(spec, diagnostics);
    std::vector<CompiledPart> parts;
    for (const LinkedPart& part : connected_parts(graph, coupled_links(spec, graph, couplings))) {
        const bool is_main = std::ranges::any_of(
            part.links, [&](std::size_t i) { return spec.links[i].name == spec.canonical_link; });
        parts.push_back(PartBuilder(spec, around, graph, couplings, shapes, diagnostics)
                            .build(part.links, part.fixed_base, is_main || spec.canonical_link.empty()));
    }
    const bool has_main =
        std::any_of(parts.begin(), parts.end(), [](const CompiledPart& p) { return p.suffix.empty(); });
    if (!has_main && !parts.empty()) parts.front().suffix.clear();
    if (parts.size() > 1)
        diagnostics.note(spec.where, "unconnected-parts",
                         "model '" + spec.name + "' has " + std::to_string(parts.size()) +
                             " parts that no joint connects; each is a robot of its own (" + spec.name +
                             parts.back().suffix + " ...)",
                         "connect them with a fixed joint if they are one body");
    return parts;
}

}  // namespace roboss
