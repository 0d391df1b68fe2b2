// Links of uniform solids and single-link models for tests: the smallest pieces that worlds are built of in
// code. Inertias are the textbook ones, so closed-form answers hold.
#pragma once

#include <string>
#include <utility>

#include "world/joint_type.h"
#include "world/world.h"

namespace roboss::test {

inline Mat3 box_inertia(double mass, const Vec3& size) {
    const double k = mass / 12, x = size.x * size.x, y = size.y * size.y, z = size.z * size.z;
    return Mat3::diagonal(k * (y + z), k * (x + z), k * (x + y));
}

inline Mat3 sphere_inertia(double mass, double radius) {
    const double i = 0.4 * mass * radius * radius;
    return Mat3::diagonal(i, i, i);
}

/// Axis along z.
inline Mat3 cylinder_inertia(double mass, double radius, double length) {
    const double side = mass * (3 * radius * radius + length * length) / 12;
    return Mat3::diagonal(side, side, 0.5 * mass * radius * radius);
}

inline SurfaceSpec surface(double mu, double restitution = 0) {
    SurfaceSpec s;
    s.mu = s.mu2 = mu;
    s.restitution = restitution;
    return s;
}

inline CollisionSpec collision(GeometryKind kind, const SurfaceSpec& s, const Pose& X_LS = {}) {
    CollisionSpec c;
    c.name = "collision";
    c.geometry.kind = kind;
    c.surface = s;
    c.X_LS = X_LS;
    return c;
}

inline CollisionSpec box_shape(const Vec3& size, const SurfaceSpec& s, const Pose& X_LS = {}) {
    CollisionSpec c = collision(GeometryKind::kBox, s, X_LS);
    c.geometry.size = size;
    return c;
}

inline CollisionSpec sphere_shape(double radius, const SurfaceSpec& s, const Pose& X_LS = {}) {
    CollisionSpec c = collision(GeometryKind::kSphere, s, X_LS);
    c.geometry.radius = radius;
    return c;
}

inline CollisionSpec cylinder_shape(double radius, double length, const SurfaceSpec& s,
                                    const Pose& X_LS = {}) {
    CollisionSpec c = collision(GeometryKind::kCylinder, s, X_LS);
    c.geometry.radius = radius;
    c.geometry.length = length;
    return c;
}

inline LinkSpec link(std::string name, double mass, const Mat3& inertia_C, const Pose& X_ML = {}) {
    LinkSpec l;
    l.name = std::move(name);
    l.mass = mass;
    l.inertia_C = inertia_C;
    l.X_ML = X_ML;
    return l;
}

inline JointSpec joint(JointSpecKind kind, std::string name, std::string parent, std::string child,
                       const Pose& X_MJ) {
    JointSpec j;
    j.kind = kind;
    j.name = std::move(name);
    j.parent = std::move(parent);
    j.child = std::move(child);
    j.X_MJ = X_MJ;
    return j;
}

inline JointSpec joint(JointSpecKind kind, std::string name, std::string parent, std::string child,
                       const Pose& X_MJ, const Vec3& axis) {
    JointSpec j = joint(kind, std::move(name), std::move(parent), std::move(child), X_MJ);
    j.axes.emplace_back();
    j.axes[0].xyz = normalized(axis);
    return j;
}

inline ModelSpec one_link(LinkSpec l) {
    ModelSpec m;
    m.name = m.canonical_link = l.name;
    m.links.push_back(std::move(l));
    return m;
}

inline ModelSpec solid_box(double mass, const Vec3& size, const SurfaceSpec& s) {
    LinkSpec l = link("box", mass, box_inertia(mass, size));
    l.collisions.push_back(box_shape(size, s));
    return one_link(l);
}

inline ModelSpec solid_sphere(double mass, double radius, const SurfaceSpec& s) {
    LinkSpec l = link("sphere", mass, sphere_inertia(mass, radius));
    l.collisions.push_back(sphere_shape(radius, s));
    return one_link(l);
}

/// Axis along z.
inline ModelSpec solid_cylinder(double mass, double radius, double length, const SurfaceSpec& s) {
    LinkSpec l = link("cylinder", mass, cylinder_inertia(mass, radius, length));
    l.collisions.push_back(cylinder_shape(radius, length, s));
    return one_link(l);
}

inline ModelSpec scenery(CollisionSpec c) {
    LinkSpec l;
    l.name = "link";
    l.collisions.push_back(std::move(c));
    ModelSpec m = one_link(l);
    m.is_static = true;
    return m;
}

/// The half-space below z = 0 of the model's frame.
inline ModelSpec ground(const SurfaceSpec& s) {
    return scenery(collision(GeometryKind::kPlane, s));
}

/// Puts another instance of a new prototype into the world.
inline void place(World& world, ModelSpec model, const std::string& name, const Pose& X_WM = {}) {
    world.instances.push_back({name, world.prototypes.size(), X_WM, {}});
    world.prototypes.push_back(std::move(model));
}

inline World empty_world(double dt_s, const Vec3& gravity = {0, 0, -9.81}) {
    World world;
    world.name = "test";
    world.dt_s = dt_s;
    world.gravity = gravity;
    return world;
}

}  // namespace roboss::test
