// Barometer and air speed sensor against the tables of the standard atmosphere and Bernoulli's law.
#include <gtest/gtest.h>

#include <cmath>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

/// A cart with a sensor on its mast (link 1, 1 m above it).
struct Cart {
    std::shared_ptr<Model> model;
    RobotState state = cart_at({});

    explicit Cart(const SensorParameters& parameters, const Pose& X_LS = {}) {
        RobotType type = cart_type();
        add_sensor(type, 1, sensor("air", parameters, X_LS));
        model = model_of(type, 1);
    }
    template <class Reading>
    Reading read(Tick tick = 0) const {
        return read_as<Reading>(model, {&state}, 0, tick);
    }
};

double pressure_at(double reference, double z) {
    AirPressureSpec spec;
    spec.reference_altitude = reference;
    Cart cart(spec);
    cart.state = cart_at({{0, 0, z - 1}, {}});
    return cart.read<AirPressureReading>().pressure;
}

TEST(AirPressure, IsThatOfTheStandardAtmosphere) {
    EXPECT_NEAR(pressure_at(0, 0), 101325, 1e-6);
    // U.S. Standard Atmosphere 1976, table of geometric heights.
    EXPECT_NEAR(pressure_at(0, 1000), 89876, 1);
    EXPECT_NEAR(pressure_at(0, 5000), 54048, 1);
    EXPECT_NEAR(pressure_at(0, 10000), 26500, 1);
    EXPECT_NEAR(pressure_at(4990, 10), pressure_at(0, 5000), 1e-9);
}

TEST(AirPressure, FallsByTheWeightOfTheAir) {
    const double h = 0.5, slope = (pressure_at(0, 100 + h) - pressure_at(0, 100 - h)) / (2 * h);
    const double temperature = 288.15 - 0.0065 * 100,
                 density = pressure_at(0, 100) / (287.0528 * temperature);
    EXPECT_NEAR(slope, -density * 9.80665, 2e-3);  // the geopotential height differs by 3e-5
}

TEST(AirPressure, OutsideTheAtmosphereIsAnError) {
    Cart cart(AirPressureSpec{});
    cart.state = cart_at({{0, 0, 1e6}, {}});
    KnownStates sources(cart.model, {&cart.state});
    EXPECT_FALSE(measure({*cart.model, RobotId(std::size_t{0}), 0, cart.state, 0, 1, sources}).ok());
}

/// Mean and standard deviation of the difference to an exact value.
template <class Read>
std::pair<double, double> statistics(const Read& read, double exact) {
    double sum = 0, squares = 0;
    const int count = 4000;
    for (Tick t = 0; t < count; ++t) {
        const double error = read(t) - exact;
        sum += error, squares += error * error;
    }
    return {sum / count, std::sqrt(squares / count - sum * sum / count / count)};
}

TEST(AirPressure, HasTheNoiseOfTheFile) {
    AirPressureSpec spec;
    spec.noise.mean = 3, spec.noise.stddev = 50;
    const Cart cart(spec);
    const auto [mean, deviation] =
        statistics([&](Tick t) { return cart.read<AirPressureReading>(t).pressure; }, pressure_at(0, 1));
    EXPECT_NEAR(mean, 3, 2.5);
    EXPECT_NEAR(deviation, 50, 2);
}

TEST(AirSpeed, IsTheDynamicPressureOfTheWindAndTheMotionAlongX) {
    Cart cart(AirSpeedSpec{}, {{0, 0, 0}, from_rpy(0, 0, 0.5 * kPi)});  // looks along the cart's y
    cart.state = cart_at({{0, 0, -1}, {}});
    cart.state.v[3] = 100, cart.state.v[4] = 20;  // m/s along x, y
    const AirSpeedReading still = cart.read<AirSpeedReading>();
    EXPECT_NEAR(still.diff_pressure, 0.5 * 1.225 * 20 * 20, 1e-9);
    EXPECT_EQ(still.temperature, 288.15);
    cart.model->wind = {0, -10, 0};  // into the tube
    EXPECT_NEAR(cart.read<AirSpeedReading>().diff_pressure, 0.5 * 1.225 * 30 * 30, 1e-9);
    cart.model->wind = {0, 50, 0};  // from behind
    EXPECT_NEAR(cart.read<AirSpeedReading>().diff_pressure, -0.5 * 1.225 * 30 * 30, 1e-9);
}

TEST(AirSpeed, FeelsTheTurnOfItsLinkAndTheThinAirOfHeights) {
    Cart cart(AirSpeedSpec{});
    cart.state.v[1] = 5;  // rad/s about y: the mast, 1 m up, moves along x with 5 m/s
    cart.state.q[2] = 3000 - 1;
    const double temperature = 288.15 - 0.0065 * 3000;
    const double density = 1.225 * std::pow(temperature / 288.15, 4.256);
    const AirSpeedReading reading = cart.read<AirSpeedReading>();
    EXPECT_NEAR(reading.diff_pressure, 0.5 * density * 25, 1e-9);
    EXPECT_NEAR(reading.temperature, temperature, 1e-9);
    EXPECT_NEAR(density, 0.9093, 1e-3);  // of the table
}

TEST(AirSpeed, ItsNoiseIsInHectopascals) {
    AirSpeedSpec spec;
    spec.noise.mean = 0.01, spec.noise.stddev = 0.5;
    const Cart cart(spec);
    const auto [mean, deviation] =
        statistics([&](Tick t) { return cart.read<AirSpeedReading>(t).diff_pressure; }, 0);
    EXPECT_NEAR(mean, 1, 2.5);
    EXPECT_NEAR(deviation, 50, 2);
}

}  // namespace
}  // namespace roboss
