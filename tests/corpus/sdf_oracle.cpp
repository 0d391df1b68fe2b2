// Calls libsdformat, and walks both readings of a world side by side.
#include "corpus/sdf_oracle.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sdf/sdf.hh>

#include "sdf/load_world.h"
#include "world/joint_type.h"

namespace roboss::corpus {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance = 1e-12;

/// The file or folder behind a URI: what follows the scheme, in the first of the folders that has it.
std::string find(const std::vector<std::string>& folders, const std::string& uri) {
    const std::size_t scheme = uri.find("://");
    const fs::path rest = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
    for (const fs::path folder : folders) {
        std::error_code ignored;
        if (fs::exists(folder / rest, ignored)) return (folder / rest).string();
    }
    return {};
}

Vec3 to_vec(const ignition::math::Vector3d& v) {
    return {v.X(), v.Y(), v.Z()};
}

Pose to_pose(const ignition::math::Pose3d& pose) {
    const auto& q = pose.Rot();
    return {to_vec(pose.Pos()), normalized(Quat{q.W(), q.X(), q.Y(), q.Z()})};
}

bool near(double a, double b) {
    return a == b || std::fabs(a - b) <= kTolerance * std::max({1.0, std::fabs(a), std::fabs(b)});
}

bool near(const Vec3& a, const Vec3& b) {
    const double size = std::max({1.0, norm(a), norm(b)});
    return norm(a - b) <= kTolerance * size;
}

bool near(const Pose& a, const Pose& b) {
    const Quat between = conjugate(a.q) * b.q;
    return near(a.p, b.p) && norm(Vec3{between.x, between.y, between.z}) <= kTolerance;
}

/// Unlimited counts as one value, however it is written.
double bound(double value) {
    return value < 0 || value >= kUnlimited ? -1 : value;
}

double limit(double value) {
    return std::clamp(value, -kUnlimited, kUnlimited);
}

class Comparison {
  public:
    Comparison(const World& world, Verdict& verdict) : world_(world), verdict_(verdict) {}

    void compare(const sdf::Root& root) {
        if (const sdf::Model* model = root.Model()) compare_instance(*model, {});
        const sdf::World* const world = root.WorldCount() > 0 ? root.WorldByIndex(0) : nullptr;
        for (std::uint64_t i = 0; world != nullptr && i < world->ModelCount(); ++i) {
            const sdf::Model& model = *world->ModelByIndex(i);
            ignition::math::Pose3d pose;
            if (!model.SemanticPose().Resolve(pose).empty()) differ("pose of " + model.Name());
            compare_instance(model, to_pose(pose));
        }
    }

  private:
    void differ(const std::string& what) { verdict_.differences.push_back(what); }

    void check(bool equal, const std::string& what) {
        if (!equal) differ(what);
    }

    void compare_instance(const sdf::Model& model, const Pose& X_WM) {
        const auto instance = std::ranges::find(world_.instances, model.Name(), &ModelInstance::name);
        if (instance == world_.instances.end()) {
            if (model.LinkCount() + model.ModelCount() > 0) differ("model " + model.Name() + " is missing");
            return;
        }
        const sdf::ElementPtr in = model.Element()->GetParent();
        if (in && in->GetName() == "world" && !in->HasElement("state"))  // which moves models, here
            check(near(instance->X_WM, X_WM), "pose of model " + model.Name());
        spec_ = &world_.prototypes[instance->prototype];
        links_ = 0;
        joints_ = 0;
        has_static_ = false;
        ++verdict_.models;
        compare_model(model, "", {});
        check(links_ == spec_->links.size(), "number of links of " + model.Name());
        verdict_.links += links_;
        verdict_.joints += joints_;
    }

    void compare_model(const sdf::Model& model, const std::string& prefix, const Pose& X_MS) {
        has_static_ |= !prefix.empty() && model.Static();
        for (std::uint64_t i = 0; i < model.LinkCount(); ++i)
            compare_link(*model.LinkByIndex(i), prefix, X_MS);
        for (std::uint64_t i = 0; i < model.JointCount(); ++i)
            compare_joint(*model.JointByIndex(i), prefix, X_MS);
        for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
            const sdf::Model& nested = *model.ModelByIndex(i);
            compare_model(nested, prefix + nested.Name() + "::", X_MS * resolved(nested, "__model__"));
        }
    }

    template <class Posed>
    Pose resolved(const Posed& posed, const std::string& in) {
        ignition::math::Pose3d pose;
        if (!posed.SemanticPose().Resolve(pose, in).empty()) differ("libsdformat: pose of " + posed.Name());
        return to_pose(pose);
    }

