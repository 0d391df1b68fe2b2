#include "app/worlds/city_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/fixed_math.h"
#include "core/noise.h"

namespace roboss {
namespace {

constexpr double kPitch = kStreetWidth + kBlockSize;
constexpr double kBlocksPerCar = 36.0 / 50.0;
constexpr double kAlley = 1.6;
constexpr const char* kFacades[] = {"0.80 0.74 0.66", "0.72 0.62 0.55", "0.66 0.70 0.74",
                                    "0.84 0.80 0.74", "0.60 0.56 0.58", "0.76 0.68 0.60"};
constexpr const char* kParkedColours[] = {"0.25 0.42 0.62", "0.62 0.25 0.24", "0.30 0.32 0.36",
                                          "0.86 0.86 0.84"};
constexpr const char* kTree = "0.35 0.52 0.33";
constexpr const char* kWall = "0.55 0.55 0.55";
constexpr const char* kBollard = "0.90 0.72 0.20";

double to_centimetres(double x) {
    return std::floor(x * 100.0 + 0.5) / 100.0;
}

/// Random numbers about one thing of the city, in the order in which they are asked for.
class Dice {
  public:
    Dice(std::uint64_t seed, std::uint32_t what, std::size_t which)
        : stream_{seed, what, static_cast<std::uint32_t>(which), 0} {}
    double between(double low, double high) {
        return to_centimetres(low + (high - low) * random_uniform(stream_, index_++));
    }
    bool chance(double probability) { return random_uniform(stream_, index_++) < probability; }
    std::size_t below(std::size_t n) {
        return static_cast<std::size_t>(static_cast<double>(n) * random_uniform(stream_, index_++));
    }

  private:
    NoiseStream stream_;
    std::uint64_t index_ = 0;
};

enum Topic : std::uint32_t { kBlockTopic, kStreetTopic, kPlaceTopic };

struct Grid {
    int columns = 1, rows = 1;
    double width() const { return columns * kPitch + kStreetWidth; }
    double depth() const { return rows * kPitch + kStreetWidth; }
    double block_x(int i) const { return -0.5 * width() + kStreetWidth + 0.5 * kBlockSize + i * kPitch; }
    double block_y(int j) const { return -0.5 * depth() + kStreetWidth + 0.5 * kBlockSize + j * kPitch; }
};

/// A piece of street between two crossings: its middle, its direction (east or north), and what stands on it.
struct Street {
    double x = 0, y = 0;
    bool north = false;
    std::vector<CitySolid> obstacles;  // in the street's own axes: x along, y to the left

    CarPlace place(double along, double left, double yaw) const {
        if (north) return {x - left, y + along, yaw + 0.5 * kPi};
        return {x + along, y + left, yaw};
    }
};

Grid grid_for(int cars) {
    const double blocks = std::fmax(1.0, std::ceil(cars * kBlocksPerCar));
    Grid grid;
    while (static_cast<double>(grid.columns) * grid.columns < blocks) ++grid.columns;
    grid.rows = static_cast<int>(std::ceil(blocks / grid.columns));
    return grid;
}

CitySolid building(Dice& dice, double x, double y, double length, double width) {
    return {to_centimetres(x),
            to_centimetres(y),
            0,
            length,
            width,
            0,
            dice.between(1.5, 7.0),
            kFacades[dice.below(std::size(kFacades))]};
}

void add_trees(Dice& dice, double x, double y, std::vector<CitySolid>& out) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double dx = dice.between(-0.4, 0.4), dy = dice.between(-0.4, 0.4),
                         radius = dice.between(0.15, 0.35);
            out.push_back({to_centimetres(x + 2.7 * (i - 1) + dx), to_centimetres(y + 2.7 * (j - 1) + dy), 0,
                           0, 0, radius, dice.between(1.0, 2.0), kTree});
        }
}

/// One block: one large building, two or four with alleys between them, a round tower, or a park.
std::vector<CitySolid> build_block(Dice& dice, double x, double y) {
    std::vector<CitySolid> solids;
    const std::size_t kind = dice.below(10);
    const double half = 0.5 * (kBlockSize - kAlley), offset = 0.5 * (half + kAlley);
    if (kind < 3) {
        solids.push_back(building(dice, x, y, kBlockSize, kBlockSize));
    } else if (kind < 5) {
        for (double side : {-offset, offset}) solids.push_back(building(dice, x + side, y, half, kBlockSize));
    } else if (kind < 6) {
        for (double side : {-offset, offset}) solids.push_back(building(dice, x, y + side, kBlockSize, half));
    } else if (kind < 8) {
        for (double sx : {-offset, offset})
            for (double sy : {-offset, offset}) solids.push_back(building(dice, x + sx, y + sy, half, half));
    } else if (kind < 9) {
        CitySolid tower = building(dice, x, y, 0, 0);
        tower.radius = dice.between(3.0, 3.8);
        solids.push_back(tower);
    } else {
        add_trees(dice, x, y, solids);
    }
    return solids;
}

