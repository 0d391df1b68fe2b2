// What cameras of all kinds have in common: size of the image, lens, distortion and clip planes.
#pragma once

#include <string>
#include <vector>

#include "core/fixed_math.h"
#include "math/pose.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// The camera looks along x of its frame, y is left, z is up. The centre of pixel (column u, row v) is at
/// (u + 0.5, v + 0.5) of the image plane.
///
/// Pinhole: a point at depth x is seen at u = fx * (-y / x) + s * (-z / x) + cx and v = fy * (-z / x) + cy.
/// Without `<intrinsics>`, fx = fy = width / (2 tan(horizontal_fov / 2)), and the centre is that of the
/// image. Distortion (Brown and Conrady) moves a point (a, b) of the plane at depth 1 to a point at (a, b) (1
/// + k1 r^2 + k2 r^4 + k3 r^6) + (2 p1 a b + p2 (r^2 + 2 a^2), p1 (r^2 + 2 b^2) + 2 p2 a b).
///
/// Wide angle: r = c1 f fun(theta / c2 + c3), theta from the axis, r from the centre in halves of the width.
struct CameraOptics {
    int width = 320,                  ///< pixels
        height = 240;                 ///< pixels
    double horizontal_fov = 1.047;    ///< rad
    double near = 0.1,                ///< m along the axis; nearer nothing is seen
        far = 100;                    ///< m along the axis; farther nothing is seen
    Pose X_SC;                        ///< camera in sensor
    int anti_aliasing = 1;            ///< rays by pixel of a colour image: 1, 2, 4 or 8
    double fx = 0,                    ///< pixels; 0: by horizontal_fov
        fy = 0,                       ///< pixels
        cx = 0,                       ///< pixels
        cy = 0,                       ///< pixels
        skew = 0;                     ///< pixels
    double k1 = 0,                    ///< radial
        k2 = 0,                       ///< radial
        k3 = 0,                       ///< radial
        p1 = 0,                       ///< tangential
        p2 = 0;                       ///< tangential
    std::string lens = "gnomonical";  ///< SDF `<lens><type>`; of wide angle cameras
    bool scale_to_hfov = true;        ///< f such that the horizontal field of view fills the width
    double c1 = 1,                    ///< of a custom lens
        c2 = 1,                       ///< of a custom lens
        c3 = 0,                       ///< of a custom lens, rad
        f = 1;                        ///< of a custom lens; without scale_to_hfov of any
    std::string fun = "tan";          ///< of a custom lens: tan, sin or id
    double cutoff_angle = 0.5 * kPi;  ///< rad from the axis; beyond it all is black
    /// A whole number of 32 bits: a visual is seen if this has a bit in common with its `<visibility_flags>`.
    double visibility_mask = 4294967295;

    /// Whether all lines stay straight.
    bool is_pinhole() const { return lens == "gnomonical"; }
    /// Whether a coefficient of the distortion is not 0.
    bool is_distorted() const { return k1 != 0 || k2 != 0 || k3 != 0 || p1 != 0 || p2 != 0; }

