// The steady turn of a skid-steer car whose wheels keep their speeds: planar rigid-body balance with Coulomb
// friction at each contact point, loads from the balance of roll and pitch (they are linear in the place of a
// point, as on equal stiff springs), centrifugal force and the wheels' gyroscopic moment included. Newton's
// method on (forward, sideways, yaw rate); the closed form is what is solved, no simulation.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace roboss::test {

struct SkidCar {
    struct Point {
        double x = 0, y = 0;       // from the centre of mass, m
        double surface_speed = 0;  // of the wheel at the ground: its rate times its radius, m/s
    };
    std::vector<Point> points;
    double mass = 0, height = 0, mu = 0, gravity = 9.81;
    double wheel_spin = 0;  // angular momentum of all wheels about their axles, kg m^2/s
};

struct SkidTurn {
    double forward = 0, sideways = 0, yaw_rate = 0;
    double residual = 0;  // N, N m
};

namespace detail {

/// Gauss with pivots; the sizes are tiny.
template <std::size_t N>
std::array<double, N> solve_small(std::array<std::array<double, N>, N> a, std::array<double, N> b) {
    for (std::size_t k = 0; k < N; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < N; ++i)
            if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
        std::swap(a[k], a[pivot]);
        std::swap(b[k], b[pivot]);
        for (std::size_t i = k + 1; i < N; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < N; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = N; k-- > 0;) {
        for (std::size_t j = k + 1; j < N; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

/// What is missing to balance: forward and sideways force, yaw moment.
inline std::array<double, 3> skid_imbalance(const SkidCar& car, const std::array<double, 3>& motion) {
    const auto [vx, vy, w] = motion;
    // Per unit of load: friction (fx, fy). Loads N = a + b x + c y carry weight, roll and pitch.
    std::array<std::array<double, 3>, 3> balance{};
    std::vector<std::array<double, 2>> friction;
    for (const SkidCar::Point& p : car.points) {
        const double sx = vx - w * p.y - p.surface_speed, sy = vy + w * p.x, s = std::hypot(sx, sy);
        friction.push_back({-car.mu * sx / s, -car.mu * sy / s});
        const auto [fx, fy] = friction.back();
        const std::array<double, 3> shape{1, p.x, p.y};
        for (std::size_t k = 0; k < 3; ++k) {
            balance[0][k] += shape[k];
            balance[1][k] += shape[k] * (p.y + car.height * fy);
            balance[2][k] += shape[k] * (-p.x - car.height * fx);
        }
    }
    const auto [a, b, c] = solve_small<3>(balance, {car.mass * car.gravity, -w * car.wheel_spin, 0});
    std::array<double, 3> missing{car.mass * w * vy, -car.mass * w * vx, 0};
    for (std::size_t i = 0; i < car.points.size(); ++i) {
        const SkidCar::Point& p = car.points[i];
        const double load = a + b * p.x + c * p.y;
        missing[0] += load * friction[i][0];
        missing[1] += load * friction[i][1];
        missing[2] += load * (p.x * friction[i][1] - p.y * friction[i][0]);
    }
    return missing;
}

}  // namespace detail

inline SkidTurn skid_turn(const SkidCar& car) {
    std::array<double, 3> motion{0, 1e-3, 0.1};
    for (const SkidCar::Point& p : car.points)
        motion[0] += p.surface_speed / static_cast<double>(car.points.size());
    std::array<double, 3> missing{};
    for (int iteration = 0; iteration < 200; ++iteration) {
        missing = detail::skid_imbalance(car, motion);
        std::array<std::array<double, 3>, 3> slope{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> moved = motion;
            moved[k] += 1e-7;
            const std::array<double, 3> there = detail::skid_imbalance(car, moved);
            for (std::size_t i = 0; i < 3; ++i) slope[i][k] = (there[i] - missing[i]) / 1e-7;
        }
        const std::array<double, 3> step = detail::solve_small<3>(slope, missing);
        for (std::size_t k = 0; k < 3; ++k) motion[k] -= (iteration < 100 ? 0.2 : 1.0) * step[k];
    }
    const double residual = std::fabs(missing[0]) + std::fabs(missing[1]) + std::fabs(missing[2]);
    return {motion[0], motion[1], motion[2], residual};
}

}  // namespace roboss::test
