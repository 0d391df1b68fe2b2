// See actor_conversion.h.
#include "sdf/actor_conversion.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "sdf/known_children.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kScript[] = {"loop", "delay_start", "auto_start", "trajectory"};

void add_text(pugi::xml_node parent, const char* name, const char* text) {
    parent.append_child(name).text().set(text);
}

/// A person of 1.7 m whose hips are the actor's origin, 1 m above the ground as in Gazebo's worlds.
void add_body(pugi::xml_node actor) {
    pugi::xml_node link = actor.append_child("link");
    link.append_attribute("name") = "link";
    pugi::xml_node body = link.append_child("collision");
    body.append_attribute("name") = "body";
    add_text(body, "pose", "0 0 -0.1 0 0 0");
    pugi::xml_node capsule = body.append_child("geometry").append_child("capsule");
    add_text(capsule, "radius", "0.25");
    add_text(capsule, "length", "1.2");
}

void make_model(pugi::xml_node actor) {
    actor.set_name("model");
    for (const char* drawn : {"skin", "animation", "static"})
        while (actor.remove_child(drawn)) continue;
    pugi::xml_node script = actor.child("script");
    if (!script) script = actor.append_child("script");
    script.set_name("roboss:actor");
    if (!actor.child("link")) add_body(actor);
}

/// The waypoints of one trajectory, by time. Gazebo counts in milliseconds; of two at one time the later one
/// in the file counts.
std::vector<ActorWaypoint> waypoints_of(const Element& trajectory, int number, const Import& import) {
    std::vector<ActorWaypoint> points;
    const double tension = [&] {
        const pugi::xml_attribute written = trajectory.node.attribute("tension");
        return written ? parse_number(written.value()).value_or(0.0) : 0.0;
    }();
    for (const auto node : trajectory.node.children("waypoint")) {
        const Element element{trajectory.source, node};
        ActorWaypoint point;
        point.trajectory = number;
        point.time = std::trunc(import.reader.number(element, "time", 0) * 1000.0) / 1000.0;
        point.tension = tension;
        point.pose = import.reader.pose(element.child("pose"));
        const auto at = std::ranges::lower_bound(points, point.time, {}, &ActorWaypoint::time);
        if (at != points.end() && at->time == point.time)
            *at = point;
        else
            points.insert(at, point);
    }
    return points;
}

}  // namespace

void make_models_of_actors(pugi::xml_node root) {
    for (pugi::xml_node child = root.first_child(); child; child = child.next_sibling()) {
        const std::string_view name = child.name();
        if (name == "actor") make_model(child);
        if (name == "world") make_models_of_actors(child);
    }
}

void convert_actor(const Element& script, const Import& import, ModelSpec& model) {
    const Element actor{script.source, script.node.parent()};
    report_unknown_children(script, kScript, import.diagnostics());
    ActorSpec spec;
    spec.loop = import.reader.boolean(script, "loop", true);
    spec.delay_start = import.reader.number(script, "delay_start", 0);
    int number = 0;
    for (const auto node : script.node.children("trajectory")) {
        std::vector<ActorWaypoint> points = waypoints_of({script.source, node}, number++, import);
        spec.waypoints.insert(spec.waypoints.end(), points.begin(), points.end());
    }
    model.kinematic = true;
    model.onboard.push_back({actor.name(), std::move(spec), actor.where()});
    import.diagnostics().note(actor.where(), "actor",
                              "actor '" + actor.name() +
                                  "' is a kinematic body: it pushes what it meets, and its skin is not drawn",
                              "Give it a <link> with collisions and visuals if it shall not be a capsule.");
}

}  // namespace roboss::sdf_import
