// Rounding. Positions are rounded to 1/65536 m, so that who stands still has the same bytes again.
#include "wire/view_state.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "model/joint_motion.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

namespace protocol = viewer_protocol;

constexpr double kPi = std::numbers::pi;
constexpr double kStepsAMetre = 65536;
constexpr double kRangeOfUnlimited_m = 100;
constexpr double kRangeOfUnlimited_rad = 64 * kPi;

double range_of(const RobotType& type, const Body& body) {
    const JointTraits& joint = joint_traits(body.joint);
    if (joint.is_periodic) return kPi;
    if (joint.is_quaternion) return 1;
    const Dof& dof = type.dofs[static_cast<std::size_t>(body.v_index - type.base_nv())];
    const double reach = std::max(std::abs(dof.lower), std::abs(dof.upper));
    constexpr double kSlack = 1.05;  // soft limits give way
    const double unlimited = joint.turns ? kRangeOfUnlimited_rad : kRangeOfUnlimited_m;
    return reach > 0 && reach < unlimited ? kSlack * reach : unlimited;
}

template <class T>
void put(std::uint8_t* at, const T& value) {
    std::memcpy(at, &value, sizeof(value));
}

std::int16_t rounded(double value, double scale) {
    const double steps = std::floor(value * scale + 0.5);
    const double bound = protocol::kStateCoordinateScale;
    return static_cast<std::int16_t>(steps > -bound ? (steps < bound ? steps : bound) : -bound);
}

double wrapped(double angle) {
    return angle - 2 * kPi * std::floor((angle + kPi) / (2 * kPi));
}

}  // namespace

std::vector<double> view_ranges(const RobotType& type) {
    std::vector<double> ranges;
    for (const Body& body : type.bodies) {
        if (body.joint == JointKind::kFree) continue;
        const auto width = static_cast<std::size_t>(joint_traits(body.joint).nq);
        ranges.insert(ranges.end(), width, range_of(type, body));
    }
    return ranges;
}

ViewLayout::ViewLayout(const Model& model) {
    for (const RobotType& type : model.types) {
        std::vector<Coordinate>& coordinates = types_.emplace_back();
        for (const double range : view_ranges(type))
            coordinates.push_back({Coordinate::Kind::kLinear, protocol::kStateCoordinateScale / range});
        for (const Body& body : type.bodies) {
            const auto first = static_cast<std::size_t>(std::max(body.q_index - 7, 0));
            if (joint_traits(body.joint).is_periodic) coordinates[first].kind = Coordinate::Kind::kAngle;
            if (body.reversed_ball)
                for (std::size_t k = 1; k < 4; ++k)
                    coordinates[first + k].kind = Coordinate::Kind::kConjugate;
        }
    }
    for (const Robot& robot : model.robots)
        bytes_.push_back(
            static_cast<std::uint32_t>(protocol::kStateEntryBytes + 2 * types_[robot.type.index()].size()));
}

void ViewLayout::append(const Model& model, RobotId robot, const RobotState& state,
                        std::vector<std::uint8_t>& out) const {
    const std::vector<Coordinate>& coordinates = types_[model.robots[robot.index()].type.index()];
    const std::size_t begin = out.size();
    out.resize(begin + bytes_of(robot));
    std::uint8_t* entry = out.data() + begin;
    put(entry + protocol::kStateEntryRobotAt, robot.value);
    for (std::size_t k = 0; k < 3; ++k) {
        const double steps = std::floor(state.q[k] * kStepsAMetre + 0.5);
        put(entry + protocol::kStateEntryPositionAt + sizeof(float) * k,
            static_cast<float>(steps / kStepsAMetre));
    }
    for (std::size_t k = 0; k < 4; ++k)
        put(entry + protocol::kStateEntryOrientationAt + 2 * k,
            rounded(state.q[3 + k], protocol::kStateOrientationScale));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const Coordinate& c = coordinates[i];
        const double q = state.q[7 + i];
        const double shown = c.kind == Coordinate::Kind::kAngle       ? wrapped(q)
                             : c.kind == Coordinate::Kind::kConjugate ? -q
                                                                      : q;
        put(entry + protocol::kStateEntryCoordinatesAt + 2 * i, rounded(shown, c.scale));
    }
}

std::optional<RobotId> ViewLayout::entry_at(std::span<const std::uint8_t> bytes, std::size_t offset) const {
    std::uint32_t number = 0;
    if (offset > bytes.size() || bytes.size() - offset < sizeof(number)) return std::nullopt;
    std::memcpy(&number, bytes.data() + offset, sizeof(number));
    const RobotId robot(number);
    if (robot.index() >= robots() || bytes.size() - offset < bytes_of(robot)) return std::nullopt;
    return robot;
}

}  // namespace roboss
