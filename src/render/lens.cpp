// See lens.h.
#include "render/lens.h"

#include <cmath>

namespace roboss::render {
namespace {

double tan_of(double angle) {
    const SinCos both = fixed_sincos(angle);
    return both.sin / both.cos;
}

}  // namespace

Lens::Lens(const CameraOptics& optics) : optics_(optics), cx_(0.5 * optics.width), cy_(0.5 * optics.height) {
    // A wide angle lens has no focal length of this kind beyond half a turn; then that of 90 degrees.
    const double fov = optics.horizontal_fov < 0.99 * kPi ? optics.horizontal_fov : 0.5 * kPi;
    fx_ = fy_ = 0.5 * optics.width / tan_of(0.5 * fov);
    if (optics.fx > 0) fx_ = optics.fx, fy_ = optics.fy, cx_ = optics.cx, cy_ = optics.cy;
    const std::string& lens = optics.lens;
    f_ = lens == "custom" || !optics.scale_to_hfov ? optics.f : 1;
    if (lens == "stereographic") c1_ = 2, c2_ = 2;
    if (lens == "equidistant") fun_ = 'i';
    if (lens == "equisolid_angle") c1_ = 2, c2_ = 2, fun_ = 's';
    if (lens == "orthographic") fun_ = 's';
    if (lens == "custom") {
        c1_ = optics.c1, c2_ = optics.c2, c3_ = optics.c3;
        fun_ = optics.fun == "tan" ? 't' : optics.fun == "sin" ? 's' : 'i';
    }
    if (optics.is_pinhole() || !optics.scale_to_hfov) return;
    const double edge = 0.5 * optics.horizontal_fov / c2_ + c3_;
    f_ = 1 / (c1_ * (fun_ == 't' ? tan_of(edge) : fun_ == 's' ? fixed_sin(edge) : edge));
}

std::pair<double, double> Lens::distorted(double a, double b) const {
    const CameraOptics& o = optics_;
    const double rr = a * a + b * b, radial = 1 + rr * (o.k1 + rr * (o.k2 + rr * o.k3));
    return {a * radial + 2 * o.p1 * a * b + o.p2 * (rr + 2 * a * a),
            b * radial + o.p1 * (rr + 2 * b * b) + 2 * o.p2 * a * b};
}

std::optional<std::pair<double, double>> Lens::undistorted(double a, double b) const {
    if (!optics_.is_distorted()) return std::pair(a, b);
    const CameraOptics& o = optics_;
    constexpr int kSteps = 30;
    double x = a, y = b;
    for (int i = 0; i < kSteps; ++i) {
        const std::pair<double, double> at = distorted(x, y);
        const double ex = at.first - a, ey = at.second - b;
        if (ex == 0 && ey == 0) break;
        const double rr = x * x + y * y, radial = 1 + rr * (o.k1 + rr * (o.k2 + rr * o.k3));
        const double slope = 2 * (o.k1 + rr * (2 * o.k2 + rr * 3 * o.k3));  // d radial / d(r^2), twice
        const double xx = radial + x * x * slope + 2 * o.p1 * y + 6 * o.p2 * x;
        const double xy = x * y * slope + 2 * o.p1 * x + 2 * o.p2 * y;
        const double yy = radial + y * y * slope + 6 * o.p1 * y + 2 * o.p2 * x;
        const double det = xx * yy - xy * xy;
        if (!(std::fabs(det) > 1e-12)) return std::nullopt;  // folded: the image shows nothing there
        x -= (yy * ex - xy * ey) / det;
        y -= (xx * ey - xy * ex) / det;
    }
    const std::pair<double, double> at = distorted(x, y);
    if (!(std::fabs(at.first - a) + std::fabs(at.second - b) < 1e-9)) return std::nullopt;
    return std::pair(x, y);
}

std::optional<Vec3> Lens::direction(double u, double v) const {
    if (!optics_.is_pinhole()) return wide(u, v);
    const double b = (v - cy_) / fy_, a = (u - cx_ - optics_.skew * b) / fx_;
    const auto plane = undistorted(a, b);
    if (!plane) return std::nullopt;
    return Vec3{1, -plane->first, -plane->second};
}

std::optional<Vec3> Lens::wide(double u, double v) const {
    const double scale = 2.0 / optics_.width;
    const double right = (u - 0.5 * optics_.width) * scale, down = (v - 0.5 * optics_.height) * scale;
    const double r = std::sqrt(right * right + down * down), y = r / (c1_ * f_);
    if (fun_ == 's' && !(std::fabs(y) <= 1)) return std::nullopt;
    const double inner = fun_ == 't' ? fixed_atan2(y, 1) : fun_ == 's' ? fixed_asin(y) : y;
    const double theta = c2_ * (inner - c3_);
    if (!(theta >= 0 && theta <= optics_.cutoff_angle && theta <= kPi)) return std::nullopt;
    const SinCos turn = fixed_sincos(theta);
    if (r < 1e-12) return Vec3{1, 0, 0};
    return Vec3{turn.cos, -turn.sin * right / r, -turn.sin * down / r};
}

std::optional<std::pair<double, double>> Lens::project(const Vec3& p) const {
    if (!(p.x > 0)) return std::nullopt;
    const std::pair<double, double> at = distorted(-p.y / p.x, -p.z / p.x);
    return std::pair(fx_ * at.first + optics_.skew * at.second + cx_, fy_ * at.second + cy_);
}

}  // namespace roboss::render
