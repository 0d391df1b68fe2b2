// See onboard_kinds/multicopter_control.h. Mass and inertia are those of the whole robot as it stands.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/noise.h"
#include "onboard/controllers.h"

namespace roboss {
namespace {

Vec3 by_component(const Vec3& a, const Vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

Vec3 limited(Vec3 v, const Vec3& most) {
    for (std::size_t i = 0; i < 3; ++i) v[i] = std::clamp(v[i], -std::fabs(most[i]), std::fabs(most[i]));
    return v;
}

Vec3 unit(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? v * (1 / length) : Vec3{};
}

Vec3 column(const Mat3& R, std::size_t i) {
    return {R.r0[i], R.r1[i], R.r2[i]};
}

/// Solves the symmetric or general system A x = b of N rows by elimination with pivots; false: it is
/// singular.
template <std::size_t N>
bool solve(std::array<std::array<double, N>, N> A, std::array<double, N>& b) {
    constexpr double kSingular = 1e-18;
    for (std::size_t k = 0; k < N; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < N; ++i)
            if (std::fabs(A[i][k]) > std::fabs(A[pivot][k])) pivot = i;
        if (!(std::fabs(A[pivot][k]) > kSingular)) return false;
        std::swap(A[k], A[pivot]), std::swap(b[k], b[pivot]);
        for (std::size_t i = k + 1; i < N; ++i) {
            const double factor = A[i][k] / A[k][k];
            for (std::size_t j = k; j < N; ++j) A[i][j] -= factor * A[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = N; k-- > 0;) {
        for (std::size_t j = k + 1; j < N; ++j) b[k] -= A[k][j] * b[j];
        b[k] /= A[k][k];
    }
    return true;
}

struct WholeMass {
    double mass = 0;
    Vec3 centre;     // m, world
    Mat3 inertia{};  // about the centre, axes of the controlled link
};

WholeMass whole_mass(const Mat3& R_WL, OnboardContext& c) {
    WholeMass whole;
    const std::vector<Link>& links = c.type_of_file().links;  // it knows no payload
    for (std::size_t l = 0; l < links.size(); ++l) {
        whole.mass += links[l].mass;
        whole.centre += c.centre_of_file(LinkId(l)) * links[l].mass;
    }
    whole.centre = whole.centre * (1 / whole.mass);
    for (std::size_t l = 0; l < links.size(); ++l) {
        const Link& link = links[l];
        const Mat3 R_LB = transpose(R_WL) * (c.pose(LinkId(l)).R * transpose(link.X_BL.R));
        const Vec3 r = transpose_times(R_WL, c.centre_of_file(LinkId(l)) - whole.centre);
        const double rr = dot(r, r) * link.mass;
        whole.inertia = whole.inertia + R_LB * link.inertia_C * transpose(R_LB);
        const Vec3 m = r * link.mass;
        whole.inertia = whole.inertia + Mat3{{rr - m.x * r.x, -m.x * r.y, -m.x * r.z},
                                             {-m.y * r.x, rr - m.y * r.y, -m.y * r.z},
                                             {-m.z * r.x, -m.z * r.y, rr - m.z * r.z}};
    }
    return whole;
}

/// Vec3 of Gaussian noise; `first`: its number among those of this tick.
Vec3 noise(const Vec3& mean, const Vec3& deviation, std::uint64_t first, OnboardContext& c) {
    constexpr std::uint64_t kSeed = 0x6d756c7469636f70;  // of this kind: runs are alike
    const NoiseStream stream{kSeed, c.robot().value, 0, c.tick()};
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i)
        if (deviation[i] > 0) sum[i] = mean[i] + deviation[i] * random_gaussian(stream, first + i);
    return sum;
}

/// Torque over inertia, rad/s^2, and thrust, N, that the law asks for.
struct Wanted {
    Vec3 torque;
    double thrust = 0;
};

/// The attitude in which the thrust points along b3, with the heading of R.
Mat3 attitude_to(const Vec3& b3, const Mat3& R) {
    constexpr double kParallel = 1e-3;
    Vec3 b1 = column(R, 0);
    for (std::size_t i = 1; i < 3 && norm_squared(cross(b1, b3)) < kParallel; ++i) b1 = column(R, i);
    const Vec3 b2 = unit(cross(b3, b1)), x = cross(b2, b3);
    return transpose(Mat3{x, b2, b3});
}

bool control(const MulticopterControlSpec& spec, const WholeMass& whole, OnboardContext& c, Wanted& wanted) {
    const Mat3 R = c.pose(c.link(0)).R;
    const LinkTwist twist = c.twist(c.link(0));
    const std::span<const double> given = c.command(0);
    const Vec3 velocity = limited({given[0], given[1], given[2]}, spec.max_velocity);
    const Vec3 rates = limited({given[3], given[4], given[5]}, spec.max_turn_rate);
    const Vec3 v = twist.linear + noise(spec.velocity_noise_mean, spec.velocity_noise_deviation, 0, c);
    const Vec3 w = transpose_times(R, twist.angular) +
                   noise(spec.turn_rate_noise_mean, spec.turn_rate_noise_deviation, 8, c);
    Vec3 a = by_component(v - R * velocity, spec.velocity_gain) * (1 / whole.mass);
    a = limited(a, spec.max_acceleration) + c.gravity();
    const Vec3 b3 = unit(-a);
    const Mat3 Rd = attitude_to(b3, R);
    const Mat3 E = transpose(Rd) * R, skew = (E - transpose(E)) * 0.5;
    const Vec3 attitude_error{skew.r2.y, skew.r0.z, skew.r1.x};
    const Vec3 rate_error = w - transpose_times(R, Rd * Vec3{0, 0, rates.z});
    // Gazebo's gains are divided by the inertia and multiplied by it again.
    std::array<std::array<double, 3>, 3> I{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) I[i][j] = whole.inertia(i, j);
    std::array<double, 3> kR{spec.attitude_gain.x, spec.attitude_gain.y, spec.attitude_gain.z};
    std::array<double, 3> kw{spec.angular_rate_gain.x, spec.angular_rate_gain.y, spec.angular_rate_gain.z};
    if (!solve(I, kR) || !solve(I, kw)) return false;
    const Vec3 turning = by_component(attitude_error, {kR[0], kR[1], kR[2]}) * -1.0 -
                         by_component(rate_error, {kw[0], kw[1], kw[2]});
    wanted.torque = whole.inertia * turning;
    wanted.thrust = -whole.mass * dot(a, column(R, 2));
    return true;
}

/// Squares of the rotors' angular velocities that give torque and thrust; false: the rotors cannot.
bool allocate(const MulticopterControlSpec& spec, const WholeMass& whole, const Wanted& wanted,
              OnboardContext& c, std::span<double> squares) {
    constexpr std::size_t kMost = 64;
    std::array<std::array<double, 4>, kMost> columns{};
    const Mat3 R = c.pose(c.link(0)).R;
    std::array<std::array<double, 4>, 4> AA{};
    for (std::size_t i = 0; i < spec.rotors.size(); ++i) {
        const AxisPlace axis = c.axis(i);
        const Vec3 arm = transpose_times(R, axis.origin - whole.centre);
        const double k = spec.rotors[i].force_constant * dot(axis.direction, column(R, 2));
        columns[i] = {arm.y * k, -arm.x * k, -spec.rotors[i].direction * k * spec.rotors[i].moment_constant,
                      k};
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < 4; ++b) AA[a][b] += columns[i][a] * columns[i][b];
    }
    std::array<double, 4> x{wanted.torque.x, wanted.torque.y, wanted.torque.z, wanted.thrust};
    if (!solve(AA, x)) return false;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        double sum = 0;
        for (std::size_t a = 0; a < 4; ++a) sum += columns[i][a] * x[a];
        squares[i] = std::max(sum, 0.0);
    }
    return true;
}

/// The motors of the robot, by the channel that they share.
void command_motors(std::span<const double> speeds, OnboardContext& c) {
    for (const OnboardInfo& info : c.type().onboard) {
        if (!std::holds_alternative<MotorModelSpec>(info.spec.parameters)) continue;
        const ChannelInfo& channel = c.type().channels[static_cast<std::size_t>(info.channels[0])];
        c.state().onboard[static_cast<std::size_t>(channel.index)] = static_cast<double>(c.tick());
        c.state().lists[static_cast<std::size_t>(channel.list_index)].assign(speeds.begin(), speeds.end());
    }
}

}  // namespace

void run(const MulticopterControlSpec& spec, OnboardContext& c) {
    std::array<double, 64> speeds{};
    const std::span<double> rotors = std::span(speeds).first(spec.rotors.size());
    double& off = c.memory()[0];
    if (c.is_commanded(1) && c.command(1)[0] == 0) off = static_cast<double>(c.tick());
    if (c.is_commanded(0) && static_cast<double>(c.commanded_at(0)) > off) {
        const WholeMass whole = whole_mass(c.pose(c.link(0)).R, c);
        Wanted wanted;
        if (!control(spec, whole, c, wanted) || !allocate(spec, whole, wanted, c, rotors)) return;
        for (double& x : rotors) x = std::sqrt(x);
    }
    command_motors(rotors, c);
}

}  // namespace roboss
