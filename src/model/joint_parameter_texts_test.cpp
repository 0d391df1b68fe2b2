// Units of numbers of joints, and what null means where JSON gives one.
#include "model/joint_parameter_texts.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "model/model.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using enum JointParameter;

std::string unit(JointParameter parameter, JointSpecKind kind, int axis = 0) {
    Joint joint;
    joint.kind = kind;
    return unit_of(parameter, joint, axis);
}

TEST(JointParameterTexts, UnitsAreThoseOfTheAxis) {
    EXPECT_EQ(unit(kDamping, JointSpecKind::kRevolute), "N m s/rad");
    EXPECT_EQ(unit(kDamping, JointSpecKind::kPrismatic), "N s/m");
    EXPECT_EQ(unit(kDamping, JointSpecKind::kBall, 2), "N m s/rad") << "three axes of one motion";
    EXPECT_EQ(unit(kUpper, JointSpecKind::kUniversal, 1), "rad");
    EXPECT_EQ(unit(kArmature, JointSpecKind::kPrismatic), "kg");
    EXPECT_EQ(unit(kFriction, JointSpecKind::kPlanar, 0), "N") << "along the plane";
    EXPECT_EQ(unit(kFriction, JointSpecKind::kPlanar, 2), "N m") << "within it";
}

TEST(JointParameterTexts, NullIsNoBoundWhereThereMayBeNone) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(value_of_null(kLower), -infinity);
    for (const JointParameter parameter : {kUpper, kMaxEffort, kMaxVelocity, kLimitStiffness})
        EXPECT_EQ(value_of_null(parameter), infinity) << info_of(parameter).name;
    for (const JointParameter parameter : {kDamping, kSpringReference, kArmature, kPositionGain})
        EXPECT_EQ(value_of_null(parameter), std::nullopt) << info_of(parameter).name;
}

}  // namespace
}  // namespace roboss
