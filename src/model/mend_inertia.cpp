// Dummy frames of URDF, casters and sensor mounts often have no mass, or moments of inertia of zero. Welded
// to a link with mass they do no harm, and neither do they in a chain of sliders or hinges that ends at a
// mass: the chain moves as what it carries. Any other body that moves must have some: a gram, and moments as
// of a ball of one centimetre at least, too little to matter to what it hangs on.
#include <algorithm>
#include <cmath>

#include "math/inertia_checks.h"
#include "model/compile_type.h"

namespace roboss {
namespace {

constexpr double kSmallMass = 1e-3;      // kg
constexpr double kSmallRadius = 0.01;    // m
constexpr double kSmallestShare = 1e-3;  // of the greatest moment

/// No principal moment is below this (Gershgorin).
double least_moment(const Mat3& m) {
    double least = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = m(i, i);
        for (std::size_t j = 0; j < 3; ++j)
            if (j != i) row -= std::fabs(m(i, j));
        least = std::min(least, row);
    }
    return least;
}

/// What must be added about each axis so that all principal moments are at least that of a small ball, and a
/// thousandth of the greatest.
double missing_moment(const Mat3& m, double mass) {
    const double greatest = std::max({m(0, 0), m(1, 1), m(2, 2), 0.0});
    const double floor = std::max(0.4 * mass * kSmallRadius * kSmallRadius, kSmallestShare * greatest);
    return floor - std::min(0.0, least_moment(m));
}

std::string three_digits(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", value);
    return buffer;
}

}  // namespace

namespace {

/// One of the links of a body: the first.
struct Weighed {
    Link& link;
    const LinkSpec& source;
};

void give_mass(Body& body, const Weighed& weighed, const std::string& model, Diagnostics& diagnostics) {
    Link& link = weighed.link;
    link.mass = kSmallMass;
    const double moment = 0.4 * kSmallMass * kSmallRadius * kSmallRadius;
    link.inertia_C = Mat3::diagonal(moment, moment, moment);
    add_mass(body, link);
    diagnostics.warning(weighed.source.where, "massless",
                        "link '" + link.name + "' of model '" + model +
                            "' can move and has no mass; it gets 1 g and the inertia of a ball of 1 cm",
                        "Write its <inertial>, or join it to its parent with a fixed joint.");
}

void give_moments(Body& body, const Weighed& weighed, const std::string& model, Diagnostics& diagnostics) {
    const double moment = missing_moment(body.inertia_C, body.mass);
    const Mat3 more = Mat3::diagonal(moment, moment, moment);
    weighed.link.inertia_C = weighed.link.inertia_C + more;
    body.inertia_C = body.inertia_C + more;
    diagnostics.warning(weighed.source.where, "small-inertia",
                        "link '" + weighed.link.name + "' of model '" + model +
                            "' can turn and has no inertia to speak of about some axis; " +
                            three_digits(moment) + " kg m^2 are added about each",
                        "Write its moments of inertia about the centre of mass.");
}

}  // namespace

void mend_inertia(RobotType& type, const ModelSpec& spec, const std::vector<std::size_t>& links,
                  Diagnostics& diagnostics) {
    std::vector<std::size_t> first(type.bodies.size(), type.links.size());
    for (std::size_t l = type.links.size(); l-- > 0;)
        if (type.links[l].body >= 0) first[static_cast<std::size_t>(type.links[l].body)] = l;
    std::vector<std::size_t> massless;
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        if (first[b] == type.links.size()) continue;
        const Weighed weighed{type.links[first[b]], spec.links[links[first[b]]]};
        if (weighed.source.between_joints) continue;
        if (!(type.bodies[b].mass > 0))
            massless.push_back(b);
        else if (!resists_every_turn(type.bodies[b].inertia_C))
            give_moments(type.bodies[b], weighed, spec.name, diagnostics);
    }
    // From the ends towards the base: what got a mass may carry what stands before it.
    for (std::size_t k = massless.size(); k-- > 0;) {
        const std::size_t b = massless[k];
        if (!is_carried_by_what_follows(type, b))
            give_mass(type.bodies[b], {type.links[first[b]], spec.links[links[first[b]]]}, spec.name,
                      diagnostics);
    }
}

}  // namespace roboss
