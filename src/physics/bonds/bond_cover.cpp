// See bond_cover.h.
#include "physics/bonds/bond_cover.h"

#include "geometry/convex_hull.h"

namespace roboss {
namespace {

constexpr double kRounding = 1e-6;  // m: the held robot's point is computed in another way

/// A point that the shape holds, in its own frame.
Vec3 point_in(const Shape& shape) {
    return shape.kind == ShapeKind::kHull ? shape.hull->vertices.front() : Vec3{};
}

void cover(const Model& model, const RobotWork& work, const Bond& bond, Aabb& box) {
    const bool names_robot = bond.other != RobotId::kNone;
    const Transform X_WL = pose_of(work, bond.link);
    if (bond.phase == BondPhase::kForming) {
        if (names_robot) return box.include(work.box.inflated(bond.reach));
        Aabb cup;
        cup.include(X_WL * bond.p_L);
        return box.include(cup.inflated(bond.reach + kBaseMargin));
    }
    if (!names_robot) return;
    const RobotType& type = model.type_of(RobotId(bond.other));
    if (bond.other_link.index() >= type.links.size()) return;  // a damaged state
    const LinkPoint point = point_of(type, bond.other_link);
    Aabb held;
    held.include(X_WL * to_transform(bond.X_LO) * point.p_L);
    box.include(held.inflated(kTear + kRounding + point.spread));
}

}  // namespace

Transform pose_of(const RobotWork& work, LinkId link) {
    const Link& info = work.type->links[link.index()];
    if (info.body >= 0) return work.bodies[static_cast<std::size_t>(info.body)].X_WB * info.X_BL;
    return to_transform(base_pose(*work.state)) * info.X_BL;
}

LinkPoint point_of(const RobotType& type, LinkId link) {
    const Link& info = type.links[link.index()];
    const Transform X_LB = inverse(info.X_BL);
    for (const BodyShape& shape : type.shapes)
        if (shape.body == info.body) return {X_LB * (shape.X_BS * point_in(shape.shape)), 0.0};
    if (type.shapes.empty() && info.body <= 0) return {X_LB.p, 0.0};  // the base's origin
    return {{}, 2.0 * type.reach};
}

void cover_bonds(const Model& model, RobotWork& work) {
    if (work.state->bonds.empty()) return;
    Aabb box = work.box;
    for (const Bond& bond : work.state->bonds) cover(model, work, bond, box);
    work.box = box;
}

}  // namespace roboss
