// See link_parameters.h.
#include "model/link_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "math/inertia_checks.h"
#include "model/compile_type.h"
#include "model/link_value.h"
#include "model/own_number_lists.h"
#include "model/robot_state.h"

namespace roboss {
namespace {

using enum LinkParameter;

constexpr double kLargestOfMass = 1e12, kLargestOfSurface = 1e6, kLeastMass = 1e-9;  // kg
constexpr std::size_t kInertias = 6;                                                 // from kInertiaXx

constexpr std::array<LinkParameterInfo, kLinkParameters> kLinkRows{{
    {"mass", "kg"},
    {"centre_x", "m", false},
    {"centre_y", "m", false},
    {"centre_z", "m", false},
    {"inertia_xx", "kg m^2"},
    {"inertia_yy", "kg m^2"},
    {"inertia_zz", "kg m^2"},
    {"inertia_xy", "kg m^2", false},
    {"inertia_xz", "kg m^2", false},
    {"inertia_yz", "kg m^2", false},
    {"friction", "", true, &Material::mu},
    {"friction_across", "", true, &Material::mu2},
    {"restitution", "", true, &Material::restitution},
    {"torsional_friction", "", true, &Material::torsional_mu},
    {"rolling_friction", "m", true, &Material::rolling},
}};

bool is_of_surface(LinkParameter parameter) {
    return info_of(parameter).surface != nullptr;
}

/// The fault of a number, whatever the type of the robot; nullopt: none.
std::optional<NumberFault> fault_of(LinkParameter parameter, double value) {
    if (!std::isfinite(value)) return NumberFault{"", "give a finite number", "not-finite"};
    if (parameter == kMass && value < kLeastMass)
        return NumberFault{"; a link that moves weighs at least " + number_text(kLeastMass) + " kg",
                           "give a mass above that", "bad-parameter"};
    if (info_of(parameter).signless && value < 0)
        return NumberFault{"; it cannot be negative", "give a number of at least 0", "bad-parameter"};
    if (parameter == kRestitution && value > 1)
        return NumberFault{"; above 1, a bounce would gain energy", "give a number from 0 to 1",
                           "bad-parameter"};
    if (const double most = is_of_surface(parameter) ? kLargestOfSurface : kLargestOfMass;
        std::fabs(value) > most)
        return NumberFault{"; more than " + number_text(most) + " is no number of a link",
                           "give at most that", "beyond-limit"};
    return std::nullopt;
}

/// The matrix of the six numbers from kInertiaXx.
Mat3 matrix_of(const std::array<double, kInertias>& i) {
    return {{i[0], i[3], i[4]}, {i[3], i[1], i[5]}, {i[4], i[5], i[2]}};
}

bool is_of_a_body(const Mat3& inertia) {
    return resists_every_turn(inertia) && obeys_triangle_inequality(inertia);
}

/// The collision shape of a link that has the parameter; nullptr: none has.
const BodyShape* shape_with(const RobotType& type, LinkId link, LinkParameter parameter) {
    const auto found = std::ranges::find_if(type.shapes, [&](const BodyShape& shape) {
        return shape.link == link && (parameter != kFrictionAcross || shape.material.direction_S != Vec3{});
    });
    return found == type.shapes.end() ? nullptr : &*found;
}

/// Without a direction, friction is the same in all.
void put_surface(LinkParameter parameter, double value, Material& material) {
    const bool has_direction = material.direction_S != Vec3{};
    if (parameter == kFrictionAcross && !has_direction) return;
    material.*info_of(parameter).surface = value;
    if (parameter == kFriction && !has_direction) material.mu2 = value;
}

void put_surfaces(std::span<const LinkParameterValue> values, Material& material) {
    for (const auto& [parameter, value] : values)
        if (is_of_surface(parameter)) put_surface(parameter, value, material);
}

std::optional<double> given(std::span<const LinkParameterValue> values, LinkParameter parameter) {
    const auto found = std::ranges::find(values, parameter, &LinkParameterValue::parameter);
    if (found == values.end()) return std::nullopt;
    return found->value;
}

/// The inertia that the numbers give; nullopt: none of its six numbers is given, or not all.
std::optional<Mat3> given_inertia(std::span<const LinkParameterValue> values) {
    std::array<double, kInertias> six{};
    for (std::size_t i = 0; i < kInertias; ++i) {
        const auto one = given(values, static_cast<LinkParameter>(static_cast<std::size_t>(kInertiaXx) + i));
        if (!one) return std::nullopt;
        six[i] = *one;
    }
    return matrix_of(six);
}

bool gives_inertia(std::span<const LinkParameterValue> values) {
    return std::ranges::any_of(values, is_inertia, &LinkParameterValue::parameter);
}

/// Checks the numbers of one link, and names what is wrong.
class LinkCheck {
  public:
    LinkCheck(const std::string& robot, const RobotType& type, const SetLinkParameters& order)
        : type_(type), order_(order), link_(type.links[order.link.index()]) {
        called_ = "link '" + link_.name + "' of robot '" + robot + "'";
    }

