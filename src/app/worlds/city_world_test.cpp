// The generated city: the density stays, nothing stands in a car's way at the start.
#include "app/worlds/city_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace roboss {
namespace {

TEST(CityWorld, AnotherSeedIsAnotherCity) {
    EXPECT_NE(city_sdf({50, 1}), city_sdf({50, 2}));
    EXPECT_EQ(city_sdf({50, 2}), city_sdf({50, 2}));
}

TEST(CityWorld, HasTheCarsAskedForAtAboutTheSameDensity) {
    for (int cars : {1, 2, 50, 500, 2000, 10000}) {
        const CityPlan plan = plan_city({cars, 1});
        EXPECT_EQ(plan.cars.size(), static_cast<std::size_t>(cars));
        if (cars >= 50) {
            EXPECT_NEAR(plan.width * plan.depth / cars, 110, 12) << cars;
        }
    }
}

/// Distance from a point to the solid's side; negative inside.
double distance_to(const CitySolid& solid, double x, double y) {
    const double dx = x - solid.x, dy = y - solid.y;
    if (solid.radius > 0) return std::sqrt(dx * dx + dy * dy) - solid.radius;
    const double c = std::cos(solid.yaw), s = std::sin(solid.yaw);
    const double u = std::fabs(c * dx + s * dy) - 0.5 * solid.length,
                 v = std::fabs(c * dy - s * dx) - 0.5 * solid.width;
    return u > 0 && v > 0 ? std::sqrt(u * u + v * v) : std::max(u, v);
}

TEST(CityWorld, EveryCarStartsInTheOpen) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const CityPlan plan = plan_city({50, seed});
        for (std::size_t i = 0; i < plan.cars.size(); ++i) {
            const CarPlace& car = plan.cars[i];
            EXPECT_LT(std::fabs(car.x), 0.5 * plan.width);
            EXPECT_LT(std::fabs(car.y), 0.5 * plan.depth);
            for (const CityGroup& group : plan.groups)
                for (const CitySolid& solid : group.solids)
                    EXPECT_GT(distance_to(solid, car.x, car.y), 0.35)
                        << "seed " << seed << " car " << i << " " << group.name;
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GT(std::hypot(car.x - plan.cars[j].x, car.y - plan.cars[j].y), 1.0) << "seed " << seed;
        }
    }
}

TEST(CityWorld, ModelNamesAreUnique) {
    std::set<std::string> names;
    for (const CityGroup& group : plan_city({500, 3}).groups)
        EXPECT_TRUE(names.insert(group.name).second) << group.name;
}

}  // namespace
}  // namespace roboss
