// Equalities hold between parts of one robot, or with the world where the robot is fixed to it. RoBOSS has no
// joints between robots, so those between free bodies have no effect, with a warning.
#include <algorithm>
#include <set>

#include "mjcf/equalities.h"
#include "world/joint_type.h"

namespace roboss::mjcf {
namespace {

/// The two ends of a <connect> or <weld>: bodies, and the joint's frame in each of them.
struct Ends {
    std::size_t first = 0, second = 0;
    Pose X_first, X_second;
};

/// Pose of a body in the world where the file places it, with all joints at `ref`.
Pose pose_in_file(const Tree& tree, std::size_t body) {
    Pose X;
    for (; body != 0; body = tree.bodies[body].parent) X = tree.bodies[body].X_PB * X;
    return X;
}

bool is_active(const Attributes& source, const Reading& reading) {
    return reading.settings.equalities && source.boolean("active", true);
}

/// The two joints that a <joint> ties; none where the file lacks one.
struct TiedJoints {
    std::optional<Tree::JointPlace> first, second;
    explicit operator bool() const { return first && second; }
};

TiedJoints tied_joints(const Attributes& source, const Tree& tree, const Reading& reading) {
    const auto find = [&](const char* attribute) {
        return tree.find_joint(reading.names.full(source.text(attribute)));
    };
    return {find("joint1"), find("joint2")};
}

class EqualityReader {
  public:
    EqualityReader(const Tree& tree, const Reading& reading)
        : tree_(tree), r_(reading), roots_(Robots::roots_in(tree)), fates_(Robots::fates_in(tree, roots_)) {}

    /// The bodies of the two joints that an active <joint> ties, if the file has both.
    std::optional<std::pair<std::size_t, std::size_t>> bodies_of_joints(const Element& element) const {
        if (std::string(element.node.name()) != "joint") return std::nullopt;
        const Attributes source = r_.defaults.of(element);
        const TiedJoints joints = tied_joints(source, tree_, r_);
        if (!is_active(source, r_) || !joints) return std::nullopt;
        return std::pair{joints.first->body, joints.second->body};
    }

    /// Of a <connect> or <weld> that takes effect. Problems are reported if `tells`.
    std::optional<Ends> ends_of(const Element& element, bool tells) const {
        const std::string kind = element.node.name();
        if (kind != "connect" && kind != "weld") return std::nullopt;
        const Attributes source = r_.defaults.of(element);
        if (!is_active(source, r_)) return std::nullopt;
        const auto found = source.has("site1") ? by_sites(source, tells) : by_bodies(source, tells);
        if (!found) return std::nullopt;
        if (can_tie(*found)) return found;
        if (tells)
            r_.warn(element.where(), "between-robots",
                    "<" + kind + "> between two robots, or between a free body and the world, has no effect",
                    "Make them one tree of bodies, or hold them together by orders (attach).");
        return std::nullopt;
    }

  private:
    std::optional<Ends> by_bodies(const Attributes& source, bool tells) const {
        Ends ends;
        const BodyPart* first = body(source, "body1", tells);
        const BodyPart* second = source.has("body2") ? body(source, "body2", tells) : &tree_.bodies.front();
        if (first == nullptr || second == nullptr) return std::nullopt;
        ends.first = tree_.index_of(*first), ends.second = tree_.index_of(*second);
        const Pose X_12 = inverse(pose_in_file(tree_, ends.first)) * pose_in_file(tree_, ends.second);
        if (std::string(source.element().node.name()) == "connect") {  // the anchor is in the first body
            ends.X_first = {source.vector("anchor", {}), {}};
            ends.X_second = inverse(X_12) * ends.X_first;
            return ends;
        }
        double rel[7] = {0, 1, 0, 0, 0, 0, 0};  // position and quaternion of the second body in the first one
        source.numbers("relpose", rel);
        const bool given = rel[3] != 0 || rel[4] != 0 || rel[5] != 0 || rel[6] != 0;
        const Pose X_rel =
            given ? Pose{{rel[0], rel[1], rel[2]}, normalized(Quat{rel[3], rel[4], rel[5], rel[6]})} : X_12;
        ends.X_second = {source.vector("anchor", {}), {}};
        ends.X_first = X_rel * ends.X_second;
        return ends;
    }

    std::optional<Ends> by_sites(const Attributes& source, bool tells) const {
        const auto first = tree_.find_site(r_.names.full(source.text("site1"))),
                   second = tree_.find_site(r_.names.full(source.text("site2")));
        if (!first || !second) {
            if (tells)
                r_.report_unknown(source.where(), {source.text("site1"), source.text("site2")},
                                  "unknown-site", "an equality names a site that the file does not have",
                                  "Check site1 and site2.");
            return std::nullopt;
        }
        return Ends{first->body, second->body, tree_.bodies[first->body].sites[first->site].X_BS,
                    tree_.bodies[second->body].sites[second->site].X_BS};
    }

    const BodyPart* body(const Attributes& source, const char* attribute, bool tells) const {
        const BodyPart* found = tree_.find_body(r_.names.full(source.text(attribute)));
        if (found == nullptr && tells)
            r_.report_unknown(
                source.where(), {source.text(attribute)}, "unknown-body",
                "an equality names the body '" + source.text(attribute) + "', which the file does not have",
                "Check the name.");
        return found;
    }

