// See surroundings.h.
#include "model/surroundings.h"

#include <array>
#include <cmath>
#include <utility>

#include "model/order.h"
#include "model/own_number_lists.h"

namespace roboss {
namespace {

constexpr std::array<SurroundingInfo, 2> kSurroundingRows{{
    {"gravity", "m/s^2", &OwnSurroundings::gravity},
    {"wind", "m/s", &OwnSurroundings::wind},
}};
constexpr std::array<double, kSurroundingRows.size()> kMostOfSurroundings{kOrderLimits.gravity,
                                                                          kOrderLimits.wind};

/// The fault of what an order gives or a state has, with its name; nullopt: none.
std::optional<NumberFault> fault_in(const OwnSurroundings& all) {
    for (std::size_t i = 0; i < kSurroundingRows.size(); ++i) {
        const SurroundingInfo& row = kSurroundingRows[i];
        const std::optional<Vec3>& value = all.*row.own;
        if (!value) continue;
        const std::string name = std::string("'") + row.name + "'";
        if (!is_finite(*value))
            return NumberFault{name + " is not finite", "give finite numbers", "not-finite"};
        const std::string unit = std::string(" ") + row.unit;
        for (const double x : {value->x, value->y, value->z})
            if (std::fabs(x) > kMostOfSurroundings[i])
                return NumberFault{name + " has a component of " + number_text(x) + unit +
                                       ", beyond the limit of " + number_text(kMostOfSurroundings[i]) + unit,
                                   "give at most that; docs/physics.md lists the limits of orders",
                                   "beyond-limit"};
    }
    return std::nullopt;
}

}  // namespace

std::span<const SurroundingInfo> surroundings() {
    return kSurroundingRows;
}

const SurroundingInfo& info_of(Surrounding which) {
    return kSurroundingRows[static_cast<std::size_t>(which)];
}

Result<> check_surroundings(const std::string& robot, const SetSurroundings& order) {
    const std::string what = "order for the surroundings of robot '" + robot + "'";
    if (!order.reset && order.values.empty())
        return Error{what + " names none", "name gravity, wind or both, or reset them", "no-parameter"};
    const std::optional<NumberFault> fault = fault_in(order.values);
    if (!fault) return Ok{};
    return Error{what + ": " + fault->text, fault->remedy, fault->code};
}

void apply_surroundings(const Model& model, const RobotType& type, const SetSurroundings& order,
                        RobotState& state) {
    OwnNumbers own = state.own;
    if (order.reset) own.around = {};
    // Adding 0 leaves no -0: numbers that are equal have the same bits, so lanes may share them.
    if (order.values.gravity) own.around.gravity = *order.values.gravity + Vec3{};
    if (order.values.wind) own.around.wind = *order.values.wind + Vec3{};
    if (own.around.gravity == model.gravity) own.around.gravity.reset();
    if (own.around.wind == model.wind) own.around.wind.reset();
    set_own(type, std::move(own), state);
}

bool may_own(const OwnSurroundings& own) {
    const auto has_minus_zero = [](const std::optional<Vec3>& value) {
        const auto is_minus_zero = [](double x) { return x == 0 && std::signbit(x); };
        return value && (is_minus_zero(value->x) || is_minus_zero(value->y) || is_minus_zero(value->z));
    };
    return !fault_in(own) && !has_minus_zero(own.gravity) && !has_minus_zero(own.wind);
}

const Vec3& surrounding_of(const Model& model, Surrounding which) {
    return which == Surrounding::kGravity ? model.gravity : model.wind;
}

const Vec3& surrounding_of(const Model& model, const RobotState& state, Surrounding which) {
    const std::optional<Vec3>& own = state.own.around.*info_of(which).own;
    return own ? *own : surrounding_of(model, which);
}

}  // namespace roboss
