// Walks <worldbody>. Elements in a <frame> belong to the body around it; a <replicate> is a row of frames.
#include "mjcf/tree.h"

#include <algorithm>
#include <set>

#include "mjcf/orientation.h"

namespace roboss::mjcf {
namespace {

class TreeReader {
  public:
    explicit TreeReader(const Reading& reading) : r_(reading) {}

    Tree read() {
        BodyPart world;
        world.name = "world";
        world.where = r_.document.root().where();
        tree_.bodies.push_back(std::move(world));
        for (const Element& section : r_.document.children(r_.document.root(), "worldbody"))
            read_contents(section, 0, {});
        name_parts();
        return std::move(tree_);
    }

  private:
    /// MuJoCo numbers bodies depth first, and reads a body's own parts before its children. The order of the
    /// file does that here.
    void read_contents(const Element& parent, std::size_t body, const Scope& scope) {
        for (const Element& element : r_.document.children(parent)) {
            const std::string kind = element.node.name();
            if (kind == "body")
                read_body(element, body, scope);
            else if (kind == "frame")
                read_contents(element, body, inner(element, scope));
            else if (kind == "replicate")
                replicate(element, body, scope);
            else
                read_part(element, kind, body, scope);
        }
    }

    void read_part(const Element& element, const std::string& kind, std::size_t body, const Scope& scope) {
        const auto attributes = [&] { return r_.defaults.of(element, scope.childclass); };
        if (kind == "geom") at(body).geoms.push_back(read_geom(attributes(), scope, r_));
        if (kind == "light") at(body).lights.push_back(read_light(attributes(), scope));
        if (kind == "site")
            at(body).sites.push_back(
                {element.name() + scope.suffix, scope.X_BF * read_pose(attributes(), r_.settings)});
        if (kind == "inertial") at(body).inertial = read_inertial({{element}, r_.diagnostics}, scope, r_);
        if (kind == "joint" || kind == "freejoint") add_joint(attributes(), body, scope);
        if (kind == "attach" || kind == "composite" || kind == "flexcomp")
            r_.diagnostics.warning(
                element.where(), "ignored-element", "<" + kind + "> is not read: what it makes is missing",
                "Load the file in MuJoCo and save it, which writes out what <" + kind + "> makes.");
    }

    void add_joint(const Attributes& attributes, std::size_t body, const Scope& scope) {
        if (body == 0) {
            r_.diagnostics.error(attributes.where(), "joint-of-world", "<worldbody> has a joint",
                                 "Put it into a <body>.");
            return;
        }
        JointPart joint = read_joint(attributes, scope, r_);
        const bool is_free = joint.motion == JointMotion::kFree;
        const bool has_free =
            !at(body).joints.empty() && at(body).joints.front().motion == JointMotion::kFree;
        if (is_free && at(body).parent != 0)
            r_.diagnostics.error(
                attributes.where(), "free-joint-inside",
                "body '" + at(body).name + "' has a free joint and is not a child of <worldbody>",
                "Move the body to <worldbody>.");
        else if (has_free || (is_free && !at(body).joints.empty()))
            r_.diagnostics.error(attributes.where(), "free-joint-and-other",
                                 "body '" + at(body).name + "' has a free joint and another one",
                                 "Remove one of them.");
        else
            at(body).joints.push_back(std::move(joint));
    }

    void read_body(const Element& element, std::size_t parent, const Scope& scope) {
        const Attributes attributes({element}, r_.diagnostics);
        BodyPart body;
        body.name = element.name().empty() ? "" : element.name() + scope.suffix;
        body.has_name = !body.name.empty();
        body.copy = scope.suffix;
        body.parent = parent;
        body.X_PB = scope.X_BF * read_pose(attributes, r_.settings);
        body.mocap = attributes.boolean("mocap", false);
        const double gravcomp = attributes.number("gravcomp", 0);
        body.gravity = gravcomp != 1;
        if (gravcomp != 0 && gravcomp != 1)
            r_.diagnostics.warning(element.where(), "ignored-attribute",
                                   "gravcomp of a body is either 0 or 1 here; another value has no effect",
                                   "Write gravcomp=\"1\" for a weightless body.");
        body.where = element.where();
        if (body.mocap && parent != 0)
            r_.diagnostics.error(element.where(), "mocap-inside",
                                 "a mocap body is not a child of <worldbody>", "Move it to <worldbody>.");
        const std::size_t index = tree_.bodies.size();
        tree_.bodies.push_back(std::move(body));
        const bool masses = r_.settings.inertia_from_geom == InertiaFromGeom::kAlways ||
                            (r_.settings.inertia_from_geom == InertiaFromGeom::kAuto &&
                             r_.document.children(element, "inertial").empty());
        read_contents(element, index,
                      {attributes.text("childclass", scope.childclass), scope.suffix, {}, masses});
    }

