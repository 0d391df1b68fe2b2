// Contact rules. A <pair> lets two geoms touch whatever their masks say: each pair gets a bit of the masks
// that no geom uses. An <exclude> names bodies; RoBOSS knows it within a robot.
#include <algorithm>

#include "mjcf/equalities.h"

namespace roboss::mjcf {
namespace {

/// Bits that no geom uses.
std::vector<unsigned> free_bits(const Tree& tree) {
    unsigned used = 0;
    for (const BodyPart& body : tree.bodies)
        for (const GeomPart& geom : body.geoms) used |= geom.contype | geom.conaffinity;
    std::vector<unsigned> bits;
    for (unsigned k = 0; k < 32; ++k)
        if ((used & (1u << k)) == 0) bits.push_back(1u << k);
    return bits;
}

bool may_touch(const GeomPart& a, const GeomPart& b) {
    return ((a.contype & b.conaffinity) | (b.contype & a.conaffinity)) != 0;
}

/// What the pair says of friction, for geoms that touch in pairs only.
void set_friction(const Attributes& source, GeomPart& geom) {
    if (geom.contype != 0 || geom.conaffinity != 0 || geom.in_pair || !source.has("friction")) return;
    double friction[5] = {1, 1, 0.005, 0.0001, 0.0001};
    source.overlay("friction", friction);
    geom.surface.mu = geom.surface.mu2 = friction[0];
}

void read_pairs(Tree& tree, const Reading& reading, std::vector<unsigned>& bits) {
    for (const Element& element : reading.document.in_sections("contact")) {
        if (std::string(element.node.name()) != "pair" || !reading.settings.contacts) continue;
        const Attributes source = reading.defaults.of(element);
        GeomPart *a = tree.find_geom(reading.names.full(source.text("geom1"))),
                 *b = tree.find_geom(reading.names.full(source.text("geom2")));
        if (a == nullptr || b == nullptr) {
            reading.report_unknown(element.where(), {source.text("geom1"), source.text("geom2")},
                                   "unknown-geom", "a <pair> names a geom that the file does not have",
                                   "Check geom1 and geom2.");
            continue;
        }
        if (may_touch(*a, *b)) continue;
        if (bits.empty()) {
            reading.warn(element.where(), "ignored-element",
                         "<pair> has no effect: the masks of the geoms have no bit left",
                         "Let the geoms collide by contype and conaffinity.");
            continue;
        }
        for (GeomPart* geom : {a, b}) set_friction(source, *geom), geom->in_pair = true;
        a->surface.category_bitmask |= bits.back(), b->surface.collide_bitmask |= bits.back();
        bits.pop_back();
    }
}

void read_excludes(Robots& robots, const Reading& reading) {
    for (const Element& element : reading.document.in_sections("contact")) {
        if (std::string(element.node.name()) != "exclude") continue;
        const Attributes source({element}, reading.diagnostics);
        const BodyPart *a = robots.tree().find_body(reading.names.full(source.text("body1"))),
                       *b = robots.tree().find_body(reading.names.full(source.text("body2")));
        if (a == nullptr || b == nullptr) {
            reading.report_unknown(element.where(), {source.text("body1"), source.text("body2")},
                                   "unknown-body", "an <exclude> names a body that the file does not have",
                                   "Check body1 and body2.");
            continue;
        }
        const std::size_t first = robots.tree().index_of(*a), second = robots.tree().index_of(*b);
        if (robots.same_model(first, second))
            robots.model_of(first).no_contact.emplace_back(robots.local_name(first),
                                                           robots.local_name(second));
        else
            reading.warn(element.where(), "ignored-element",
                         "<exclude> has no effect between two robots, or a robot and scenery",
                         "Use contype and conaffinity.");
    }
}

}  // namespace

void read_contact_pairs(Tree& tree, std::span<const Reading> parts) {
    std::vector<unsigned> bits = free_bits(tree);
    for (const Reading& part : parts) read_pairs(tree, part, bits);
}

void read_contact_excludes(Robots& robots, std::span<const Reading> parts) {
    for (const Reading& part : parts) read_excludes(robots, part);
}

}  // namespace roboss::mjcf
