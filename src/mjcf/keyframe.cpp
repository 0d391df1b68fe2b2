// See keyframe.h.
#include "mjcf/keyframe.h"

#include <algorithm>
#include <span>
#include <vector>

#include "mjcf/attributes.h"

namespace roboss::mjcf {
namespace {

std::string name_of(const Element& key, std::size_t number) {
    const std::string name = key.node.attribute("name").value();
    return name.empty() ? std::to_string(number) : name;
}

std::vector<Element> keys_of(const Document& document) {
    std::vector<Element> keys;
    for (const Element& element : document.in_sections("keyframe"))
        if (std::string(element.node.name()) == "key") keys.push_back(element);
    return keys;
}

const Element* find_key(const std::vector<Element>& keys, const std::string& wanted) {
    for (const Element& key : keys)
        if (wanted == key.node.attribute("name").value()) return &key;
    for (std::size_t k = 0; k < keys.size(); ++k)
        if (wanted == std::to_string(k)) return &keys[k];
    return nullptr;
}

std::size_t width_q(JointMotion motion) {
    return motion == JointMotion::kFree ? 7 : motion == JointMotion::kBall ? 4 : 1;
}
std::size_t width_v(JointMotion motion) {
    return motion == JointMotion::kFree ? 6 : motion == JointMotion::kBall ? 3 : 1;
}

Vec3 vec3(std::span<const double> x) {
    return {x[0], x[1], x[2]};
}
Quat quat(std::span<const double> x) {
    return normalized(Quat{x[0], x[1], x[2], x[3]});
}

/// How a body stands and moves, in the world.
struct Moving {
    Pose X_WB;
    Vec3 angular, linear;  // rad/s; m/s of what is at the world's origin

    Vec3 at(const Vec3& p_W) const { return linear + cross(angular, p_W); }
    /// Turns also so fast about an axis through a point.
    void turn(const Vec3& rate, const Vec3& p_W) { angular += rate, linear += cross(p_W, rate); }
};

/// The numbers of one key, taken from the front, body by body.
class KeyReader {
  public:
    KeyReader(const Element& key, Robots& robots, Diagnostics& diagnostics)
        : key_({key}, diagnostics), robots_(robots), bodies_(robots.tree().bodies), moving_(bodies_.size()) {}

    void read() {
        std::size_t nq = 0, nv = 0, mocaps = 0;
        for (const BodyPart& body : bodies_) {
            mocaps += body.mocap ? 1 : 0;
            for (const JointPart& joint : body.joints)
                nq += width_q(joint.motion), nv += width_v(joint.motion);
        }
        qpos_ = list("qpos", nq), qvel_ = list("qvel", nv);
        mpos_ = list("mpos", 3 * mocaps), mquat_ = list("mquat", 4 * mocaps);
        for (std::size_t b = 1; b < bodies_.size(); ++b) read_body(b);
    }

  private:
    /// All numbers of an attribute; none: it is not there, or an error tells that there are not as many.
    std::vector<double> list(const char* attribute, std::size_t count) {
        if (!key_.has(attribute)) return {};
        std::vector<double> numbers = key_.list(attribute);
        if (numbers.size() == count) return numbers;
        key_.bad_value(attribute, std::to_string(count) + " numbers, as the joints and bodies of the file");
        return {};
    }

    /// The next numbers of a list; empty: it has none.
    static std::span<const double> next(const std::vector<double>& list, std::size_t& at, std::size_t count) {
        if (list.empty()) return {};
        at += count;
        return std::span(list).subspan(at - count, count);
    }