    Scope inner(const Element& frame, const Scope& scope) const {
        const Attributes attributes({frame}, r_.diagnostics);
        return {attributes.text("childclass", scope.childclass), scope.suffix,
                scope.X_BF * read_pose(attributes, r_.settings), scope.masses};
    }

    void replicate(const Element& element, std::size_t body, const Scope& scope) {
        constexpr int kCopiesMax = 100'000;
        const Attributes attributes({element}, r_.diagnostics);
        const int count = attributes.integer("count", 0);
        if (count < 1 || count > kCopiesMax)
            return attributes.bad_value("count", "a number from 1 to 100000");
        const Vec3 offset = attributes.vector("offset", {}),
                   euler = attributes.vector("euler", {}) * r_.settings.angle_unit;
        const std::size_t digits = std::to_string(count).size();
        Vec3 pos;
        for (int i = 0; i < count; ++i) {
            const Quat q = from_euler(euler * static_cast<double>(i), r_.settings.euler_sequence);
            const std::string number = std::to_string(i);
            Scope copy{attributes.text("childclass", scope.childclass),
                       attributes.text("sep") + std::string(digits - std::min(digits, number.size()), '0') +
                           number + scope.suffix,
                       scope.X_BF * Pose{pos, q}, scope.masses};
            read_contents(element, body, copy);
            pos += rotate(q, offset);
        }
    }

    /// Parts without names get those of their body; names that are there twice are errors.
    void name_parts() {
        std::set<std::string> bodies, joints;
        for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
            BodyPart& body = at(b);
            if (body.name.empty()) body.name = unused("body_" + std::to_string(b), bodies);
            claim(body.name, "body", bodies, body.where);
        }
        for (const BodyPart& body : tree_.bodies)
            for (const JointPart& joint : body.joints)
                if (!joint.name.empty()) claim(joint.name, "joint", joints, joint.where);
        for (BodyPart& body : tree_.bodies) {
            for (JointPart& joint : body.joints)
                if (joint.name.empty()) joints.insert(joint.name = unused(body.name + "_joint", joints));
            std::set<std::string> geoms;
            for (GeomPart& geom : body.geoms)
                geoms.insert(geom.name = unused(geom.name.empty() ? "geom" : geom.name, geoms));
        }
    }

    static std::string unused(const std::string& wanted, const std::set<std::string>& taken) {
        std::string name = wanted;
        for (int number = 2; taken.count(name) > 0; ++number) name = wanted + "_" + std::to_string(number);
        return name;
    }

    void claim(const std::string& name, const char* what, std::set<std::string>& taken,
               const SourceLocation& where) {
        if (taken.insert(name).second) return;
        r_.diagnostics.error(where, "duplicate-name",
                             "two of the file's " + std::string(what) + (*what == 'b' ? "ies" : "s") +
                                 " are named '" + name + "'",
                             "Give each a name of its own.");
    }

    BodyPart& at(std::size_t body) { return tree_.bodies[body]; }

    const Reading& r_;
    Tree tree_;
};

}  // namespace

const BodyPart* Tree::find_body(const std::string& name) const {
    const auto found = std::ranges::find(bodies, name, &BodyPart::name);
    return found == bodies.end() ? nullptr : &*found;
}

std::optional<Tree::JointPlace> Tree::find_joint(const std::string& name) const {
    for (std::size_t b = 0; b < bodies.size(); ++b)
        for (std::size_t j = 0; j < bodies[b].joints.size(); ++j)
            if (bodies[b].joints[j].name == name) return JointPlace{b, j};
    return std::nullopt;
}

GeomPart* Tree::find_geom(const std::string& name) {
    for (BodyPart& body : bodies)
        for (GeomPart& geom : body.geoms)
            if (geom.name == name) return &geom;
    return nullptr;
}

std::optional<Tree::SitePlace> Tree::find_site(const std::string& name) const {
    for (std::size_t b = 0; b < bodies.size(); ++b)
        for (std::size_t s = 0; s < bodies[b].sites.size(); ++s)
            if (bodies[b].sites[s].name == name) return SitePlace{b, s};
    return std::nullopt;
}

Tree read_tree(const Reading& reading) {
    return TreeReader(reading).read();
}

}  // namespace roboss::mjcf