    /// Elements of all cameras that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"save", "", "images are saved by `roboss sense` or a program"},
        {"triggered", "false|0", "a camera renders on request"},
        {"distortion/center", "0.5 0.5", "the centre of distortion is the principal point"},
    };

    /// What a kind of camera states about itself, beside its own number, names and SDF types.
    static constexpr SensorKind kind(std::uint32_t number, const char* name, const char* phrase,
                                     const char* sdf_types) {
        return {.number = number,
                .name = name,
                .phrase = phrase,
                .sdf_types = sdf_types,
                .block = "camera",
                .block_required = true,
                .needs_all_states = true,
                .is_image = true,
                .ignored = kIgnored};
    }

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"width", "image/width"}, s.width);
        visit({"height", "image/height"}, s.height);
        visit({"horizontal_fov", "horizontal_fov", "rad"}, s.horizontal_fov);
        visit({"near", "clip/near", "m"}, s.near);
        visit({"far", "clip/far", "m", true}, s.far);
        visit({"pose", "pose"}, s.X_SC);
        visit({"anti_aliasing", "image/anti_aliasing"}, s.anti_aliasing);
        visit({"fx", "lens/intrinsics/fx"}, s.fx);
        visit({"fy", "lens/intrinsics/fy"}, s.fy);
        visit({"cx", "lens/intrinsics/cx"}, s.cx);
        visit({"cy", "lens/intrinsics/cy"}, s.cy);
        visit({"skew", "lens/intrinsics/s"}, s.skew);
        visit({"k1", "distortion/k1"}, s.k1);
        visit({"k2", "distortion/k2"}, s.k2);
        visit({"k3", "distortion/k3"}, s.k3);
        visit({"p1", "distortion/p1"}, s.p1);
        visit({"p2", "distortion/p2"}, s.p2);
        visit({"lens", "lens/type"}, s.lens);
        visit({"scale_to_hfov", "lens/scale_to_hfov"}, s.scale_to_hfov);
        visit({"c1", "lens/custom_function/c1"}, s.c1);
        visit({"c2", "lens/custom_function/c2"}, s.c2);
        visit({"c3", "lens/custom_function/c3"}, s.c3);
        visit({"f", "lens/custom_function/f"}, s.f);
        visit({"fun", "lens/custom_function/fun"}, s.fun);
        visit({"cutoff_angle", "lens/cutoff_angle"}, s.cutoff_angle);
        visit({.name = "visibility_mask", .element = "visibility_mask", .later = true}, s.visibility_mask);
    }
    /// Compares all members.
    friend bool operator==(const CameraOptics&, const CameraOptics&) = default;

    /// Adds why it cannot see, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        constexpr int kSideMax = 8192;
        if (width < 1 || height < 1 || width > kSideMax || height > kSideMax)
            problems.push_back(
                {"has an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                 "Write <width> and <height> from 1 to " + std::to_string(kSideMax) + "."});
        if (!(visibility_mask >= 0 && visibility_mask <= 4294967295))
            problems.push_back({"has a <visibility_mask> of " + std::to_string(visibility_mask),
                                "Write a whole number from 0 to 4294967295."});
        if (!(near > 0 && far > near))
            problems.push_back(
                {"sees from " + std::to_string(near) + " to " + std::to_string(far) + " m: it sees nothing",
                 "Write <clip> with 0 < <near> < <far>."});
        if (!(horizontal_fov > 0 && horizontal_fov < (is_pinhole() ? kPi : 2 * kPi)))
            problems.push_back({"has a <horizontal_fov> of " + std::to_string(horizontal_fov) + " rad",
                                "Write an angle between 0 and pi, or 2 pi of a wide angle camera."});
        if (fx < 0 || fy < 0 || (fx > 0) != (fy > 0))
            problems.push_back({"has <intrinsics> with an fx of " + std::to_string(fx) + " and an fy of " +
                                    std::to_string(fy) + " pixels",
                                "Write both above 0, or neither."});
        const auto is_one_of = [](const std::string& text, std::initializer_list<const char*> names) {
            for (const char* name : names)
                if (text == name) return true;
            return false;
        };
        if (!is_one_of(lens, {"gnomonical", "stereographic", "equidistant", "equisolid_angle", "orthographic",
                              "custom"}))
            problems.push_back(
                {"has a lens of type '" + lens + "', which is not known",
                 "Use gnomonical, stereographic, equidistant, equisolid_angle, orthographic or "
                 "custom."});
        if (!is_one_of(fun, {"tan", "sin", "id"}) || c1 == 0 || c2 == 0 || f == 0)
            problems.push_back({"has a <custom_function> that cannot be inverted",
                                "Write tan, sin or id as <fun>, and c1, c2 and f other than 0."});
    }
};

}  // namespace roboss
