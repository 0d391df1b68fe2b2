// The contact sensor (SDF: contact): what touches the link that carries it, where, and how strongly.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a contact sensor measures: the contact points of its link that carry a force, in the tick that begins
/// at `tick`. Vectors stand one behind the other, three numbers a point, world axes.
struct ContactReading {
    std::vector<double> positions;  ///< m
    std::vector<double> normals;    ///< unit, towards the sensor's link
    std::vector<double> forces;     ///< N, on the sensor's link: normal force and friction
    std::vector<double> others;     ///< RobotId of the other robot of each point; -1: scenery
    Tick tick = 0;                  ///< of the measurement

    /// Number of contact points.
    std::size_t count() const { return others.size(); }

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"positions", "m"}, r.positions);
        visit({"normals"}, r.normals);
        visit({"forces", "N"}, r.forces);
        visit({"others"}, r.others);
    }
};

/// Without names, all collisions of the link count.
struct ContactSpec {
    using Reading = ContactReading;  ///< what it measures

    std::vector<std::string> collisions;  ///< SDF `<collision>`: names of collisions of the link
    /// What compile() makes of the names: numbers of shapes among those of the link, ascending; empty: all.
    std::vector<double> shapes;

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"topic", "", "readings go to Clients, not to topics"},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 34,
                                      .name = "contact",
                                      .phrase = "a contact sensor",
                                      .sdf_types = "contact",
                                      .block = "contact",
                                      .needs_all_states = true,
                                      .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({.name = "collisions", .element = "collision", .later = true}, s.collisions);
        visit({.name = "shapes", .element = "", .later = true}, s.shapes);
    }
    /// Compares all members.
    friend bool operator==(const ContactSpec&, const ContactSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