    void compare_link(const sdf::Link& link, const std::string& prefix, const Pose& X_MS) {
        const std::string name = prefix + link.Name();
        ++links_;
        const auto spec = std::ranges::find(spec_->links, name, &LinkSpec::name);
        if (spec == spec_->links.end()) return differ("link " + name + " is missing");
        check(near(spec->X_ML, X_MS * resolved(link, "__model__")), "pose of link " + name);
        if (!spec_->is_static && !spec_->kinematic) compare_inertia(link, *spec);
        for (std::uint64_t i = 0; i < link.SensorCount(); ++i)
            compare_sensor(*link.SensorByIndex(i), link, *spec);
        for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
            const sdf::Collision& collision = *link.CollisionByIndex(i);
            const auto found = std::ranges::find(spec->collisions, collision.Name(), &CollisionSpec::name);
            const bool plane =
                found != spec->collisions.end() && found->geometry.kind == GeometryKind::kPlane;
            if (found != spec->collisions.end() && !plane)  // a plane's normal is folded into its pose
                check(near(found->X_LS, resolved(collision, link.Name())),
                      "pose of collision " + found->name);
        }
    }

    void compare_inertia(const sdf::Link& link, const LinkSpec& spec) {
        const auto written =
            link.Element()->HasElement("inertial") ? link.Element()->GetElement("inertial") : nullptr;
        const auto mass = written ? written->FindElement("mass") : nullptr;
        if (written && !(mass && mass->GetExplicitlySetInFile())) return;  // auto: newer than libsdformat 12
        const auto inertial = link.Inertial();
        check(near(spec.mass, inertial.MassMatrix().Mass()), "mass of link " + spec.name);
        check(near(spec.p_LC, to_vec(inertial.Pose().Pos())), "centre of mass of link " + spec.name);
        const auto moments = inertial.Moi();
        double size = 1;
        for (std::size_t i = 0; i < 3; ++i) size = std::max(size, std::fabs(spec.inertia_C(i, i)));
        bool equal = true;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                equal &= std::fabs(moments(i, j) - spec.inertia_C(i, j)) <= kTolerance * size;
        check(equal, "inertia of link " + spec.name);
    }

    void compare_sensor(const sdf::Sensor& sensor, const sdf::Link& link, const LinkSpec& spec) {
        const auto found = std::ranges::find_if(spec.sensors, [&](const SensorSpec& s) {
            return s.name == sensor.Name() ||
                   s.name.starts_with(sensor.Name() + "/");  // cameras of a multicamera
        });
        if (found == spec.sensors.end()) return differ("sensor " + sensor.Name() + " of link " + spec.name);
        check(near(found->X_LS, resolved(sensor, link.Name())), "pose of sensor " + sensor.Name());
    }

    void compare_joint(const sdf::Joint& joint, const std::string& prefix, const Pose& X_MS) {
        const std::string name = prefix + joint.Name();
        ++joints_;
        const auto spec = std::ranges::find(spec_->joints, name, &JointSpec::name);
        if (spec == spec_->joints.end()) {
            // Left out by intent: gearboxes that couple nothing, and joints of links that stand still.
            const bool intended = joint.Type() == sdf::JointType::GEARBOX || has_static_ ||
                                  spec_->is_static || spec_->kinematic;
            return check(intended, "joint " + name + " is missing");
        }
        check(near(spec->X_MJ, X_MS * resolved(joint, "__model__")), "pose of joint " + name);
        std::string parent, child;
        check(joint.ResolveParentLink(parent).empty() && joint.ResolveChildLink(child).empty(),
              "libsdformat: links of " + name);
        check(spec->parent == (parent == "world" ? parent : prefix + parent), "parent of joint " + name);
        check(spec->child == prefix + child, "child of joint " + name);
        const JointType& type = joint_type(spec->kind);
        if (type.is_extension) return;
        const bool parallel = joint.Axis(0) != nullptr && joint.Axis(1) != nullptr &&
                              joint.Axis(0)->Xyz() == joint.Axis(1)->Xyz();  // here the second is turned
        for (unsigned i = 0; i < (parallel ? 1 : spec->axes.size()) && i < 2; ++i)
            if (joint.Axis(i) != nullptr) compare_axis(*joint.Axis(i), spec->axes[i], type, name);
    }

    void compare_axis(const sdf::JointAxis& axis, const AxisSpec& spec, const JointType& type,
                      const std::string& name) {
        ignition::math::Vector3d xyz;
        check(axis.ResolveXyz(xyz).empty(), "libsdformat: axis of " + name);
        check(near(spec.xyz, normalized(to_vec(xyz))), "axis of joint " + name);
        const bool limits = type.endless || (near(limit(spec.lower), limit(axis.Lower())) &&
                                             near(limit(spec.upper), limit(axis.Upper())));
        check(limits, "limits of joint " + name);
        check(near(bound(spec.max_velocity), bound(axis.MaxVelocity())), "velocity limit of joint " + name);
        check(near(bound(spec.max_effort), bound(axis.Effort())), "effort of joint " + name);
        check(near(spec.damping, axis.Damping()) && near(spec.friction, axis.Friction()),
              "dynamics of joint " + name);
    }

    const World& world_;
    Verdict& verdict_;
    const ModelSpec* spec_ = nullptr;
    std::size_t links_ = 0, joints_ = 0;
    bool has_static_ = false;  // a nested model that stands still
};

}  // namespace

Verdict ask_libsdformat(const std::string& file, const std::vector<std::string>& folders) {
    Verdict verdict;
    std::vector<std::string> all{fs::path(file).parent_path().string()};
    all.insert(all.end(), folders.begin(), folders.end());
    sdf::Root root;
    try {
        sdf::ParserConfig config;
        config.SetFindCallback([&](const std::string& uri) { return find(all, uri); });
        const sdf::Errors errors = root.Load(file, config);
        if (!errors.empty()) verdict.refusal = errors.front().Message();
    } catch (const std::exception& exception) {
        verdict.refusal = exception.what();
    }
    verdict.refusal.resize(std::min(verdict.refusal.size(), verdict.refusal.find('\n')));
    if (!verdict.refusal.empty() || fs::path(file).extension() == ".urdf") return verdict;
    Diagnostics diagnostics;
    const auto world = load_world(file, {folders, {}, false}, diagnostics);
    if (!world) {
        verdict.differences.push_back("our reader refuses it");
        return verdict;
    }
    Comparison(*world, verdict).compare(root);
    return verdict;
}

}  // namespace roboss::corpus
