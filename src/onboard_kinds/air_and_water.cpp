// What the kinds of air and water state about themselves: commands, and whether they can work.
#include <algorithm>
#include <array>
#include <cmath>

#include "onboard_kinds/advanced_lift_drag.h"
#include "onboard_kinds/buoyancy.h"
#include "onboard_kinds/buoyancy_engine.h"
#include "onboard_kinds/hydrodynamics.h"
#include "onboard_kinds/lift_drag.h"
#include "onboard_kinds/lighter_than_air.h"
#include "onboard_kinds/motor_model.h"
#include "onboard_kinds/multicopter_control.h"
#include "onboard_kinds/thruster.h"
#include "onboard_kinds/wind_effects.h"

namespace roboss {
namespace {

using Problems = std::vector<OnboardProblem>;

/// A channel `name` on Gazebo's topic /NAMESPACE/name.
Channel below(const std::string& robot_namespace, const std::string& name, std::vector<ChannelValue> values) {
    Channel channel;
    channel.name = name;
    while (channel.name.starts_with('/')) channel.name.erase(0, 1);
    channel.topic = "/" + (robot_namespace.empty() ? "{model}" : robot_namespace) + "/" + channel.name;
    channel.values = std::move(values);
    return channel;
}

void expect_one(const char* element, std::size_t count, Problems& problems) {
    if (count != 1)
        problems.push_back({"has " + std::to_string(count) + " <" + element + ">, and needs one",
                            "Name it in <" + std::string(element) + ">."});
}

void expect(bool holds, const char* what, const char* remedy, Problems& problems) {
    if (!holds) problems.push_back({what, remedy});
}

bool is_direction(const Vec3& v) {
    return norm_squared(v) > 1e-18;
}

/// Names "xU", with what stands between row and column, and behind it.
std::vector<std::string> names_of(const char* middle, const char* repeated) {
    std::vector<std::string> names;
    const std::string columns = repeated == nullptr ? "-" : "UVWPQR";
    for (const char row : std::string("xyzkmn"))
        for (const char column : std::string("UVWPQR"))
            for (const char second : columns) {
                std::string name = std::string(1, row) + middle + column;
                if (repeated != nullptr) name += repeated + std::string(1, second);
                names.push_back(std::move(name));
            }
    return names;
}

}  // namespace

Channel MotorModelSpec::motor_speeds(const std::string& robot_namespace, const std::string& topic) {
    Channel channel =
        below(robot_namespace, topic.empty() ? "command/motor_speed" : topic, {{"velocity", "rad/s"}});
    channel.is_list = true;
    return channel;
}

void MotorModelSpec::check(Problems& problems) const {
    expect_one("jointName", joint.size(), problems);
    expect_one("linkName", link.size(), problems);
    expect(direction == "cw" || direction == "ccw", "has a <turningDirection> that is neither cw nor ccw",
           "Write cw or ccw.", problems);
    expect(motor_type == "velocity",
           "has a <motorType> other than velocity, which Gazebo does not run either",
           "Write <motorType>velocity</motorType>.", problems);
    expect(time_up > 0 && time_down > 0, "has a time constant that is not positive",
           "Write <timeConstantUp> and <timeConstantDown> in s.", problems);
    expect(slowdown > 0, "has a <rotorVelocitySlowdownSim> that is not positive", "Write 1 or more.",
           problems);
    expect(index() >= 0 && index() < 1000, "has an <actuator_number> that is out of range",
           "Count the rotors from 0.", problems);
}

std::vector<Channel> MulticopterControlSpec::channels() const {
    return {below(robot_namespace, topic,
                  {{"linear_x", "m/s"},
                   {"linear_y", "m/s"},
                   {"linear_z", "m/s"},
                   {"angular_x", "rad/s"},
                   {"angular_y", "rad/s"},
                   {"angular_z", "rad/s"}}),
            below(robot_namespace, enable_topic, {{"enable", ""}})};
}

void MulticopterControlSpec::check(Problems& problems) const {
    expect_one("comLinkName", link.size(), problems);
    expect(rotors.size() >= 4 && rotors.size() <= 64, "has fewer than 4 rotors, or more than 64",
           "Write a <rotor> for each in <rotorConfiguration>.", problems);
    for (const RotorSpec& rotor : rotors) {
        expect_one("jointName", rotor.joint.size(), problems);
        expect(rotor.force_constant > 0, "has a rotor whose <forceConstant> is not positive",
               "Write the thrust by angular velocity squared.", problems);
    }
    const auto positive = [](const Vec3& v) { return v.x > 0 && v.y > 0 && v.z > 0; };
    expect(positive(velocity_gain) && positive(attitude_gain) && positive(angular_rate_gain),
           "has a gain that is not positive",
           "Write three positive numbers in <velocityGain>, <attitudeGain> and <angularRateGain>.", problems);
}

void LiftDragSpec::check(Problems& problems) const {
    expect_one("link_name", link.size(), problems);
    expect(control_joint.size() <= 1, "has several <control_joint_name>", "Name one.", problems);
    expect(density >= 0 && area >= 0, "has a negative <air_density> or <area>", "Write at least 0.",
           problems);
    expect(is_direction(forward) && is_direction(upward), "has a direction of length zero",
           "Write <forward> and <upward> as vectors.", problems);
}

void AdvancedLiftDragSpec::check(Problems& problems) const {
    expect_one("link_name", link.size(), problems);
    expect(density >= 0 && area > 0 && aspect_ratio > 0 && efficiency > 0,
           "has an <area>, <AR> or <eff> that is not positive, or a negative <air_density>",
           "Write the wing's area, aspect ratio and efficiency.", problems);
    expect(is_direction(cross(forward, upward)), "has <forward> and <upward> along one line",
           "Write two vectors at right angles.", problems);
    expect(surfaces.size() <= 32, "has more than 32 control surfaces", "Leave some out.", problems);
    for (const ControlSurfaceSpec& surface : surfaces) expect_one("name", surface.joint.size(), problems);
}

std::vector<Channel> ThrusterSpec::channels() const {
    const ChannelValue value = by_velocity ? ChannelValue{"velocity", "rad/s"} : ChannelValue{"thrust", "N"};
    const std::string joint_path = joint.empty() ? "" : "joint/" + joint.front() + "/";
    if (!topic.empty())
        return {below(robot_namespace, topic, {value}),
                below(robot_namespace, topic + "/enable_deadband", {{"enable", ""}})};
    std::vector<Channel> channels{
        below(robot_namespace, joint_path + (by_velocity ? "cmd_vel" : "cmd_thrust"), {value}),
        below(robot_namespace, joint_path + "enable_deadband", {{"enable", ""}})};
    for (Channel& channel : channels) channel.topic = "/model" + channel.topic;
    return channels;
}

void ThrusterSpec::check(Problems& problems) const {
    expect_one("joint_name", joint.size(), problems);
    expect(density > 0 && diameter > 0, "has a <fluid_density> or <propeller_diameter> that is not positive",
           "Write both.", problems);
    expect(min_command <= max_command, "has a <min_thrust_cmd> above <max_thrust_cmd>", "Exchange them.",
           problems);
    expect(coefficient != 0 && alpha_1 != 0, "has a thrust coefficient of zero",
           "Write a <thrust_coefficient> other than 0.", problems);
}

std::vector<Channel> BuoyancyEngineSpec::channels() const {
    Channel channel;
    channel.name = "buoyancy_engine";
    channel.topic =
        robot_namespace.empty() ? "/buoyancy_engine/" : "/model/" + robot_namespace + "/buoyancy_engine/";
    channel.values = {{"volume", "m^3"}};
    return {channel};
}

void BuoyancyEngineSpec::check(Problems& problems) const {
    expect_one("link_name", link.size(), problems);
    expect(min_volume >= 0 && min_volume <= max_volume,
           "has a <min_volume> that is negative or above <max_volume>", "Write volumes in m^3.", problems);
    expect(density >= 0 && max_rate >= 0, "has a negative <fluid_density> or <max_inflation_rate>",
           "Write at least 0.", problems);
}

const HydrodynamicsSpec::Names& HydrodynamicsSpec::names() {
    static const Names all{names_of("", nullptr), names_of("", "abs"), names_of("", ""),
                           names_of("Dot", nullptr)};
    return all;
}

std::vector<Channel> HydrodynamicsSpec::channels() const {
    Channel channel;
    channel.name = "ocean_current";
    channel.topic =
        robot_namespace.empty() ? "/ocean_current" : "/model/" + robot_namespace + "/ocean_current";
    channel.values = {{"x", "m/s"}, {"y", "m/s"}, {"z", "m/s"}};
    return {channel};
}

void HydrodynamicsSpec::check(Problems& problems) const {
    expect_one("link_name", link.size(), problems);
    if (linear.size() != 36 || absolute.size() != 216 || square.size() != 216 || added_mass.size() != 36)
        return problems.push_back({"has matrices of the wrong size", "Write them all."});
    std::array<double, 36> inertia{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            inertia[6 * i + j] = -0.5 * (added_mass[6 * i + j] + added_mass[6 * j + i]);
    expect(is_positive_semidefinite(inertia.data()),
           "has derivatives by the acceleration (xDotU ...) that take mass away",
           "Write them negative or 0: -xDotU is the added mass.", problems);
}

bool is_positive_semidefinite(const double* matrix) {
    double size = 0;
    for (std::size_t i = 0; i < 6; ++i) size = std::max(size, std::fabs(matrix[7 * i]));
    std::array<double, 36> L{};
    const double least = 1e-12 * size;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = matrix[6 * i + j];
            for (std::size_t k = 0; k < j; ++k) rest -= L[6 * i + k] * L[6 * j + k];
            if (i == j) {
                if (!(rest >= -least)) return false;
                L[7 * i] = rest > least ? std::sqrt(rest) : 0.0;
            } else if (L[7 * j] > 0) {
                L[6 * i + j] = rest / L[7 * j];
            } else if (std::fabs(rest) > 1e-6 * size) {
                return false;
            }
        }
    }
    return true;
}

