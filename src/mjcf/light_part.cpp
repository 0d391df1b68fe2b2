// Lights of viewers.
#include "mjcf/orientation.h"
#include "mjcf/tree.h"

namespace roboss::mjcf {

LightSpec read_light(const Attributes& light, const Scope& scope) {
    LightSpec spec;
    spec.name = scope.names.full(light.name());
    spec.X_FL = scope.X_BF * Pose{light.vector("pos", {}), {}};
    const std::string type = light.text("type", light.boolean("directional", false) ? "directional" : "spot");
    spec.kind = type == "directional" ? LightKind::kDirectional
                : type == "point"     ? LightKind::kPoint
                                      : LightKind::kSpot;
    const Vec3 direction = light.vector("dir", {0, 0, -1});
    spec.direction = norm(direction) > 0 ? direction / norm(direction) : Vec3{0, 0, -1};
    spec.diffuse = light.vector("diffuse", {0.7, 0.7, 0.7});
    spec.specular = light.vector("specular", {0.3, 0.3, 0.3});
    const Vec3 attenuation = light.vector("attenuation", {1, 0, 0});
    spec.constant = attenuation.x, spec.linear = attenuation.y, spec.quadratic = attenuation.z;
    spec.range = light.number("range", 10);
    const double cutoff = light.number("cutoff", 45) * kPi / 180.0;
    spec.inner_angle = cutoff, spec.outer_angle = 2 * cutoff;
    spec.cast_shadows = light.boolean("castshadow", true);
    return spec;
}

}  // namespace roboss::mjcf