    /// One robot holds both, or both are robots that are fixed to the world, or one is and the other is the
    /// world.
    bool can_tie(const Ends& ends) const {
        const std::size_t a = roots_[ends.first], b = roots_[ends.second];
        const auto stands = [&](std::size_t root) { return fates_[root] == Fate::kScenery; };
        const auto fixed = [&](std::size_t root) { return fates_[root] == Fate::kFixed; };
        if (a == b) return !stands(a) && fates_[a] != Fate::kMocap;
        return (fixed(a) && (fixed(b) || stands(b))) || (stands(a) && fixed(b));
    }

    const Tree& tree_;
    const Reading& r_;
    std::vector<std::size_t> roots_;
    std::vector<Fate> fates_;
};

void add_follower(const Attributes& source, Robots& robots, const Reading& reading) {
    const auto wrong = [&](const std::string& what, const std::string& remedy) {
        reading.warn(source.where(), "ignored-element", "an equality between joints " + what, remedy);
    };
    const auto [first, second] = tied_joints(source, robots.tree(), reading);
    if (!source.has("joint2"))
        return wrong("that holds one joint still has no effect", "Leave the joint out: that welds the body.");
    if (!first || !second) {
        reading.report_unknown(source.where(), {source.text("joint1"), source.text("joint2")},
                               "unknown-joint", "an equality names a joint that the file does not have",
                               "Check joint1 and joint2.");
        return;
    }
    JointSpec *follower = robots.joint_of(*first), *leader = robots.joint_of(*second);
    if (follower == nullptr || leader == nullptr || follower->axes.empty() || leader->axes.empty() ||
        !robots.same_model(first->body, second->body))
        return wrong("that are no hinges or slides of one robot has no effect", "Drive both joints alike.");
    double c[5] = {0, 1, 0, 0, 0};
    source.overlay("polycoef", c);
    const auto ref_of = [&](const Tree::JointPlace& place) {
        return robots.tree().bodies[place.body].joints[place.joint].ref;
    };
    MimicSpec mimic;
    mimic.joint = leader->name;
    mimic.multiplier = c[1], mimic.offset = ref_of(*first) + c[0], mimic.reference = ref_of(*second);
    mimic.higher = {c[2], c[3], c[4]};
    follower->axes.front().mimic = mimic;
}

/// Where an end of the joint is fixed to its body, in the model `model` with all joints at zero.
Pose placed_in(const Robots& robots, std::size_t model, std::size_t body, const Pose& X_BJ) {
    return inverse(robots.place_of(model)) * robots.place_of(body) * robots.pose_of(body) * X_BJ;
}

void add_joint(const Element& element, const Ends& ends, Robots& robots) {
    const Tree& tree = robots.tree();
    const auto stands = [&](std::size_t body) { return robots.fate_of(body) == Fate::kScenery; };
    const std::size_t own = stands(ends.first) ? ends.second : ends.first;
    const std::size_t child = stands(ends.second) ? ends.first : ends.second,
                      parent = child == ends.first ? ends.second : ends.first;
    ModelSpec& model = robots.model_of(own);
    JointSpec joint;
    joint.kind = std::string(element.node.name()) == "weld" ? JointSpecKind::kFixed : JointSpecKind::kBall;
    joint.name = element.name().empty() ? std::string(element.node.name()) + "_" + tree.bodies[own].name
                                        : element.name();
    while (std::ranges::any_of(model.joints, [&](const JointSpec& j) { return j.name == joint.name; }))
        joint.name += "_";
    joint.parent = stands(parent) ? "world" : robots.local_name(parent);
    joint.child = robots.local_name(child);
    const Pose &X_parent = parent == ends.first ? ends.X_first : ends.X_second,
               &X_child = parent == ends.first ? ends.X_second : ends.X_first;
    joint.X_MJ = placed_in(robots, own, parent, X_parent);
    joint.X_MJ_child = placed_in(robots, own, child, X_child);
    joint.closes_loop = true;
    joint.where = element.where();
    model.joints.push_back(std::move(joint));
}

void read_part(Robots& robots, const Reading& reading) {
    const std::vector<Element> equalities = reading.document.in_sections("equality");
    if (equalities.empty()) return;
    const EqualityReader reader(robots.tree(), reading);
    for (const Element& element : equalities) {
        const Attributes source = reading.defaults.of(element);
        if (std::string(element.node.name()) == "joint" && is_active(source, reading))
            add_follower(source, robots, reading);
        if (const auto ends = reader.ends_of(element, true)) add_joint(element, *ends, robots);
    }
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> tied_bodies(const Tree& tree,
                                                             std::span<const Reading> parts) {
    const std::vector<std::size_t> roots = Robots::roots_in(tree);
    const std::vector<Fate> fates = Robots::fates_in(tree, roots);
    std::vector<std::pair<std::size_t, std::size_t>> tied;
    for (const Reading& part : parts) {
        const std::vector<Element> equalities = part.document.in_sections("equality");
        if (equalities.empty()) continue;
        const EqualityReader reader(tree, part);
        for (const Element& element : equalities) {
            auto bodies = reader.bodies_of_joints(element);
            if (const auto ends = reader.ends_of(element, false)) bodies = {ends->first, ends->second};
            if (bodies && fates[roots[bodies->first]] == Fate::kFixed &&
                fates[roots[bodies->second]] == Fate::kFixed)
                tied.emplace_back(*bodies);
        }
    }
    return tied;
}

void read_equalities(Robots& robots, std::span<const Reading> parts) {
    for (const Reading& part : parts) read_part(robots, part);
}

}  // namespace roboss::mjcf