    Result<> run() const {
        if (Result<> fine = check_list(order_, called_, kLinkParameters, link_parameter_names()); !fine)
            return fine;
        for (const LinkParameterValue& one : order_.values)
            if (Result<> fine = check(one); !fine) return fine;
        return check_inertia();
    }

  private:
    Result<> check(const LinkParameterValue& one) const {
        const LinkParameterInfo& row = info_of(one.parameter);
        const std::string what = std::string("'") + row.name + "' of " + called_;
        if (Result<> fine = check_link(what, one.parameter); !fine) return fine;
        const std::optional<NumberFault> fault = fault_of(one.parameter, one.value);
        if (!fault) return Ok{};
        const std::string unit = *row.unit == '\0' ? "" : std::string(" ") + row.unit;
        return Error{what + " is " + number_text(one.value) + unit + fault->text, fault->remedy, fault->code};
    }

    /// Refuses a number that this link does not have.
    Result<> check_link(const std::string& what, LinkParameter parameter) const {
        if (is_of_surface(parameter)) {
            if (shape_with(type_, order_.link, parameter) != nullptr) return Ok{};
            if (shape_with(type_, order_.link, kFriction) == nullptr)
                return Error{what + ": it has no collision shapes", "set it for a link that touches things",
                             "no-shapes"};
            return Error{what + ": its friction is the same in all directions",
                         "set 'friction', or write a direction (fdir1) in the world file", "no-direction"};
        }
        if (!(link_.mass > 0))
            return Error{what + ": the link has no mass in the file", "give it one in the world file",
                         "no-mass"};
        if (type_.elimination.empty()) return Ok{};
        return Error{what + ": robots with this many loops keep their masses",
                     "write it in the world file, for all robots of the type", "many-loops"};
    }

    Result<> check_inertia() const {
        if (!gives_inertia(order_.values)) return Ok{};
        const std::optional<Mat3> inertia = given_inertia(order_.values);
        if (!inertia)
            return Error{"order for " + called_ + " sets a part of its inertia",
                         "give inertia_xx, inertia_yy, inertia_zz, inertia_xy, inertia_xz and inertia_yz",
                         "half-inertia"};
        if (is_of_a_body(*inertia)) return Ok{};
        return Error{"no body can have the inertia that an order gives " + called_,
                     "give moments above 0 about the centre of mass, none above the sum of the other two",
                     "bad-inertia"};
    }

