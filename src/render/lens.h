// Lens: which ray each point of the image stands for, and where a point of space is seen.
#pragma once

#include <optional>

#include "math/vec3.h"
#include "sensor_kinds/camera_optics.h"

namespace roboss::render {

/// The formulas are those of CameraOptics.
class Lens {
  public:
    explicit Lens(const CameraOptics& optics);

    /// Direction in the camera's frame (x ahead, y left, z up) of the ray at (u, v) of the image; of a
    /// pinhole camera with x = 1, else a unit vector. None: the image shows nothing there.
    std::optional<Vec3> direction(double u, double v) const;
    /// Where a point of the camera's frame is seen; none: not at all. Of pinhole cameras, with distortion.
    std::optional<std::pair<double, double>> project(const Vec3& p_C) const;
    /// Numbers of pixels: fx, fy, cx, cy.
    double fx() const { return fx_; }
    double fy() const { return fy_; }
    double cx() const { return cx_; }
    double cy() const { return cy_; }

  private:
    std::optional<Vec3> wide(double u, double v) const;
    std::pair<double, double> distorted(double a, double b) const;
    /// The point of the plane at depth 1 that is seen at (a, b), by Newton's method.
    std::optional<std::pair<double, double>> undistorted(double a, double b) const;

    CameraOptics optics_;
    double fx_ = 0, fy_ = 0, cx_ = 0, cy_ = 0;
    double c1_ = 1, c2_ = 1, c3_ = 0, f_ = 1;  // of wide angle lenses
    char fun_ = 't';                           // tan, sin, id
};

}  // namespace roboss::render
