// A gyro and an accelerometer of one site are one IMU, named as the site; so are a force and a torque sensor.
// Sensors of joints are one reading of joint states for each robot.
#include "mjcf/sensors.h"

#include <algorithm>

namespace roboss::mjcf {
namespace {

class SensorReader {
  public:
    /// What the joint sensors of a robot in all files read.
    struct JointReader {
        ModelSpec* model = nullptr;
        std::vector<std::string> joints;
        SourceLocation where;
    };

    SensorReader(Robots& robots, const Reading& reading, std::vector<JointReader>& joint_readers)
        : robots_(robots), r_(reading), joint_readers_(joint_readers) {}

    void read() {
        for (const Element& element : r_.document.in_sections("sensor")) {
            const std::string kind = element.node.name();
            if (kind == "jointpos" || kind == "jointvel" || kind == "jointactuatorfrc")
                read_joint({{element}, r_.diagnostics});
            else if (kind == "gyro" || kind == "accelerometer")
                add_at_site({{element}, r_.diagnostics}, ImuSpec{}, true, {});
            else if (kind == "magnetometer")
                add_at_site({{element}, r_.diagnostics}, MagnetometerSpec{}, false, {});
            else if (kind == "force" || kind == "torque")
                add_force({{element}, r_.diagnostics});
            else if (kind == "touch")
                add_at_site({{element}, r_.diagnostics}, ContactSpec{}, false, {});
            else if (kind == "rangefinder")
                add_rangefinder({{element}, r_.diagnostics});
            else
                no_effect(element, "a sensor <" + kind + "> measures nothing",
                          "Read it in the control program: poses, velocities and contacts are there.");
        }
    }

    static void add_joint_states(const JointReader& reader) {
        SensorSpec sensor;
        sensor.name = "joint_states";
        JointStatesSpec spec;
        spec.joints = reader.joints;
        sensor.parameters = spec;
        sensor.where = reader.where;
        const auto first = std::ranges::find_if(reader.model->links,
                                                [](const LinkSpec& link) { return !link.between_joints; });
        if (first != reader.model->links.end()) first->sensors.push_back(std::move(sensor));
    }

  private:
    void no_effect(const Element& element, const std::string& what, const std::string& remedy) const {
        r_.warn(element.where(), "unsupported-sensor", what, remedy);
    }

    std::optional<Tree::SitePlace> site_of(const Attributes& source) const {
        const auto place = robots_.tree().find_site(r_.names.full(source.text("site")));
        if (!place)
            r_.report_unknown(
                source.where(), {source.text("site")}, "unknown-site",
                "a sensor names the site '" + source.text("site") + "', which the file does not have",
                "Check the name.");
        return place;
    }

    /// `shared`: named as its site, once for all sensors of this kind there.
    void add_at_site(const Attributes& source, SensorParameters parameters, bool shared, const Quat& turn) {
        const auto place = site_of(source);
        if (!place) return;
        const SitePart& site = robots_.tree().bodies[place->body].sites[place->site];
        SensorSpec sensor;
        sensor.parameters = std::move(parameters);
        sensor.sdf_type = source.element().node.name();
        sensor.name =
            shared || source.name().empty() ? robots_.local_name(place->body, site.name) : source.name();
        sensor.X_LS = site.X_BS * Pose{{}, turn};
        sensor.where = source.where();
        std::vector<SensorSpec>& sensors = robots_.link_of(place->body).sensors;
        const auto same = [&](const SensorSpec& other) { return other.name == sensor.name; };
        const auto known = std::ranges::find_if(sensors, same);
        if (known != sensors.end() && shared && known->kind().number == sensor.kind().number) return;
        while (std::ranges::any_of(sensors, same)) sensor.name += "_";
        sensors.push_back(std::move(sensor));
    }

    /// MuJoCo: the force that the child exerts on its parent, in the axes of the site.
    void add_force(const Attributes& source) {
        const auto place = site_of(source);
        if (!place) return;
        const std::string own = robots_.local_name(place->body);
        const ModelSpec& model = robots_.model_of(place->body);
        const auto holds = [&](const JointSpec& joint) { return joint.child == own && !joint.closes_loop; };
        const auto joint = std::ranges::find_if(model.joints, holds);
        if (joint == model.joints.end())
            return no_effect(source.element(),
                             "a force or torque sensor of a body that nothing holds measures nothing",
                             "Put its site on a body with a parent.");
        ForceTorqueSpec spec;
        spec.joint = joint->name;
        spec.frame = "sensor";
        add_at_site(source, spec, true, {});
    }

    /// It looks along z of its site; a laser's beam is along x.
    void add_rangefinder(const Attributes& source) {
        constexpr double kFar = 1000;  // m
        if (!source.has("site"))
            return no_effect(source.element(), "a rangefinder of a camera measures nothing",
                             "Put it on a site.");
        LaserSpec spec;
        const double cutoff = source.number("cutoff", 0);
        spec.range_max = cutoff > 0 ? cutoff : kFar;
        add_at_site(source, spec, false, axis_angle(Vec3{0, 1, 0}, -kPi / 2));
    }

    void read_joint(const Attributes& source) {
        const auto place = robots_.tree().find_joint(r_.names.full(source.text("joint")));
        JointSpec* joint = place ? robots_.joint_of(*place) : nullptr;
        if (!place) {
            r_.report_unknown(
                source.where(), {source.text("joint")}, "unknown-joint",
                "a sensor names the joint '" + source.text("joint") + "', which the file does not have",
                "Check the name.");
            return;
        }
        if (joint == nullptr || joint->axes.empty())
            return no_effect(source.element(), "a sensor of a ball or free joint measures nothing",
                             "Read its position in the control program.");
        ModelSpec* model = &robots_.model_of(place->body);
        auto reader = std::ranges::find(joint_readers_, model, &JointReader::model);
        if (reader == joint_readers_.end())
            reader = joint_readers_.insert(reader, {model, {}, source.where()});
        if (std::ranges::find(reader->joints, joint->name) == reader->joints.end())
            reader->joints.push_back(joint->name);
    }

    Robots& robots_;
    const Reading& r_;
    std::vector<JointReader>& joint_readers_;
};

}  // namespace

void read_sensors(Robots& robots, std::span<const Reading> parts) {
    std::vector<SensorReader::JointReader> joint_readers;
    for (const Reading& part : parts) SensorReader(robots, part, joint_readers).read();
    for (const auto& reader : joint_readers) SensorReader::add_joint_states(reader);
}

}  // namespace roboss::mjcf
