// Where the shapes of a robot are in a tick, what they may reach in it, and the same of crowds (ShapeGroups),
// whose shapes are placed one by one when somebody asks for them. Written over T: one robot, or a few in
// lanes.
#pragma once

#include <cmath>

#include "geometry/box_frames.h"
#include "geometry/shape_bounds.h"
#include "physics/dynamics/robot_work.h"

namespace roboss {

/// Frame of a body; -1: of the base.
template <class T>
const TransformT<T>& body_frame(const Mechanics<T>& work, int body) {
    return body < 0 ? work.X_W0 : work.bodies[static_cast<std::size_t>(body)].X_WB;
}

/// No point within `radius` of p_W that moves with the body is faster; m/s. An infinite radius counts as
/// none.
template <class T>
T speed_within(const Mechanics<T>& work, const SpatialT<T>& velocity, const Vec3T<T>& p_W, double radius) {
    const Vec3T<T> there = velocity.linear + cross(velocity.angular, p_W - work.origin);
    return norm(there) + (std::isfinite(radius) ? norm(velocity.angular) * T(radius) : T(0));
}

/// Returns the most that a point of the shape moves by, m/s.
template <class T>
T place_shape(const RobotType& type, double dt, const Mechanics<T>& work, std::size_t s, ShapeWorkT<T>& w) {
    const BodyShape& shape = type.shapes[s];
    T speed{};
    w.X_WS = body_frame(work, shape.body) * broadcast<T>(shape.X_BS);
    if (shape.body < 0) {
        w.margin = kBaseMargin;
    } else {
        const BodyWorkT<T>& body = work.bodies[static_cast<std::size_t>(shape.body)];
        speed = speed_within(work, body.velocity, w.X_WS.p, bounding_radius(shape.shape));
        w.margin = kBaseMargin + dt * speed;
    }
    if constexpr (std::is_same_v<T, double>)
        w.box = bounds(shape.shape, w.X_WS).inflated(w.margin);
    else
        w.box = solid_bounds(shape.shape, w.X_WS).inflated(w.margin);
    return speed;
}

/// The box of a crowd. No larger than its sphere, so that it lies within RobotType::reach.
template <class T>
AabbT<T> crowd_box(const ShapeCrowd& crowd, const TransformT<T>& X_WB, const T& margin) {
    const AabbT<T> box = turned_box(X_WB, crowd.box);
    const Vec3T<T> r{T(crowd.radius), T(crowd.radius), T(crowd.radius)}, low = X_WB.p - r, high = X_WB.p + r;
    return AabbT<T>{{larger(box.min.x, low.x), larger(box.min.y, low.y), larger(box.min.z, low.z)},
                    {smaller(box.max.x, high.x), smaller(box.max.y, high.y), smaller(box.max.z, high.z)}}
        .inflated(margin);
}

template <class T>
void place_crowds(const RobotType& type, double dt, Mechanics<T>& work) {
    work.crowds.resize(type.shape_groups.crowds.size());
    for (std::size_t k = 0; k < work.crowds.size(); ++k) {
        const ShapeCrowd& crowd = type.shape_groups.crowds[k];
        const TransformT<T>& X_WB = body_frame(work, crowd.body);
        T speed{};
        if (crowd.body >= 0)
            speed = speed_within(work, work.bodies[static_cast<std::size_t>(crowd.body)].velocity, X_WB.p,
                                 crowd.radius);
        work.crowds[k].margin = kBaseMargin + dt * speed;
        work.crowds[k].box = crowd_box(crowd, X_WB, work.crowds[k].margin);
        work.speed = larger(work.speed, speed);
        work.box.include(work.crowds[k].box);
    }
}

template <class T>
void place_shapes(const RobotType& type, double dt, Mechanics<T>& work) {
    work.shapes.resize(type.shapes.size());
    work.box = {};
    work.speed = {};
    for (const std::uint32_t s : type.shape_groups.loose) {
        work.speed = larger(work.speed, place_shape(type, dt, work, s, work.shapes[s]));
        work.box.include(work.shapes[s].box);
    }
    place_crowds(type, dt, work);
    if (type.shapes.empty()) work.box.include(work.origin);
}

/// Makes room for the motion of a kinematic base in the tick. Returns the speed, m/s.
inline double widen_shape(double dt, const RobotWork& work, std::size_t s, ShapeWork& w) {
    const Shape& shape = work.type->shapes[s].shape;
    const double speed = speed_within(work, work.base, w.X_WS.p, bounding_radius(shape));
    w.margin = kBaseMargin + dt * speed;
    w.box = bounds(shape, w.X_WS).inflated(w.margin);
    return speed;
}

/// The shapes of one robot: those of its crowds are placed when they are asked for.
class PlacedShapes {
  public:
    void start(const RobotWork& robot, double dt) {
        robot_ = &robot, dt_ = dt, ++now_;
        is_moved_ = !is_zero(robot.base);
        if (robot.crowds.empty() || placed_.size() >= robot.shapes.size()) return;
        placed_.resize(robot.shapes.size());
        placed_at_.resize(robot.shapes.size(), 0);
    }
    const ShapeWork& operator[](std::size_t s) {
        if (robot_->crowds.empty()) return robot_->shapes[s];
        const RobotType& type = *robot_->type;
        if (type.shape_groups.crowd(type.shapes[s].body) < 0) return robot_->shapes[s];
        ShapeWork& w = placed_[s];
        if (placed_at_[s] == now_) return w;
        placed_at_[s] = now_;
        place_shape<double>(type, dt_, *robot_, s, w);
        if (is_moved_) widen_shape(dt_, *robot_, s, w);
        return w;
    }

  private:
    const RobotWork* robot_ = nullptr;
    double dt_ = 0;
    bool is_moved_ = false;  // by a kinematic base
    std::uint64_t now_ = 0;  // counts the robots
    std::vector<ShapeWork> placed_;
    std::vector<std::uint64_t> placed_at_;
};

/// The place of any shape, also of a crowd's.
inline Transform shape_pose(const Mechanics<double>& robot, std::size_t s) {
    const BodyShape& shape = robot.type->shapes[s];
    const ShapeGroups& groups = robot.type->shape_groups;
    if (groups.crowds.empty() || groups.crowd(shape.body) < 0) return robot.shapes[s].X_WS;
    return body_frame(robot, shape.body) * shape.X_BS;
}

}  // namespace roboss
