// What WheelSlip and LookupWheelSlip state about themselves.
#include <algorithm>

#include "onboard_kinds/lookup_wheel_slip.h"
#include "onboard_kinds/wheel_slip.h"

namespace roboss {
namespace {

constexpr double kRunStart = 1 << 24;  // of a run's column

}  // namespace

std::vector<Channel> WheelSlipSpec::channels() const {
    std::vector<Channel> found;
    for (const SlipWheelSpec& wheel : wheels) {
        if (wheel.link.empty()) continue;
        found.push_back(
            channel_of("", compliances_of(wheel.link.front()), {{"lateral", ""}, {"longitudinal", ""}}));
        found.push_back(
            channel_of("", friction_of(wheel.link.front()), {{"primary", ""}, {"secondary", ""}}));
    }
    return found;
}

void WheelSlipSpec::check(std::vector<OnboardProblem>& problems) const {
    if (wheels.empty()) problems.push_back({"has no <wheel>", "Write one for each wheel that slips."});
    for (const SlipWheelSpec& wheel : wheels) {
        const std::string name = wheel.link.empty() ? std::string() : wheel.link.front();
        if (wheel.link.size() != 1)
            problems.push_back({"has a <wheel> without link_name", "Write <wheel link_name=\"LINK\">."});
        if (!(wheel.radius > 0 && wheel.normal_force > 0))
            problems.push_back(
                {"has no positive <wheel_radius> and <wheel_normal_force> of wheel '" + name + "'",
                 "Write them in m and N: compliances are relative to them."});
        if (wheel.lateral < 0 || wheel.longitudinal < 0)
            problems.push_back(
                {"has a negative compliance of wheel '" + name + "'", "Write at least 0: 0 does not slip."});
    }
}

ColourMap ColourMap::of(int columns, int rows, const std::vector<std::uint8_t>& samples) {
    ColourMap map{columns, rows, {}, {}};
    const std::uint8_t* sample = samples.data();
    for (int row = 0; row < rows; ++row) {
        map.first_run.push_back(static_cast<double>(map.runs.size()));
        std::uint32_t last = ~0u;
        for (int column = 0; column < columns; ++column, sample += 3) {
            const std::uint32_t colour =
                std::uint32_t{sample[0]} << 16 | std::uint32_t{sample[1]} << 8 | std::uint32_t{sample[2]};
            if (colour != last) map.runs.push_back(column * kRunStart + colour);
            last = colour;
        }
    }
    map.first_run.push_back(static_cast<double>(map.runs.size()));
    return map;
}

std::uint32_t ColourMap::at(int column, int row) const {
    const auto run = [&](int r) {
        return runs.begin() + static_cast<std::ptrdiff_t>(first_run[static_cast<std::size_t>(r)]);
    };
    const auto next = std::upper_bound(run(row), run(row + 1), column * kRunStart + (kRunStart - 1));
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(*(next - 1)) & 0xffffffu);
}

std::vector<std::string> LookupWheelSlipSpec::commands() const {
    std::vector<std::string> names;
    for (const std::string& wheel : wheels) {
        names.push_back(WheelSlipSpec::compliances_of(wheel));
        names.push_back(WheelSlipSpec::friction_of(wheel));
    }
    return names;
}

void LookupWheelSlipSpec::check(std::vector<OnboardProblem>& problems) const {
    if (!(size_x > 0 && size_y > 0))
        problems.push_back({"has no positive <size_x> and <size_y>", "Write the size of the map in m."});
    if (wheels.empty())
        problems.push_back({"names no wheels", "Write a <wheel_link_name> for each wheel of the WheelSlip."});
    // A Model may come from another machine, so the map is checked as well.
    const auto count = static_cast<std::size_t>(std::max(map.rows, 0));
    bool fits = map.columns > 0 && map.rows > 0 && map.columns <= 8193 && map.rows <= 8193 &&
                map.first_run.size() == count + 1 && map.first_run.front() == 0 &&
                map.first_run.back() == static_cast<double>(map.runs.size());
    for (std::size_t r = 0; fits && r < count; ++r) {
        fits = map.first_run[r] < map.first_run[r + 1] && map.first_run[r + 1] <= map.first_run.back();
        const auto first = static_cast<std::size_t>(map.first_run[r]);
        fits = fits && map.first_run[r] == static_cast<double>(first) && map.runs[first] >= 0 &&
               map.runs[first] < kRunStart;
        for (std::size_t i = first + 1; fits && i < static_cast<std::size_t>(map.first_run[r + 1]); ++i)
            fits = map.runs[i] > map.runs[i - 1] && map.runs[i] < map.columns * kRunStart;
    }
    if (!fits) problems.push_back({"has no map that can be read", "Give <slip_map> a PNG picture."});
}

}  // namespace roboss
