// LookupWheelSlip of Gazebo: the slip and the friction of wheels by their place, from a picture. It commands
// the robot's WheelSlip.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// A picture that lies on the ground, as runs of equal colour: row by row from the top (+y), each row from
/// the left (-x).
struct ColourMap {
    int columns = 0, rows = 0;      ///< pixels
    std::vector<double> first_run,  ///< of each row, in `runs`; and the count of runs
        runs;                       ///< first column * 2^24 + red * 2^16 + green * 2^8 + blue

    /// Packs 8-bit samples, red, green, blue of each pixel.
    static ColourMap of(int columns, int rows, const std::vector<std::uint8_t>& samples);
    /// Red, green, blue of a pixel in the map: red * 2^16 + green * 2^8 + blue.
    std::uint32_t at(int column, int row) const;
    /// Compares all members.
    friend bool operator==(const ColourMap&, const ColourMap&) = default;
};

/// A sample of 128 leaves a value as it is; another one adds (sample - 128) * delta. Red: lateral slip,
/// green: longitudinal slip, blue: friction. Beyond the map, the last values hold.
struct LookupWheelSlipSpec {
    ColourMap map;                   ///< read by the importer from <slip_map>
    double size_x = 0,               ///< m, of the map, which is centred at the world's origin
        size_y = 0,                  ///< m
        lateral_delta = 0.05,        ///< compliance per step of red
        longitudinal_delta = 0.005,  ///< compliance per step of green
        friction_delta = 0.5;        ///< coefficient per step of blue
    LinkNames wheels;                ///< of the WheelSlip

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 94,
                                       .name = "lookup-wheel-slip",
                                       .phrase = "a wheel slip by place",
                                       .classes = "LookupWheelSlip",
                                       .files = "lookup-wheel-slip-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"columns", ""}, s.map.columns);
        visit({"rows", ""}, s.map.rows);
        visit({"first_run", ""}, s.map.first_run);
        visit({"runs", ""}, s.map.runs);
        visit({"size_x", "size_x", "m"}, s.size_x);
        visit({"size_y", "size_y", "m"}, s.size_y);
        visit({"lateral_delta", "slip_compliance_lateral_delta"}, s.lateral_delta);
        visit({"longitudinal_delta", "slip_compliance_longitudinal_delta"}, s.longitudinal_delta);
        visit({"friction_delta", "friction_delta"}, s.friction_delta);
        visit({"wheels", "wheel_link_name"}, s.wheels);
    }
    /// It takes no command.
    std::vector<Channel> channels() const { return {}; }
    /// What it commands: of each wheel the compliances and the friction.
    std::vector<std::string> commands() const;
    /// Its memory: of each wheel the colour that it commanded last; -1: none.
    std::vector<double> memory() const { return std::vector<double>(wheels.size(), -1.0); }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const LookupWheelSlipSpec&, const LookupWheelSlipSpec&) = default;
};

}  // namespace roboss
