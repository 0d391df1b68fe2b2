// Names for the numbers of a robot's state.
#include <algorithm>
#include <bit>
#include <cstdio>

#include "model/joint_parameters.h"
#include "simulation/divergence.h"

namespace roboss {

namespace {

std::string text(double x) {
    char line[64];
    std::snprintf(line, sizeof line, "%.17g", x);
    return line;
}
std::string text(std::uint64_t x) {
    return std::to_string(x);
}

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Compares field by field and keeps the first difference.
class Fields {
  public:
    void number(const std::string& name, double a, double b) {
        if (!found_ && !same(a, b)) found_ = FieldDifference{name, text(a), text(b)};
    }
    void count(const std::string& name, std::uint64_t a, std::uint64_t b) {
        if (!found_ && a != b) found_ = FieldDifference{name, text(a), text(b)};
    }
    void vector(const std::string& name, const Vec3& a, const Vec3& b) {
        number(name + " x", a.x, b.x), number(name + " y", a.y, b.y), number(name + " z", a.z, b.z);
    }
    bool done() const { return found_.has_value(); }
    std::optional<FieldDifference> take() { return std::move(found_); }

  private:
    std::optional<FieldDifference> found_;
};

const char* const kPose[] = {"base position x",    "base position y",    "base position z",
                             "base orientation w", "base orientation x", "base orientation y",
                             "base orientation z"};
const char* const kTwist[] = {"base angular velocity x", "base angular velocity y", "base angular velocity z",
                              "base linear velocity x",  "base linear velocity y",  "base linear velocity z"};

/// "joint 'wheel_0' position", by where the joint's coordinates begin.
std::string joint_field(const RobotType& type, int index, bool velocity) {
    std::string name = "coordinate";
    int offset = 0;
    for (const Joint& joint : type.joints) {
        const int first = velocity ? joint.v_index : joint.q_index;
        if (joint.body < 0 || joint.loop >= 0 || joint.nv == 0 || first < 0 || first > index) continue;
        name = "joint '" + joint.name + "'";
        offset = index - first;
    }
    return name + (velocity ? " velocity" : " position") + (offset > 0 ? " " + std::to_string(offset) : "");
}

void compare_coordinates(const RobotType& type, const RobotState& a, const RobotState& b, Fields& fields) {
    for (std::size_t i = 0; i < a.q.size(); ++i)
        if (!same(a.q[i], b.q[i]))
            fields.number(i < 7 ? kPose[i] : joint_field(type, static_cast<int>(i), false), a.q[i], b.q[i]);
    const auto base = static_cast<std::size_t>(type.base_nv());
    for (std::size_t i = 0; i < a.v.size(); ++i)
        if (!same(a.v[i], b.v[i]))
            fields.number(i < base ? kTwist[i] : joint_field(type, static_cast<int>(i), true), a.v[i],
                          b.v[i]);
}

void compare_orders(const RobotState& a, const RobotState& b, Fields& fields) {
    for (std::size_t i = 0; i < a.motors.size() && !fields.done(); ++i) {
        const std::string name = "motor " + std::to_string(i);
        fields.count(name + " mode", static_cast<std::uint64_t>(a.motors[i].mode),
                     static_cast<std::uint64_t>(b.motors[i].mode));
        fields.number(name + " target", a.motors[i].target, b.motors[i].target);
        fields.number(name + " maximum effort", a.motors[i].max_effort, b.motors[i].max_effort);
        fields.number(name + " impulse", a.motors[i].impulse, b.motors[i].impulse);
        fields.number(name + " load", a.motors[i].load, b.motors[i].load);
    }
    fields.count("number of wrenches", a.wrenches.size(), b.wrenches.size());
    for (std::size_t i = 0; i < a.wrenches.size() && !fields.done(); ++i) {
        const std::string name = "wrench " + std::to_string(i);
        fields.count(name + " link", a.wrenches[i].link.value, b.wrenches[i].link.value);
        fields.vector(name + " force", a.wrenches[i].force, b.wrenches[i].force);
        fields.vector(name + " torque", a.wrenches[i].torque, b.wrenches[i].torque);
        fields.count(name + " end", static_cast<std::uint64_t>(a.wrenches[i].until),
                     static_cast<std::uint64_t>(b.wrenches[i].until));
    }
}

void compare_own_numbers(const RobotType& type, const OwnNumbers& a, const OwnNumbers& b, Fields& fields) {
    fields.count("number of own numbers of joints", a.joints.size(), b.joints.size());
    for (std::size_t i = 0; i < a.joints.size() && !fields.done(); ++i) {
        const OwnJointNumber &x = a.joints[i], &y = b.joints[i];
        const std::string name = "axis " + std::to_string(x.axis) + " of joint '" +
                                 type.joints[x.joint.index()].name + "', " + info_of(x.number.parameter).name;
        fields.count(name + ", or of which joint", x.joint.value, y.joint.value);
        fields.count(name + ", or of which axis", static_cast<std::uint64_t>(x.axis),
                     static_cast<std::uint64_t>(y.axis));
        fields.count(name + ", or which number", static_cast<std::uint64_t>(x.number.parameter),
                     static_cast<std::uint64_t>(y.number.parameter));
        fields.number(name, x.number.value, y.number.value);
    }
    fields.count("number of own numbers of links", a.links.size(), b.links.size());
    for (std::size_t i = 0; i < a.links.size() && !fields.done(); ++i) {
        const OwnLinkNumber &x = a.links[i], &y = b.links[i];
        const std::string name =
            "link '" + type.links[x.link.index()].name + "', " + info_of(x.number.parameter).name;
        fields.count(name + ", or of which link", x.link.value, y.link.value);
        fields.count(name + ", or which number", static_cast<std::uint64_t>(x.number.parameter),
                     static_cast<std::uint64_t>(y.number.parameter));
        fields.number(name, x.number.value, y.number.value);
    }
    for (const SurroundingInfo& row : surroundings()) {
        const std::optional<Vec3>&x = a.around.*row.own, &y = b.around.*row.own;
        const std::string name = std::string("own ") + row.name;
        fields.count(name + ", or that it has some", x ? 1 : 0, y ? 1 : 0);
        if (x && y) fields.vector(name, *x, *y);
    }
}

void compare_pulls(const RobotState& a, const RobotState& b, Fields& fields) {
    fields.count("number of pulls", a.pulls.size(), b.pulls.size());
    for (std::size_t i = 0; i < a.pulls.size() && !fields.done(); ++i) {
        const std::string name = "pull " + std::to_string(i);
        fields.count(name + " link", a.pulls[i].link.value, b.pulls[i].link.value);
        fields.vector(name + " point", a.pulls[i].p_L, b.pulls[i].p_L);
        fields.vector(name + " target", a.pulls[i].target_W, b.pulls[i].target_W);
        fields.number(name + " rate", a.pulls[i].rate, b.pulls[i].rate);
        fields.number(name + " maximum force", a.pulls[i].max_force, b.pulls[i].max_force);
        fields.count(name + " end", static_cast<std::uint64_t>(a.pulls[i].until),
                     static_cast<std::uint64_t>(b.pulls[i].until));
    }
}

void compare_radios(const RobotState& a, const RobotState& b, Fields& fields) {
    for (std::size_t i = 0; i < std::min(a.radios.size(), b.radios.size()) && !fields.done(); ++i) {
        const RadioState &x = a.radios[i], &y = b.radios[i];
        const std::string name = "radio " + std::to_string(i);
        fields.count(name + ", transmissions", x.count, y.count);
        fields.count(name + ", dropped transmissions", x.dropped, y.dropped);
        fields.count(name + ", transmissions kept", x.sent.size(), y.sent.size());
        for (std::size_t k = 0; k < x.sent.size() && !fields.done(); ++k) {
            const std::string one = name + ", transmission " + std::to_string(x.sent[k].number);
            fields.count(one + " number", x.sent[k].number, y.sent[k].number);
            fields.count(one + " addressee", x.sent[k].to, y.sent[k].to);
            fields.count(one + " size", x.sent[k].size, y.sent[k].size);
            fields.number(one + " begin", x.sent[k].begin_s, y.sent[k].begin_s);
            fields.number(one + " end", x.sent[k].end_s, y.sent[k].end_s);
            fields.vector(one + " position", x.sent[k].X_WB.p, y.sent[k].X_WB.p);
        }
        fields.count(name + ", payloads differ", 0, x.bytes == y.bytes ? 0 : 1);
    }
}

void compare_contacts(const RobotState& a, const RobotState& b, Fields& fields) {
    fields.count("number of contacts", a.contacts.size(), b.contacts.size());
    for (std::size_t i = 0; i < a.contacts.size() && !fields.done(); ++i) {
        const ContactMemory &x = a.contacts[i], &y = b.contacts[i];
        const std::string name = "contact " + std::to_string(i);
        fields.count(name + " with robot", x.other_robot, y.other_robot);
        fields.count(name + " shape", x.shape, y.shape);
        fields.count(name + " other shape", x.other_shape, y.other_shape);
        fields.count(name + " feature", x.feature, y.feature);
        fields.number(name + " impulse", x.impulse, y.impulse);
        fields.number(name + " load", x.load, y.load);
        fields.vector(name + " friction", x.friction, y.friction);
    }
}

void compare_rest(const Rest& a, const Rest& b, Fields& fields) {
    fields.count("ticks at rest", a.still_ticks, b.still_ticks);
    fields.count("asleep", a.asleep ? 1 : 0, b.asleep ? 1 : 0);
    fields.count("number of a sleeper's neighbours", a.neighbours.size(), b.neighbours.size());
    for (std::size_t i = 0; i < a.neighbours.size() && !fields.done(); ++i)
        fields.count("a sleeper's neighbour " + std::to_string(i), a.neighbours[i], b.neighbours[i]);
    fields.vector("a sleeper's bound, minimum", a.bound.min, b.bound.min);
    fields.vector("a sleeper's bound, maximum", a.bound.max, b.bound.max);
}

void compare_onboard(const RobotState& a, const RobotState& b, Fields& fields) {
    fields.count("size of the on-board memory", a.onboard.size(), b.onboard.size());
    for (std::size_t i = 0; i < a.onboard.size() && !fields.done(); ++i)
        fields.number("on-board memory " + std::to_string(i), a.onboard[i], b.onboard[i]);
    for (std::size_t i = 0; i < a.lists.size() && !fields.done(); ++i) {
        const std::string name = "command list " + std::to_string(i);
        fields.count("length of " + name, a.lists[i].size(), b.lists[i].size());
        for (std::size_t k = 0; k < a.lists[i].size() && !fields.done(); ++k)
            fields.number(name + " value " + std::to_string(k), a.lists[i][k], b.lists[i][k]);
    }
    fields.count("number of moving surfaces", a.surfaces.size(), b.surfaces.size());
    for (std::size_t i = 0; i < a.surfaces.size() && !fields.done(); ++i) {
        const std::string name = "moving surface " + std::to_string(i);
        fields.count(name + " link", a.surfaces[i].link.value, b.surfaces[i].link.value);
        fields.vector(name + " linear", a.surfaces[i].linear_L, b.surfaces[i].linear_L);
        fields.vector(name + " angular", a.surfaces[i].angular_L, b.surfaces[i].angular_L);
    }
    fields.count("number of bonds", a.bonds.size(), b.bonds.size());
    for (std::size_t i = 0; i < a.bonds.size() && !fields.done(); ++i) {
        const std::string name = "bond " + std::to_string(i);
        fields.count(name + " phase", static_cast<std::size_t>(a.bonds[i].phase),
                     static_cast<std::size_t>(b.bonds[i].phase));
        fields.count(name + " robot", a.bonds[i].other, b.bonds[i].other);
        fields.vector(name + " position", a.bonds[i].X_LO.p, b.bonds[i].X_LO.p);
        fields.vector(name + " force", a.bonds[i].force_impulse, b.bonds[i].force_impulse);
        fields.vector(name + " torque", a.bonds[i].torque_impulse, b.bonds[i].torque_impulse);
    }
}

}  // namespace

std::optional<FieldDifference> first_difference(const RobotType& type, const RobotState& a,
                                                const RobotState& b) {
    Fields fields;
    fields.count("number of coordinates", a.q.size(), b.q.size());
    fields.count("number of velocities", a.v.size(), b.v.size());
    fields.count("number of motors", a.motors.size(), b.motors.size());
    if (fields.done()) return fields.take();
    compare_coordinates(type, a, b, fields);
    compare_orders(a, b, fields);
    if (!fields.done()) compare_own_numbers(type, a.own, b.own, fields);
    compare_pulls(a, b, fields);
    compare_radios(a, b, fields);
    compare_contacts(a, b, fields);
    compare_rest(a.rest, b.rest, fields);
    compare_onboard(a, b, fields);
    return fields.take();
}

}  // namespace roboss
