// <population>: where the clones stand, as in Gazebo's Population. What Gazebo draws from its global
// generator comes here from a fixed one (splitmix64, Steele et al. 2014), so a world is the same world every
// time it is loaded.
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/fixed_math.h"
#include "sdf/placements.h"

namespace roboss::sdf_import {
namespace {

constexpr int kMost = 1'000'000;

class FixedRandom {
  public:
    /// In [0, 1).
    double next() {
        state_ += 0x9E3779B97F4A7C15ull;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_ = 20050801;
};

/// The i-th number of the Halton sequence of this base: spreads evenly, whatever the count.
double halton(int i, int base) {
    double result = 0, fraction = 1;
    for (int n = i + 1; n > 0; n /= base) {
        fraction /= base;
        result += fraction * (n % base);
    }
    return result;
}

struct Region {
    bool cylinder = false;
    Vec3 size;  // box
    double radius = 0, length = 0;
};

Vec3 in_box(const Region& region, double a, double b, double c) {
    return {(a - 0.5) * region.size.x, (b - 0.5) * region.size.y, (c - 0.5) * region.size.z};
}

/// Even over the disc: the radius goes with the square root. As in Gazebo, a cylinder stands on its pose.
Vec3 in_cylinder(const Region& region, double a, double b, double c) {
    const SinCos angle = fixed_sincos((2.0 * a - 1.0) * kPi);
    const double r = region.radius * std::sqrt(b);
    return {r * angle.cos, r * angle.sin, c * region.length};
}

class Population {
  public:
    Population(const Element& element, const Import& import) : element_(element), import_(import) {}

    std::vector<Pose> poses() {
        const Pose X_WP = import_.reader.pose(element_.child("pose"));
        std::vector<Pose> result;
        for (const Vec3& offset : offsets()) result.push_back({X_WP * offset, X_WP.q});
        return result;
    }

  private:
    std::vector<Vec3> offsets() {
        const Element distribution = element_.child("distribution");
        const std::string type = distribution.text("type");
        if (type == "grid") return grid(distribution);
        const int count = import_.reader.integer(element_, "model_count", 1);
        if (count < 1 || count > kMost)
            return wrong("<model_count> is " + std::to_string(count), "Write a number from 1 to 1000000.");
        Region region;
        if (!read_region(region)) return {};
        std::vector<Vec3> result;
        FixedRandom random;
        for (int i = 0; i < count; ++i) {
            const double along = static_cast<double>(i) / count - 0.5;
            if (type == "random") {
                const double a = random.next(), b = random.next(), c = random.next();
                result.push_back(region.cylinder ? in_cylinder(region, a, b, c) : in_box(region, a, b, c));
            } else if (type == "uniform") {
                const double a = halton(i, 2), b = halton(i, 3), c = halton(i, 5);
                result.push_back(region.cylinder ? in_cylinder(region, a, b, c) : in_box(region, a, b, c));
            } else if (type == "linear-x" && !region.cylinder) {
                result.push_back({along * region.size.x, 0, 0});
            } else if (type == "linear-y" && !region.cylinder) {
                result.push_back({0, along * region.size.y, 0});
            } else if (type == "linear-z" && !region.cylinder) {
                result.push_back({0, 0, along * region.size.z});
            } else {
                return wrong("a <distribution> of type '" + type + "' in a <" +
                                 (region.cylinder ? "cylinder" : "box") + "> is not known",
                             "Use random or uniform in a box or cylinder, linear-x, linear-y or linear-z in "
                             "a box, or grid.");
            }
        }
        return result;
    }

    std::vector<Vec3> grid(const Element& distribution) {
        const int rows = import_.reader.integer(distribution, "rows", 1);
        const int columns = import_.reader.integer(distribution, "cols", 1);
        const Vec3 step = import_.reader.vector(distribution, "step", {1, 1, 1});
        if (rows < 1 || columns < 1 || static_cast<long long>(rows) * columns > kMost) {
            return wrong(
                "a grid of " + std::to_string(rows) + " rows and " + std::to_string(columns) + " columns",
                "Write <rows> and <cols> of at least 1, at most 1000000 models.");
        }
        std::vector<Vec3> result;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                result.push_back(
                    {step.x * (column - 0.5 * (columns - 1)), step.y * (row - 0.5 * (rows - 1)), 0});
            }
        }
        return result;
    }

    bool read_region(Region& region) {
        if (const Element box = element_.child("box")) {
            region.size = import_.reader.vector(box, "size", {1, 1, 1});
            if (region.size.x >= 0 && region.size.y >= 0 && region.size.z >= 0) return true;
            wrong("the <size> of its <box> is negative", "Write three lengths.");
            return false;
        }
        if (const Element cylinder = element_.child("cylinder")) {
            region.cylinder = true;
            region.radius = import_.reader.number(cylinder, "radius", 1);
            region.length = import_.reader.number(cylinder, "length", 1);
            if (region.radius >= 0 && region.length >= 0) return true;
            wrong("the <radius> or <length> of its <cylinder> is negative", "Write two lengths.");
            return false;
        }
        wrong("it has neither <box> nor <cylinder>", "Add the region that the models shall stand in.");
        return false;
    }

    std::vector<Vec3> wrong(const std::string& what, const std::string& remedy) {
        import_.diagnostics().error(element_.where(), "population",
                                    "<population> '" + element_.name() + "': " + what, remedy);
        return {};
    }

    const Element& element_;
    const Import& import_;
};

}  // namespace

std::vector<Pose> population_poses(const Element& population, const Import& import) {
    return Population(population, import).poses();
}

}  // namespace roboss::sdf_import
