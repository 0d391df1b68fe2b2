// See standard_models.h.
#include "sdf/standard_models.h"

#include <algorithm>
#include <cctype>

#include "sdf/fuel_cache.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kSun = R"(<sdf version="1.6">
  <light type="directional" name="sun">
    <cast_shadows>true</cast_shadows>
    <pose>0 0 10 0 0 0</pose>
    <diffuse>0.8 0.8 0.8 1</diffuse>
    <specular>0.2 0.2 0.2 1</specular>
    <attenuation><range>1000</range><constant>0.9</constant><linear>0.01</linear><quadratic>0.001</quadratic></attenuation>
    <direction>-0.5 0.1 -0.9</direction>
  </light>
</sdf>
)";

// Its friction counts only where the other surface has more: of two surfaces the smaller coefficient holds.
constexpr const char* kGroundPlane = R"(<sdf version="1.6">
  <model name="ground_plane">
    <static>true</static>
    <link name="link">
      <collision name="collision">
        <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
        <surface><friction><ode><mu>100</mu><mu2>100</mu2></ode></friction></surface>
      </collision>
      <visual name="visual">
        <cast_shadows>false</cast_shadows>
        <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
        <material><ambient>0.8 0.8 0.8 1</ambient><diffuse>0.8 0.8 0.8 1</diffuse></material>
      </visual>
    </link>
  </model>
</sdf>
)";

/// "Ground Plane" as ground_plane.
std::string in_model_style(std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) {
        return c == ' ' ? '_' : static_cast<char>(std::tolower(c));
    });
    return name;
}

/// The model that a URI names; empty: it names none, or a file in one.
std::string name_in(const std::string& uri) {
    const std::string scheme = "model://";
    if (uri.compare(0, scheme.size(), scheme) == 0) {
        const std::size_t first = uri.find_first_not_of('/', scheme.size());
        if (first == std::string::npos) return {};
        const std::size_t last = uri.find_last_not_of('/');
        return uri.substr(first, last + 1 - first);
    }
    const auto fuel = FuelUri::parse(uri);
    if (!fuel || in_model_style(fuel->owner) != "openrobotics" || !fuel->file.empty()) return {};
    return in_model_style(fuel->name);
}

}  // namespace

std::optional<StandardModel> standard_model(const std::string& uri) {
    const std::string name = name_in(uri);
    if (name == "sun") return StandardModel{"built-in model sun", kSun};
    if (name == "ground_plane") return StandardModel{"built-in model ground_plane", kGroundPlane};
    return std::nullopt;
}

}  // namespace roboss::sdf_import
