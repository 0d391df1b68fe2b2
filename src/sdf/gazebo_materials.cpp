// The materials that Gazebo brings along, with the colours of its gazebo.material (gazebo-classic,
// Apache 2.0, media/materials/scripts/gazebo.material). Where Gazebo lays a picture over a material, the
// table has a colour like that of the picture, since the picture is not part of RoBOSS.
#include "sdf/ogre_materials.h"

namespace roboss::sdf_import {
namespace {

struct Row {
    const char* name;
    Vec3 diffuse;
    std::optional<Vec3> emissive{};
    double alpha = 1;
    double shine = 0.1;  // of the highlights, grey
};

const Vec3 kAsphalt{0.30, 0.30, 0.31}, kPaving{0.62, 0.60, 0.57};
const std::optional<Vec3> kDark;

const Row kRows[] = {
    {"Grey", {0.7, 0.7, 0.7}, kDark, 1, 0.01},
    {"Gray", {0.7, 0.7, 0.7}, kDark, 1, 0.01},
    {"DarkGrey", {0.175, 0.175, 0.175}, kDark, 1, 0.175},
    {"DarkGray", {0.175, 0.175, 0.175}, kDark, 1, 0.175},
    {"White", {1, 1, 1}},
    {"FlatBlack", {0.1, 0.1, 0.1}, kDark, 1, 0.01},
    {"Black", {0, 0, 0}},
    {"Red", {1, 0, 0}},
    {"RedBright", {0.87, 0.26, 0.07}, kDark, 1, 0.4},
    {"Green", {0, 1, 0}},
    {"Blue", {0, 0, 1}},
    {"SkyBlue", {0.13, 0.44, 0.70}},
    {"Yellow", {1, 1, 0}, kDark, 1, 0},
    {"ZincYellow", {0.9725, 0.9529, 0.2078}, kDark, 1, 0.9},
    {"DarkYellow", {0.7, 0.7, 0}, kDark, 1, 0},
    {"Purple", {1, 0, 1}},
    {"Turquoise", {0, 1, 1}},
    {"Indigo", {0.33, 0, 0.5}},
    {"Orange", {1, 0.5088, 0.0468}, kDark, 1, 0.5},
    {"Gold", {0.8, 0.64869, 0.120759}, kDark, 1, 0.4},
    {"WhiteGlow", {1, 1, 1}, Vec3{1, 1, 1}},
    {"RedGlow", {1, 0, 0}, Vec3{1, 0, 0}},
    {"GreenGlow", {0, 1, 0}, Vec3{0, 1, 0}},
    {"BlueGlow", {0, 0, 1}, Vec3{0, 0, 1}},
    {"YellowGlow", {1, 1, 0}, Vec3{1, 1, 0}},
    {"PurpleGlow", {1, 0, 1}, Vec3{1, 0, 1}},
    {"TurquoiseGlow", {0, 1, 1}, Vec3{0, 1, 1}},
    {"TurquoiseGlowOutline", {0, 1, 1}, Vec3{0, 1, 1}},
    {"LightOn", {0, 1, 0}, Vec3{0, 1, 0}},
    {"LightOff", {1, 0, 0}, Vec3{1, 0, 0}},
    {"JointAnchor", {1, 1, 1}, Vec3{1, 1, 1}, 1, 1},
    {"RedTransparentOverlay", {1, 0, 0}, kDark, 0.5},
    {"GreenTransparentOverlay", {0, 1, 0}, kDark, 0.5},
    {"BlueTransparentOverlay", {0, 0, 1}, kDark, 0.5},
    {"RedTransparent", {1, 0, 0}, kDark, 0.5},
    {"GreenTransparent", {0, 1, 0}, kDark, 0.5},
    {"BlueTransparent", {0, 0, 1}, kDark, 0.5},
    {"DarkMagentaTransparent", {0.6, 0, 0.6}, kDark, 0.5},
    {"GreyTransparent", {0.5, 0.5, 0.5}, kDark, 0.5},
    {"BlackTransparent", {0, 0, 0}, kDark, 0.5},
    {"YellowTransparent", {1, 1, 0}, kDark, 0.5},
    {"OrangeTransparent", {1, 0.44, 0}, kDark, 0.4},
    {"BlueLaser", {0, 0, 1}, kDark, 0.4},
    {"PioneerBody", {1, 0, 0}, kDark, 1, 0.5},
    {"Pioneer2Body", {0.681193, 0.000923, 0.000923}, kDark, 1, 0.5},
    // From here on Gazebo lays pictures over them.
    {"Wood", {0.60, 0.42, 0.25}, kDark, 1, 0.2},
    {"WoodFloor", {0.55, 0.36, 0.20}},
    {"WoodPallet", {0.65, 0.50, 0.33}, kDark, 1, 0},
    {"Bricks", {0.55, 0.30, 0.24}, kDark, 1, 0.2},
    {"CeilingTiled", {0.85, 0.85, 0.82}},
    {"PaintedWall", {0.88, 0.86, 0.80}},
    {"WindowFrame", {0.75, 0.75, 0.75}, kDark, 1, 0.2},
    {"GreyGradientSky", {0.75, 0.75, 0.78}},
    {"CloudySky", {0.55, 0.70, 0.90}},
    {"Road", kAsphalt},
    {"Residential", kAsphalt},
    {"Tertiary", kAsphalt},
    {"Motorway", kAsphalt},
    {"Trunk", kAsphalt},
    {"Primary", kAsphalt},
    {"Secondary", kAsphalt},
    {"Lane_1", kAsphalt},
    {"Lanes_2", kAsphalt},
    {"Lanes_4", kAsphalt},
    {"Lanes_6", kAsphalt},
    {"Pedestrian", kPaving},
    {"Footway", kPaving},
    {"Steps", kPaving},
};

OgreMaterials table() {
    OgreMaterials all;
    for (const Row& row : kRows) {
        OgreMaterial material;
        material.diffuse = row.diffuse;
        material.emissive = row.emissive;
        material.specular = Vec3{row.shine, row.shine, row.shine};
        material.alpha = row.alpha;
        all.emplace(std::string("Gazebo/") + row.name, material);
    }
    return all;
}

}  // namespace

const OgreMaterial* gazebo_material(const std::string& name) {
    static const OgreMaterials kAll = table();
    const auto found = kAll.find(name);
    return found == kAll.end() ? nullptr : &found->second;
}

}  // namespace roboss::sdf_import
