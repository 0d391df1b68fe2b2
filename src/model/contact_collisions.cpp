// Which shapes of its link a contact sensor feels, from the names of collisions in its file.
#include <algorithm>
#include <set>

#include "model/compile_type.h"

namespace roboss {
namespace {

/// "model::link::collision" without its scopes.
std::string last_part(const std::string& name) {
    const std::size_t scope = name.rfind("::");
    return scope == std::string::npos ? name : name.substr(scope + 2);
}

std::string names_of(const LinkSpec& link) {
    std::string names;
    for (const CollisionSpec& collision : link.collisions)
        names += (names.empty() ? "'" : ", '") + collision.name + "'";
    return names;
}

}  // namespace

SensorSpec with_chosen_shapes(SensorSpec sensor, const LinkSpec& link, std::span<const std::size_t> shapes,
                              Diagnostics& diagnostics) {
    auto* contact = std::get_if<ContactSpec>(&sensor.parameters);
    if (contact == nullptr || contact->collisions.empty()) return sensor;
    std::set<std::string> wanted;
    for (const std::string& name : contact->collisions) wanted.insert(last_part(name));
    contact->collisions.clear(), contact->shapes.clear();
    if (wanted.contains("__default__")) return sensor;  // of SDF: nothing is chosen
    std::size_t number = 0;
    bool all = true;
    for (std::size_t c = 0; c < link.collisions.size(); ++c) {
        const bool chosen = wanted.erase(link.collisions[c].name) > 0;
        for (std::size_t k = 0; k < shapes[c]; ++k, ++number)
            if (chosen) contact->shapes.push_back(static_cast<double>(number));
        all = all && (chosen || shapes[c] == 0);
    }
    if (!wanted.empty())
        diagnostics.warning(
            sensor.where, "unknown-collision",
            "contact sensor '" + sensor.name + "' names the collision '" + *wanted.begin() +
                "', which link '" + link.name + "' does not have" +
                (contact->shapes.empty() ? "; all collisions of the link count" : ""),
            link.collisions.empty() ? "Give the link a <collision>." : "It has " + names_of(link) + ".");
    if (all) contact->shapes.clear();  // as if it named none
    return sensor;
}

}  // namespace roboss