    void read_body(std::size_t index) {
        const BodyPart& body = bodies_[index];
        ModelInstance& start = robots_.start_of(index);
        Moving& moving = moving_[index] = moving_[body.parent];
        moving.X_WB = moving.X_WB * body.X_PB;
        if (body.mocap) {
            const auto p = next(mpos_, at_mpos_, 3), q = next(mquat_, at_mquat_, 4);
            if (!p.empty()) moving.X_WB.p = vec3(p);
            if (!q.empty()) moving.X_WB.q = quat(q);
            start.X_WM = moving.X_WB;
        }
        if (body.joints.empty()) return;
        LinkStart link{robots_.local_name(index), {}, {}, {}};
        for (const JointPart& joint : body.joints) {
            const auto q = next(qpos_, at_q_, width_q(joint.motion)),
                       v = next(qvel_, at_v_, width_v(joint.motion));
            move(joint, q, v, moving);
            if (joint.motion == JointMotion::kFree)
                start.X_WM = moving.X_WB;
            else if (joint.motion == JointMotion::kBall)
                link.X_WL = moving.X_WB;
            else if (!q.empty())
                start.axes.push_back({robots_.local_name(index, joint.name), 0, q[0]});
        }
        if (link.X_WL) link.X_WL = moving.X_WB;
        link.angular = moving.angular, link.linear = moving.at(moving.X_WB.p);
        if (link.X_WL || !qvel_.empty()) start.links.push_back(std::move(link));
    }

    /// The body with the joints up to this one, as MuJoCo applies them, in their order.
    static void move(const JointPart& joint, std::span<const double> q, std::span<const double> v,
                     Moving& body) {
        Pose& X = body.X_WB;
        const Vec3 anchor = X * joint.pos;
        switch (joint.motion) {
            case JointMotion::kFree:
                if (!q.empty()) X = {vec3(q), quat(q.subspan(3))};
                body.angular = body.linear = {};
                if (v.empty()) return;
                body.turn(rotate(X.q, vec3(v.subspan(3))), X.p);
                body.linear += vec3(v);
                return;
            case JointMotion::kBall:
                if (!q.empty()) X.q = X.q * quat(q);
                if (!v.empty()) body.turn(rotate(X.q, vec3(v)), anchor);
                break;
            case JointMotion::kSlide: {
                const Vec3 axis = rotate(X.q, joint.axis.xyz);
                if (!q.empty()) X.p += axis * (q[0] - joint.ref);
                if (!v.empty()) body.linear += axis * v[0];
                return;
            }
            case JointMotion::kHinge:
                if (!v.empty()) body.turn(rotate(X.q, joint.axis.xyz) * v[0], anchor);
                if (!q.empty()) X.q = X.q * axis_angle(joint.axis.xyz, q[0] - joint.ref);
                break;
        }
        X.p = anchor - rotate(X.q, joint.pos);
    }

    Attributes key_;
    Robots& robots_;
    const std::vector<BodyPart>& bodies_;
    std::vector<Moving> moving_;  // by body
    std::vector<double> qpos_, qvel_, mpos_, mquat_;
    std::size_t at_q_ = 0, at_v_ = 0, at_mpos_ = 0, at_mquat_ = 0;
};

/// "home, 1, ..."
std::string names_of(const std::vector<Element>& keys) {
    constexpr std::size_t kMost = 10;
    std::string names;
    for (std::size_t k = 0; k < std::min(keys.size(), kMost); ++k)
        names += (k == 0 ? "" : ", ") + name_of(keys[k], k);
    return names + (keys.size() > kMost ? ", ..." : "");
}

}  // namespace

void start_at_keyframe(const std::string& wanted, const Document& document, Robots& robots,
                       Diagnostics& diagnostics) {
    const std::vector<Element> keys = keys_of(document);
    if (wanted.empty()) {
        if (!keys.empty())
            diagnostics.note(keys.front().where(), "keyframe",
                             "the world starts where the bodies stand, as in MuJoCo, not at a keyframe; "
                             "--keyframe NAME starts it at one: " +
                                 names_of(keys));
        return;
    }
    const Element* key = find_key(keys, wanted);
    if (key == nullptr) {
        diagnostics.error(
            document.root().where(), "no-keyframe", "the file has no keyframe '" + wanted + "'",
            keys.empty() ? "It has none: leave it out." : "Its keyframes: " + names_of(keys) + ".");
        return;
    }
    KeyReader(*key, robots, diagnostics).read();
    diagnostics.note(key->where(), "keyframe", "the world starts at the keyframe '" + wanted + "'");
}

}  // namespace roboss::mjcf