void LighterThanAirSpec::check(Problems& problems) const {
    expect(link.size() == 1, "does not name one link", "Write <link_name>.", problems);
    expect(density >= 0, "has a negative <air_density>", "Write it in kg/m^3.", problems);
    expect(force_viscous >= 0 && axial_drag >= 0,
           "has a negative <force_viscous_coeff> or <axial_drag_coeff>, which would feed the motion",
           "Write at least 0: drag takes energy.", problems);
}

void WindEffectsSpec::check(Problems& problems) const {
    expect(scale >= 0, "has a negative <force_approximation_scaling_factor>", "Write at least 0.", problems);
    expect(magnitude_rise > 0 && direction_rise > 0 && vertical_rise > 0,
           "has a <time_for_rise> that is not positive", "Write it in s.", problems);
    expect(magnitude_period > 0 && direction_period > 0, "has a <period> that is not positive",
           "Write it in s.", problems);
}

void BuoyancySpec::check(Problems& problems) const {
    bool dense = density >= 0 && lowest_density >= 0;
    for (const FluidLayer& layer : layers) dense = dense && layer.density >= 0;
    expect(dense, "has a negative density", "Write densities in kg/m^3, at least 0.", problems);
}

FluidLayers FluidLayers::of(const BuoyancySpec& spec) {
    FluidLayers fluid;
    fluid.everywhere = spec.enabled.empty();
    fluid.densities = {spec.graded ? spec.lowest_density : spec.density};
    if (!spec.graded) return fluid;
    std::vector<FluidLayer> layers = spec.layers;
    std::ranges::stable_sort(layers, {}, &FluidLayer::above);
    for (const FluidLayer& layer : layers) {
        if (!fluid.heights.empty() && layer.above == fluid.heights.back()) {
            fluid.densities.back() = layer.density;
            continue;
        }
        fluid.heights.push_back(layer.above), fluid.densities.push_back(layer.density);
    }
    return fluid;
}

}  // namespace roboss