    const RobotType& type_;
    const SetLinkParameters& order_;
    const Link& link_;
    std::string called_;
};

constexpr auto kPlaceOfLinkNumber = [](const OwnLinkNumber& one) {
    return std::tuple(one.link, one.number.parameter);
};

/// True if the link has this number in the type: of a surface, all of its shapes.
bool has_number(const RobotType& type, LinkId link, const LinkParameterValue& number) {
    if (!is_of_surface(number.parameter)) return link_number(type, link, number.parameter) == number.value;
    return std::ranges::all_of(type.shapes, [&](const BodyShape& shape) {
        if (shape.link != link) return true;
        Material with = shape.material;
        put_surface(number.parameter, number.value, with);
        return with.*info_of(number.parameter).surface == shape.material.*info_of(number.parameter).surface;
    });
}

/// Forgets those of the numbers of one link that are the type's. An inertia is one number here.
void forget_equal(const RobotType& type, LinkId link, std::vector<LinkParameterValue>& numbers) {
    const auto is_equal = [&](const LinkParameterValue& one) { return has_number(type, link, one); };
    const auto gives_other_inertia = [&](const LinkParameterValue& one) {
        return (is_inertia(one.parameter) || one.parameter == kMass) && !is_equal(one);
    };
    const bool inertia_differs = std::ranges::any_of(numbers, gives_other_inertia);
    std::erase_if(numbers, [&](const LinkParameterValue& one) {
        return is_inertia(one.parameter) ? !inertia_differs : is_equal(one);
    });
}

/// Calls visit(link, numbers) for each link that has some, in their order, until it says false. False: it
/// did.
template <class Visit>
bool for_each_link(std::span<const OwnLinkNumber> own, const Visit& visit) {
    std::vector<LinkParameterValue> numbers;
    for (std::size_t i = 0; i < own.size();) {
        const LinkId link = own[i].link;
        numbers.clear();
        for (; i < own.size() && own[i].link == link; ++i) numbers.push_back(own[i].number);
        if (!visit(link, numbers)) return false;
    }
    return true;
}

/// Gives a link its own mass, centre of mass and inertia. False: it has none of its own.
bool weigh(std::span<const LinkParameterValue> values, Link& link) {
    const auto is_mass = [](const LinkParameterValue& one) { return !is_of_surface(one.parameter); };
    if (std::ranges::none_of(values, is_mass)) return false;
    const double mass = given(values, kMass).value_or(link.mass);
    const std::optional<double> centre[] = {given(values, kCentreX), given(values, kCentreY),
                                            given(values, kCentreZ)};
    if (centre[0] || centre[1] || centre[2]) {
        Vec3 p_LC = inverse(link.X_BL) * link.p_BC;
        for (std::size_t i = 0; i < 3; ++i) p_LC[i] = centre[i].value_or(p_LC[i]);
        link.p_BC = link.X_BL * p_LC;
    }
    if (const std::optional<Mat3> inertia = given_inertia(values))
        link.inertia_C = link.X_BL.R * *inertia * transpose(link.X_BL.R);
    else if (mass != link.mass)
        link.inertia_C = link.inertia_C * (mass / link.mass);
    link.mass = mass;
    return true;
}

/// Sums bodies up again from their links. `changed`: by body.
void sum_up(const std::vector<char>& changed, RobotType& type) {
    for (std::size_t b = 0; b < changed.size(); ++b) {
        if (changed[b] == 0) continue;
        Body& body = type.bodies[b];
        body.mass = body.gravity_mass = 0;
        body.p_BC = body.p_BG = {};
        body.inertia_C = {};
    }
    for (const Link& link : type.links)
        if (link.body >= 0 && changed[static_cast<std::size_t>(link.body)] != 0)
            add_mass(type.bodies[static_cast<std::size_t>(link.body)], link);
}

}  // namespace

std::span<const LinkParameterInfo> link_parameters() {
    return kLinkRows;
}

const LinkParameterInfo& info_of(LinkParameter parameter) {
    return kLinkRows[static_cast<std::size_t>(parameter)];
}

std::optional<LinkParameter> find_link_parameter(std::string_view name) {
    return find_row<LinkParameter>(link_parameters(), name);
}

std::string link_parameter_names() {
    return names_of_rows(link_parameters());
}

Result<> check_link_parameters(const std::string& robot, const RobotType& type,
                               const SetLinkParameters& order) {
    if (order.link.index() < type.links.size()) return LinkCheck(robot, type, order).run();
    return Error{"order for the parameters of a link that robot '" + robot + "' does not have",
                 "see `roboss check` for its links", "no-link"};
}

void apply_link_parameters(const RobotType& type, const SetLinkParameters& order, RobotState& state) {
    OwnNumbers own = state.own;
    const auto [first, last] = numbers_with(order.link, &OwnLinkNumber::link, own.links);
    std::vector<LinkParameterValue> numbers;
    if (!order.reset)
        for (auto one = first; one != last; ++one) numbers.push_back(one->number);
    for (const LinkParameterValue& one : order.values) put_number(one, numbers);
    forget_equal(type, order.link, numbers);
    auto at = own.links.erase(first, last);
    for (const LinkParameterValue& one : numbers) at = own.links.insert(at, {order.link, one}) + 1;
    set_own(type, std::move(own), state);
}

std::optional<double> link_number(const RobotType& type, LinkId link, LinkParameter parameter) {
    const Link& its = type.links[link.index()];
    if (is_of_surface(parameter)) {
        const BodyShape* shape = shape_with(type, link, parameter);
        if (shape == nullptr) return std::nullopt;
        return shape->material.*info_of(parameter).surface;
    }
    if (!(its.mass > 0)) return std::nullopt;
    if (parameter == kMass) return its.mass;
    if (!is_inertia(parameter))
        return (inverse(its.X_BL) * its.p_BC)[static_cast<std::size_t>(parameter) - 1];
    const Mat3 I = transpose(its.X_BL.R) * its.inertia_C * its.X_BL.R;
    const double six[] = {I.r0.x, I.r1.y, I.r2.z, I.r0.y, I.r0.z, I.r1.z};
    return six[static_cast<std::size_t>(parameter) - static_cast<std::size_t>(kInertiaXx)];
}

bool may_own(const RobotType& type, std::span<const OwnLinkNumber> own) {
    for (std::size_t i = 1; i < own.size(); ++i)
        if (kPlaceOfLinkNumber(own[i - 1]) >= kPlaceOfLinkNumber(own[i])) return false;
    return for_each_link(own, [&](LinkId link, std::vector<LinkParameterValue>& numbers) {
        if (!check_link_parameters("", type, {link, false, numbers})) return false;
        const std::size_t count = numbers.size();
        forget_equal(type, link, numbers);
        return numbers.size() == count;
    });
}

bool put_numbers(std::span<const OwnLinkNumber> own, RobotType& type) {
    std::vector<char> weighed(type.bodies.size(), 0);
    for_each_link(own, [&](LinkId id, const std::vector<LinkParameterValue>& numbers) {
        for (BodyShape& shape : type.shapes)
            if (shape.link == id) put_surfaces(numbers, shape.material);
        Link& link = type.links[id.index()];
        if (weigh(numbers, link) && link.body >= 0) weighed[static_cast<std::size_t>(link.body)] = 1;
        return true;
    });
    sum_up(weighed, type);
    return std::ranges::find(weighed, 1) != weighed.end();
}

}  // namespace roboss
