// The PID controller against a reference that keeps its errors in a list, and against closed forms.
#include "onboard/pid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace roboss {
namespace {

constexpr double kDt = 0.004;

/// Commands for a list of errors, from sums and differences of the whole list. Without limits of the
/// integral.
std::vector<double> reference(const PidGains& g, const std::vector<double>& errors) {
    std::vector<double> commands;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const double sum = std::accumulate(errors.begin(), errors.begin() + static_cast<long>(k) + 1, 0.0);
        const double before = k == 0 ? 0.0 : errors[k - 1];
        double command = -(g.p * errors[k] + g.i * kDt * sum + g.d * (errors[k] - before) / kDt);
        command += g.cmd_offset;
        if (g.cmd_min <= g.cmd_max) command = std::min(std::max(command, g.cmd_min), g.cmd_max);
        commands.push_back(command);
    }
    return commands;
}

std::vector<double> wave(std::size_t count) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < count; ++k)
        errors.push_back(0.3 + std::cos(0.07 * static_cast<double>(k)) -
                         0.2 * std::sin(0.31 * static_cast<double>(k)));
    return errors;
}

std::vector<double> commands(const PidGains& gains, const std::vector<double>& errors) {
    std::vector<double> memory(2), found;
    for (const double error : errors) found.push_back(update_pid(gains, error, kDt, {memory, 0}));
    return found;
}

TEST(Pid, IsTheSumOfItsThreeParts) {
    const PidGains all[] = {{2, 0, 0, -1, 0, -1, 0, 0},
                            {0, 3, 0, -1, 0, -1, 0, 0},
                            {0, 0, 0.1, -1, 0, -1, 0, 0},
                            {2, 3, 0.1, -1, 0, -1, 0, 0.7},
                            {2, 3, 0.1, -1, 0, 1.5, -0.5, 0.7}};
    const std::vector<double> errors = wave(500);
    for (const PidGains& gains : all) {
        const std::vector<double> found = commands(gains, errors), expected = reference(gains, errors);
        for (std::size_t k = 0; k < errors.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-11) << k;
    }
}

TEST(Pid, TheFirstDerivativeIsAgainstNoError) {
    const PidGains gains{0, 0, 0.5, -1, 0, -1, 0, 0};
    EXPECT_EQ(commands(gains, {0.2, 0.2}), (std::vector<double>{-0.5 * (0.2 / kDt), 0}));
}

TEST(Pid, TheLimitsOfTheIntegralAreThoseOfItsShareOfTheCommand) {
    const PidGains gains{0, 10, 0, 0.25, -0.5, -1, 0, 0};
    std::vector<double> errors(200, 1.0);  // 10 * 0.004 each: at the limit after 7 ticks
    EXPECT_DOUBLE_EQ(commands(gains, errors).back(), -0.25);
    EXPECT_NEAR(commands(gains, errors)[4], -0.2, 1e-15);
    errors.assign(200, -1.0);
    EXPECT_DOUBLE_EQ(commands(gains, errors).back(), 0.5);
    errors.assign(200, 1.0), errors.insert(errors.end(), 5, -1.0);  // it comes back at once from its limit
    EXPECT_NEAR(commands(gains, errors).back(), -0.05, 1e-12);
}

TEST(Pid, NumbersThatAreNoneChangeNothing) {
    const PidGains gains{1, 1, 1, -1, 0, -1, 0, 3};
    std::vector<double> memory{0.25, 0.5};
    EXPECT_EQ(update_pid(gains, std::nan(""), kDt, {memory, 0}), 0);
    EXPECT_EQ(update_pid(gains, std::numeric_limits<double>::infinity(), kDt, {memory, 0}), 0);
    EXPECT_EQ(update_pid(gains, 1, 0, {memory, 0}), 0);
    EXPECT_EQ(memory, (std::vector<double>{0.25, 0.5}));
}

}  // namespace
}  // namespace roboss
