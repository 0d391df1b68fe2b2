// Walks <worldbody>. Elements in a <frame> belong to the body around it; a <replicate> is a row of frames; an
// <attach> goes on in another file, or elsewhere in this one, with another Reading.
#include "mjcf/tree.h"

#include <algorithm>
#include <set>

#include "mjcf/orientation.h"
#include "mjcf/sub_models.h"

namespace roboss::mjcf {
namespace {

constexpr int kAttachDepth = 32;  // <attach>es in each other

/// Whether the file has elements that refer to parts of its bodies.
bool has_references(const Document& document) {
    return std::ranges::any_of(document.children(document.root()), [](const Element& section) {
        const std::string name = section.node.name();
        return name == "actuator" || name == "sensor" || name == "equality" || name == "contact";
    });
}

/// An element of <worldbody>, and the class that the elements around it name.
struct Place {
    Element element;
    std::string childclass;
};

/// nullopt: none of this name.
std::optional<Place> find_place(const Document& document, const Element& parent, const char* kind,
                                const std::string& name, const std::string& childclass) {
    for (const Element& element : document.children(parent)) {
        const std::string own = element.node.name();
        if (own == kind && element.name() == name) return Place{element, childclass};
        if (own != "body" && own != "frame" && own != "replicate") continue;
        const std::string inner = element.node.attribute("childclass").as_string(childclass.c_str());
        if (auto found = find_place(document, element, kind, name, inner)) return found;
    }
    return std::nullopt;
}

class TreeReader {
  public:
    TreeReader(const Reading& reading, Tree& tree, std::vector<Reading>& parts, int depth = 0)
        : r_(reading), tree_(tree), parts_(parts), depth_(depth) {}

    void read() {
        BodyPart world;
        world.name = "world";
        world.settings = &r_.settings;
        world.where = r_.document.root().where();
        tree_.bodies.push_back(std::move(world));
        read_world(0, {});
        name_parts();
        tree_.index();
    }

  private:
    void read_world(std::size_t body, const Scope& scope) {
        for (const Element& section : worlds()) read_contents(section, body, scope);
    }

    std::vector<Element> worlds() const { return r_.document.children(r_.document.root(), "worldbody"); }

    /// MuJoCo numbers bodies depth first, and reads a body's own parts before its children. The order of the
    /// file does that here.
    void read_contents(const Element& parent, std::size_t body, const Scope& scope) {
        for (const Element& element : r_.document.children(parent)) {
            const std::string kind = element.node.name();
            if (!scope.names.suffix.empty()) tree_.copied_names.insert(element.name());
            if (kind == "body")
                read_body(element, body, scope);
            else if (kind == "frame")
                read_contents(element, body, inner(element, scope));
            else if (kind == "replicate")
                replicate(element, body, scope);
            else if (kind == "attach")
                attach(element, body, scope);
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
                {scope.names.full(element.name()), scope.X_BF * read_pose(attributes(), r_.settings)});
        if (kind == "inertial") at(body).inertial = read_inertial({{element}, r_.diagnostics}, scope, r_);
        if (kind == "joint" || kind == "freejoint") add_joint(attributes(), body, scope);
        if (kind == "composite" || kind == "flexcomp")
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
        body.name = scope.names.full(element.name());
        body.has_name = !body.name.empty();
        body.copy = scope.names;
        body.settings = &r_.settings;
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
                      {attributes.text("childclass", scope.childclass), scope.names, {}, masses});
    }

    Scope inner(const Element& frame, const Scope& scope) const {
        const Attributes attributes({frame}, r_.diagnostics);
        return {attributes.text("childclass", scope.childclass), scope.names,
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
                       {scope.names.prefix, attributes.text("sep") +
                                                std::string(digits - std::min(digits, number.size()), '0') +
                                                number + scope.names.suffix},
                       scope.X_BF * Pose{pos, q},
                       scope.masses};
            add_part(r_, copy.names);
            read_contents(element, body, copy);
            pos += rotate(q, offset);
        }
    }

