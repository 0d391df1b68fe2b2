// The environmental sensor against functions that are linear in each coordinate and in time.
#include <gtest/gtest.h>

#include "sensors/geodesy.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

/// Linear in each: what the table below holds.
double truth(double t, double x, double y, double z) {
    return 3 + 0.5 * t - x + 2 * y * z + 0.25 * t * x * y;
}

EnvironmentalSpec table_spec() {
    EnvironmentalSpec spec;
    spec.variable = "humidity", spec.reference = "global";
    spec.times = {1, 2, 5}, spec.xs = {-1, 0, 4}, spec.ys = {-2, 2}, spec.zs = {0, 1, 3};
    for (const double t : spec.times)
        for (const double x : spec.xs)
            for (const double y : spec.ys)
                for (const double z : spec.zs) spec.values.push_back(truth(t, x, y, z));
    return spec;
}

/// A cart whose cart link carries the sensor; a tick is 1/8 s.
struct Cart {
    std::shared_ptr<Model> model;
    RobotState state;

    explicit Cart(const SensorParameters& parameters, const Pose& X_WB = {}) : state(cart_at(X_WB)) {
        RobotType type = cart_type();
        add_sensor(type, 0, sensor("environment", parameters));
        model = model_of(type, 1);
        model->dt_s = 0.125;
    }
    std::vector<double> read(double time) const {
        return read_as<EnvironmentalReading>(model, {&state}, 0, static_cast<Tick>(time * 8)).values;
    }
};

std::vector<double> value_at(double t, double x, double y, double z) {
    return Cart(table_spec(), {{x, y, z}, {}}).read(t);
}

TEST(Environmental, IsLinearBetweenThePointsOfTheTable) {
    const double places[][4] = {
        {1, -1, -2, 0},        {2, 0, 2, 1},    {5, 4, 2, 3}, {1.5, 0, 2, 1},
        {2, 3, 2, 1},          {2, 0, -0.5, 1}, {2, 0, 2, 2}, {3.125, -0.75, 1.25, 0.5},
        {4.875, 3.5, 1.5, 2.5}};
    for (const auto& p : places) {
        const std::vector<double> values = value_at(p[0], p[1], p[2], p[3]);
        ASSERT_EQ(values.size(), 1u) << p[0] << " " << p[1] << " " << p[2] << " " << p[3];
        EXPECT_NEAR(values[0], truth(p[0], p[1], p[2], p[3]), 1e-12);
    }
}

TEST(Environmental, SaysNothingOutsideTheTable) {
    EXPECT_EQ(value_at(2, 0, 0, 1).size(), 1u);
    EXPECT_TRUE(value_at(0.875, 0, 0, 1).empty()) << "before the first time";
    EXPECT_TRUE(value_at(5.125, 0, 0, 1).empty()) << "behind the last time";
    EXPECT_TRUE(value_at(2, -1.01, 0, 1).empty());
    EXPECT_TRUE(value_at(2, 4.01, 0, 1).empty());
    EXPECT_TRUE(value_at(2, 0, 2.01, 1).empty());
    EXPECT_TRUE(value_at(2, 0, 0, -0.01).empty());
}

TEST(Environmental, WithoutATableItSaysNothing) {
    EXPECT_TRUE(Cart(EnvironmentalSpec{}).read(0).empty());
    EnvironmentalSpec torn = table_spec();
    torn.values.pop_back();
    EXPECT_TRUE(Cart(torn).read(2).empty());
}

TEST(Environmental, AStaticTableCountsAtAnyTime) {
    EnvironmentalSpec spec = table_spec();
    spec.is_static = true;
    EXPECT_NEAR(Cart(spec).read(100).at(0), truth(1, 0, 0, 0), 1e-12);
}

/// Three columns with these values everywhere.
EnvironmentalSpec vector_spec(const std::string& transform) {
    EnvironmentalSpec spec;
    spec.output_format = "vector3", spec.transform_type = transform, spec.reference = "global";
    spec.times = {0, 100}, spec.xs = {-9, 9}, spec.ys = {-9, 9}, spec.zs = {-9, 9};
    for (const double value : {1.0, 2.0, 3.0})
        for (std::size_t i = 0; i < spec.points(); ++i) spec.values.push_back(value);
    return spec;
}

TEST(Environmental, VectorsAreInTheWorldOrTheSensorAndMayCountItsVelocity) {
    const auto read = [](const std::string& transform) {
        Cart cart(vector_spec(transform), {{0, 0, 0}, from_rpy(0, 0, 0.5 * kPi)});
        cart.state.v[3] = 0.5;  // m/s along world x
        const auto v = cart.read(1);
        return Vec3{v.at(0), v.at(1), v.at(2)};
    };
    const auto expect = [](const Vec3& a, const Vec3& b) {
        EXPECT_LT(norm(a - b), 1e-12) << a.x << " " << a.y;
    };
    expect(read("GLOBAL"), {1, 2, 3});
    expect(read("LOCAL"), {2, -1, 3});
    expect(read("ADD_VELOCITY_GLOBAL"), {0.5, 2, 3});
    expect(read("ADD_VELOCITY_LOCAL"), {2, -0.5, 3});
}

TEST(Environmental, ReadsTablesByLatitudeAndLongitude) {
    EnvironmentalSpec spec;
    spec.variable = "depth", spec.reference = "spherical", spec.in_degrees = true;
    spec.times = {0, 100}, spec.xs = {46, 48}, spec.ys = {7, 9}, spec.zs = {-100, 100};
    for (int t = 0; t < 2; ++t)
        for (const double latitude : spec.xs)
            for (const double longitude : spec.ys)
                for (int z = 0; z < 2; ++z) spec.values.push_back(latitude + 100 * longitude);
    Cart cart(spec, {{1000, 2000, 0}, {}});
    EXPECT_TRUE(cart.read(1).empty()) << "a world without spherical coordinates";
    cart.model->spherical.emplace();
    cart.model->spherical->latitude_rad = 47 * kPi / 180,
    cart.model->spherical->longitude_rad = 8 * kPi / 180;
    const Geodetic place = world_to_geodetic(*cart.model->spherical, {1000, 2000, 0});
    const double degrees = 180 / kPi;
    EXPECT_NEAR(cart.read(1).at(0), place.latitude_rad * degrees + 100 * place.longitude_rad * degrees, 1e-9);
    EXPECT_GT(cart.read(1).at(0), 47.01 + 801);
}

}  // namespace
}  // namespace roboss
