// The bodies of an MJCF file as plain data: what <worldbody> says, with classes, frames and copies resolved
// and in SI units. No robots yet: robots.h makes them.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mjcf/assets.h"
#include "mjcf/mass.h"
#include "world/world.h"

namespace roboss::mjcf {

class SubModels;

/// What names of a file become in the tree: those of a copy (<replicate>) have a suffix, those of an attached
/// file (<attach>) a prefix.
struct Names {
    std::string prefix, suffix;

    std::string full(const std::string& name) const {
        return name.empty() || name == "world" ? name : prefix + name + suffix;
    }
    bool empty() const { return prefix.empty() && suffix.empty(); }
};

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
    bool has_name = true;                ///< false: the file gives it none
    Names copy;                          ///< what the <replicate>s and <attach>es around it add to names
    const Settings* settings = nullptr;  ///< of the file that it stands in
    std::size_t parent = 0;              ///< in Tree::bodies
    Pose X_PB;                           ///< in the parent body
    std::vector<JointPart> joints;       ///< the first one moves all others
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
    /// Lets the functions above find what `bodies` holds now.
    void index();
    std::size_t index_of(const BodyPart& body) const {
        return static_cast<std::size_t>(&body - bodies.data());
    }

    /// Names in the main file of which <replicate> makes others.
    std::set<std::string> copied_names;

  private:
    std::map<std::string, std::size_t> body_index_;
    std::map<std::string, JointPlace> joint_index_;
    std::map<std::string, SitePlace> site_index_;
    std::map<std::string, std::pair<std::size_t, std::size_t>> geom_index_;
};

/// What reading a part of the tree needs: the file that it stands in, and what its names become.
struct Reading {
    const Document& document;
    const Defaults& defaults;
    const Settings& settings;
    Assets& assets;
    SubModels& sub_models;
    bool looks = true;
    Diagnostics& diagnostics;
    /// Of names that the file does not have: a warning where elements are left out that would make bodies.
    Severity unknown = Severity::kError;
    Names names;
    /// Of a copy or an attached file: what refers to parts that are not in it is left out, as in MuJoCo.
    bool is_copy = false;
    bool quiet = false;            ///< another part of the same file tells what has no effect
    std::set<std::string> copied;  ///< Tree::copied_names

    /// Of what has no effect.
    void warn(const SourceLocation& where, const char* code, const std::string& message,
              const std::string& remedy) const {
        if (!quiet) diagnostics.warning(where, code, message, remedy);
    }

    /// `names_given`: those that an element gives, as they stand in the file.
    void report_unknown(const SourceLocation& where, std::initializer_list<std::string> names_given,
                        const char* code, const std::string& message, const std::string& remedy) const {
        if (is_copy) return;
        for (const std::string& name : names_given)
            if (copied.count(name) > 0) return;  // elements of the copies
        diagnostics.add({unknown, where, code, message, remedy});
    }
};

/// Where elements stand: in a body, within frames and copies.
struct Scope {
    std::string childclass;  ///< of the nearest body or frame around that names one
    Names names;
    Pose X_BF;           ///< of the frame that they are in, in its body
    bool masses = true;  ///< the body's mass follows from its geoms
};

/// `parts`: the main file, then each copy of a part of it and each attached file.
Tree read_tree(const Reading& reading, std::vector<Reading>& parts);

JointPart read_joint(const Attributes& joint, const Scope& scope, const Reading& reading);
GeomPart read_geom(const Attributes& geom, const Scope& scope, const Reading& reading);
LightSpec read_light(const Attributes& light, const Scope& scope);
/// <inertial> in a body.
Mass read_inertial(const Attributes& inertial, const Scope& scope, const Reading& reading);

}  // namespace roboss::mjcf