    /// The parts of this file that have these names are there now.
    Reading add_part(const Reading& reading, const Names& names) {
        Reading part = reading;
        part.names = names;
        part.is_copy = true;
        part.quiet = std::ranges::any_of(
            parts_, [&](const Reading& other) { return &other.document == &part.document; });
        if (has_references(part.document)) parts_.push_back(part);
        return part;
    }

    /// The bodies of another file with a prefix before their names, or once more some of this file.
    void attach(const Element& element, std::size_t body, const Scope& scope) {
        const Attributes source({element}, r_.diagnostics);
        if (depth_ == kAttachDepth)
            return r_.diagnostics.error(element.where(), "attach-in-itself",
                                        "<attach> attaches what it stands in", "Attach another body.");
        const SubModel* model = nullptr;
        if (source.has("model")) {
            model = r_.sub_models.find(source, r_.document);
            if (model == nullptr) return;
        } else if (!source.has("body") && !source.has("frame")) {
            return source.bad_value("model", "the name of a <model> in <asset>");
        }
        const Names names{scope.names.prefix + source.text("prefix"), scope.names.suffix};
        const Reading part = add_part(model != nullptr ? model->reading(r_) : r_, names);
        TreeReader(part, tree_, parts_, depth_ + 1)
            .attached(source, body, {"", names, scope.X_BF, scope.masses});
    }

    /// What the <attach> names, in this file. A body comes without the frames around it, as in MuJoCo.
    void attached(const Attributes& source, std::size_t body, Scope scope) {
        const char* kind = source.has("body") ? "body" : "frame";
        if (!source.has(kind)) return read_world(body, scope);
        std::optional<Place> place;
        for (const Element& section : worlds())
            if (!place) place = find_place(r_.document, section, kind, source.text(kind), "");
        if (!place)
            return r_.diagnostics.error(source.where(), "unknown-" + std::string(kind),
                                        "<attach> names the " + std::string(kind) + " '" + source.text(kind) +
                                            "', which '" + r_.document.path() + "' does not have",
                                        "Check the name.");
        scope.childclass = place->childclass;
        if (source.has("body"))
            read_body(place->element, body, scope);
        else
            read_contents(place->element, body, inner(place->element, scope));
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
    Tree& tree_;
    std::vector<Reading>& parts_;
    int depth_;
};

}  // namespace

void Tree::index() {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const BodyPart& body = bodies[b];
        body_index_.emplace(body.name, b);
        for (std::size_t j = 0; j < body.joints.size(); ++j)
            joint_index_.emplace(body.joints[j].name, JointPlace{b, j});
        for (std::size_t s = 0; s < body.sites.size(); ++s)
            site_index_.emplace(body.sites[s].name, SitePlace{b, s});
        for (std::size_t g = 0; g < body.geoms.size(); ++g)
            geom_index_.emplace(body.geoms[g].name, std::pair{b, g});
    }
}

const BodyPart* Tree::find_body(const std::string& name) const {
    const auto found = body_index_.find(name);
    return found == body_index_.end() ? nullptr : &bodies[found->second];
}

std::optional<Tree::JointPlace> Tree::find_joint(const std::string& name) const {
    const auto found = joint_index_.find(name);
    return found == joint_index_.end() ? std::nullopt : std::optional(found->second);
}

GeomPart* Tree::find_geom(const std::string& name) {
    const auto found = geom_index_.find(name);
    return found == geom_index_.end() ? nullptr : &bodies[found->second.first].geoms[found->second.second];
}

std::optional<Tree::SitePlace> Tree::find_site(const std::string& name) const {
    const auto found = site_index_.find(name);
    return found == site_index_.end() ? std::nullopt : std::optional(found->second);
}

Tree read_tree(const Reading& reading, std::vector<Reading>& parts) {
    Tree tree;
    parts.push_back(reading);
    TreeReader(reading, tree, parts).read();
    parts.front().copied = tree.copied_names;
    return tree;
}

}  // namespace roboss::mjcf