void add_blocks(const Grid& grid, std::uint64_t seed, CityPlan& plan) {
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            Dice dice(seed, kBlockTopic,
                      static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.columns) +
                          static_cast<std::size_t>(i));
            plan.groups.push_back({"block_" + std::to_string(i) + "_" + std::to_string(j),
                                   build_block(dice, grid.block_x(i), grid.block_y(j))});
        }
}

void add_city_wall(const Grid& grid, CityPlan& plan) {
    const double x = 0.5 * grid.width() + 0.15, y = 0.5 * grid.depth() + 0.15;
    const double length = grid.width() + 0.6, depth = grid.depth() + 0.6;
    plan.groups.push_back({"city_wall",
                           {{0, -y, 0, length, 0.3, 0, 0.6, kWall},
                            {0, y, 0, length, 0.3, 0, 0.6, kWall},
                            {-x, 0, 0, 0.3, depth, 0, 0.6, kWall},
                            {x, 0, 0, 0.3, depth, 0, 0.6, kWall}}});
}

std::vector<Street> lay_streets(const Grid& grid) {
    std::vector<Street> streets;
    const double half_pitch = 0.5 * kPitch;
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i)
            streets.push_back({grid.block_x(i), grid.block_y(0) + (j - 1) * kPitch + half_pitch, false, {}});
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i)
            streets.push_back({grid.block_x(0) + (i - 1) * kPitch + half_pitch, grid.block_y(j), true, {}});
    return streets;
}

CitySolid parked_vehicle(Dice& dice, double along, double left) {
    const bool van = dice.chance(0.3);
    return {along,
            left,
            dice.between(-0.08, 0.08),
            van ? 0.62 : 0.46,
            van ? 0.30 : 0.24,
            0,
            van ? 0.34 : 0.20,
            kParkedColours[dice.below(std::size(kParkedColours))]};
}

/// Vehicles along the kerbs and now and then a bollard in the roadway.
void park_obstacles(Dice& dice, Street& street) {
    for (double side : {-1.0, 1.0})
        for (double along : {-2.6, -1.3, 0.0, 1.3, 2.6})
            if (dice.chance(0.16))
                street.obstacles.push_back(
                    parked_vehicle(dice, along + dice.between(-0.2, 0.2), side * dice.between(1.5, 1.65)));
    if (dice.chance(0.3)) {
        const double along = dice.between(-2.5, 2.5), left = dice.between(-0.5, 0.5);
        street.obstacles.push_back({along, left, 0, 0, 0, dice.between(0.12, 0.2), 0.6, kBollard});
    }
}

void add_obstacles(const std::vector<Street>& streets, CityPlan& plan) {
    std::size_t number = 0;
    for (const Street& street : streets)
        for (CitySolid solid : street.obstacles) {
            const CarPlace place = street.place(solid.x, solid.y, solid.yaw);
            solid.x = to_centimetres(place.x), solid.y = to_centimetres(place.y), solid.yaw = place.yaw;
            plan.groups.push_back({"parked_" + std::to_string(number++), {solid}});
        }
}

bool is_free(const Street& street, double along, double left) {
    return std::all_of(street.obstacles.begin(), street.obstacles.end(), [&](const CitySolid& solid) {
        const double dx = solid.x - along, dy = solid.y - left;
        return dx * dx + dy * dy > 0.9 * 0.9;
    });
}

/// Every free place where a car can start: on the right-hand lane of each direction of each street.
std::vector<CarPlace> start_places(const std::vector<Street>& streets) {
    std::vector<CarPlace> places;
    for (const Street& street : streets)
        for (double along : {-3.0, -1.0, 1.0, 3.0})
            for (double left : {-0.7, 0.7})
                if (is_free(street, along, left))
                    places.push_back(street.place(along, left, left < 0 ? 0.0 : kPi));
    return places;
}

void place_cars(const std::vector<Street>& streets, const CityOptions& options, CityPlan& plan) {
    const std::vector<CarPlace> places = start_places(streets);
    std::vector<std::pair<std::uint64_t, std::size_t>> lots;
    for (std::size_t i = 0; i < places.size(); ++i)
        lots.emplace_back(random_bits({options.seed, kPlaceTopic, 0, 0}, i), i);
    std::sort(lots.begin(), lots.end());
    lots.resize(std::min(lots.size(), static_cast<std::size_t>(options.cars)));
    for (const auto& [lot, i] : lots) {
        Dice dice(options.seed, kPlaceTopic, i + 1);
        CarPlace car = places[i];
        car.x = to_centimetres(car.x), car.y = to_centimetres(car.y);
        car.yaw = wrap_angle(car.yaw + dice.between(-0.1, 0.1));
        plan.cars.push_back(car);
    }
}

}  // namespace

CityPlan plan_city(const CityOptions& options) {
    const Grid grid = grid_for(options.cars);
    CityPlan plan{grid.width(), grid.depth(), {}, {}};
    add_blocks(grid, options.seed, plan);
    add_city_wall(grid, plan);
    std::vector<Street> streets = lay_streets(grid);
    for (std::size_t i = 0; i < streets.size(); ++i) {
        Dice dice(options.seed, kStreetTopic, i);
        park_obstacles(dice, streets[i]);
    }
    add_obstacles(streets, plan);
    place_cars(streets, options, plan);
    return plan;
}

}  // namespace roboss
