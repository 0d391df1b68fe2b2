// The bodies of an MJCF file as plain data: what <worldbody> says, with classes, frames and copies resolved
// and in SI units. No robots yet: robots.h makes them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mjcf/assets.h"
#include "mjcf/mass.h"
#include "world/world.h"

namespace roboss::mjcf {

enum class JointMotion { kFree, kBall, kSlide, kHinge };

struct JointPart {
    std::string name;
    JointMotion motion = JointMotion::kHinge;
    Vec3 pos;                 ///< m, in the body
    double ref = 0;           ///< coordinate where the body stands as the file places it, rad or m
    AxisSpec axis;            ///< numbers of a hinge or slide; its direction in the body
    double ball_damping = 0,  ///< N m s/rad
        ball_armature = 0;    ///< kg m^2
    SourceLocation where;
};

struct GeomPart {
    std::string name;
    GeometrySpec shape;
    Pose X_BG;                     ///< shape in the body
    bool has_shape = true;         ///< false: the file behind it cannot be read
    std::optional<GeomMass> mass;  ///< none: it has no volume
    unsigned contype = 1, conaffinity = 1;
    bool in_pair = false;  ///< a <pair> names it
    SurfaceSpec surface;
    int group = 0;
    Vec3 rgb{0.5, 0.5, 0.5};
    double alpha = 1;
    SourceLocation where;

    bool collides() const { return contype != 0 || conaffinity != 0 || in_pair; }
};

struct SitePart {
    std::string name;
    Pose X_BS;
};

struct BodyPart {
    std::string name;
    bool has_name = true;           ///< false: the file gives it none
    std::string copy;               ///< what the <replicate>s around it add to names
    std::size_t parent = 0;         ///< in Tree::bodies
    Pose X_PB;                      ///< in the parent body
    std::vector<JointPart> joints;  ///< the first one moves all others
    std::vector<GeomPart> geoms;
    std::vector<SitePart> sites;
    std::vector<LightSpec> lights;
    std::optional<Mass> inertial;  ///< what <inertial> says
    bool mocap = false;
    bool gravity = true;
    SourceLocation where;
};

/// Parents come before children, in the order in which MuJoCo numbers them; body 0 is the world.
struct Tree {
    std::vector<BodyPart> bodies;

    /// nullptr: no body of that name.
    const BodyPart* find_body(const std::string& name) const;
    /// (body, joint) of a joint by name; nullopt: none.
    struct JointPlace {
        std::size_t body = 0, joint = 0;
    };
    std::optional<JointPlace> find_joint(const std::string& name) const;
    GeomPart* find_geom(const std::string& name);
    /// (body, site) of a site by name.
    struct SitePlace {
        std::size_t body = 0, site = 0;
    };
    std::optional<SitePlace> find_site(const std::string& name) const;
    std::size_t index_of(const BodyPart& body) const {
        return static_cast<std::size_t>(&body - bodies.data());
    }
};

/// What reading a part needs.
struct Reading {
    const Document& document;
    const Defaults& defaults;
    const Settings& settings;
    Assets& assets;
    bool looks = true;
    Diagnostics& diagnostics;
    /// Of names that the file does not have: a warning where elements are left out that would make bodies.
    Severity unknown = Severity::kError;

    void report_unknown(const SourceLocation& where, const char* code, const std::string& message,
                        const std::string& remedy) const {
        diagnostics.add({unknown, where, code, message, remedy});
    }
};

/// Where elements stand: in a body, within frames and copies.
struct Scope {
    std::string childclass;  ///< of the nearest body or frame around that names one
    std::string suffix;      ///< behind names, of a copy
    Pose X_BF;               ///< of the frame that they are in, in its body
    bool masses = true;      ///< the body's mass follows from its geoms
};

Tree read_tree(const Reading& reading);

JointPart read_joint(const Attributes& joint, const Scope& scope, const Reading& reading);
GeomPart read_geom(const Attributes& geom, const Scope& scope, const Reading& reading);
LightSpec read_light(const Attributes& light, const Scope& scope);
/// <inertial> in a body.
Mass read_inertial(const Attributes& inertial, const Scope& scope, const Reading& reading);

}  // namespace roboss::mjcf
