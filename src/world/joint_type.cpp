// The rows of joint types.
#include "world/joint_type.h"

#include <iterator>
#include <string>

#include "core/check.h"

namespace roboss {
namespace {

constexpr JointKind kHinge[] = {JointKind::kRevolute};
constexpr JointKind kTwoHinges[] = {JointKind::kRevolute, JointKind::kRevolute};
constexpr JointKind kSlide[] = {JointKind::kPrismatic};
constexpr JointKind kInPlane[] = {JointKind::kPrismatic, JointKind::kPrismatic, JointKind::kRevolute};
constexpr JointKind kBall[] = {JointKind::kBall};
constexpr JointKind kThread[] = {JointKind::kScrew};

constexpr std::string_view kAxis[] = {"axis"};
constexpr std::string_view kPlaneAxes[] = {"x", "y", "axis"};  // <axis> is the plane's normal
constexpr std::string_view kTwoAxes[] = {"axis", "axis2"};

constexpr JointType kRows[] = {
    {.name = "fixed"},
    {.name = "revolute", .motions = kHinge, .axes = kAxis},
    {.name = "continuous", .motions = kHinge, .axes = kAxis, .endless = true},
    {.name = "prismatic", .motions = kSlide, .axes = kAxis},
    {.name = "ball", .motions = kBall},
    {.name = "screw", .motions = kThread, .axes = kAxis},
    {.name = "universal", .motions = kTwoHinges, .axes = kTwoAxes},
    {.name = "revolute2", .motions = kTwoHinges, .axes = kTwoAxes},
    {.name = "gearbox", .axes = kTwoAxes, .couples = true},
    {.name = "planar", .motions = kInPlane, .axes = kPlaneAxes, .is_extension = true},
};

}  // namespace

std::optional<std::size_t> JointType::find_axis(std::string_view element) const {
    const auto found = std::find(axes.begin(), axes.end(), element);
    if (found == axes.end()) return std::nullopt;
    return static_cast<std::size_t>(found - axes.begin());
}

std::span<const JointType> joint_types() {
    return kRows;
}

const JointType& joint_type(JointSpecKind kind) {
    const auto row = static_cast<std::size_t>(kind);
    ROBOSS_CHECK(row < std::size(kRows), "joint type " + std::to_string(row));
    return kRows[row];
}

std::optional<JointSpecKind> find_joint_type(std::string_view name) {
    for (std::size_t row = 0; row < std::size(kRows); ++row)
        if (kRows[row].name == name) return static_cast<JointSpecKind>(row);
    return std::nullopt;
}

}  // namespace roboss
