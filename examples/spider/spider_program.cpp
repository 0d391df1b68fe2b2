// Walks every spider of a world of `roboss-world spiders` (docs/spider.md). The gait is a function of time;
// the compass of each spider holds it on its heading by strides that turn.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <roboss/client/control_program.h>
#include <roboss/core/fixed_math.h>
#include "gait_file.h"

namespace spider {
namespace {

constexpr double kStand = 0.2;       // s, before the first step
constexpr double kTurnGain = 0.5;    // of the error of the heading that one stride makes up for
constexpr double kMostTurn = 0.25;   // rad a stride
constexpr double kTurnChange = 1.0;  // rad/s, of the turn of a stride: feet that stand shall not jump

/// Headings in degrees, counterclockwise from the world's x axis, each from a time on.
struct Course {
    struct Leg {
        double from_s = 0, heading_rad = 0;
    };
    std::vector<Leg> legs;

    /// ROBOSS_SPIDER_COURSE="0 0, 4 90": 0 degrees at first, 90 degrees from 4 s on. None: each its own.
    static Course from_environment();
    std::optional<double> heading_at(double time_s) const {
        std::optional<double> heading;
        for (const Leg& leg : legs)
            if (leg.from_s <= time_s) heading = leg.heading_rad;
        return heading;
    }
};

Course Course::from_environment() {
    Course course;
    const char* text = std::getenv("ROBOSS_SPIDER_COURSE");
    std::istringstream parts(text != nullptr ? text : "");
    for (std::string part; std::getline(parts, part, ',');) {
        std::istringstream numbers(part);
        Leg leg;
        std::string rest;
        numbers >> leg.from_s >> leg.heading_rad;
        if (!numbers || numbers >> rest || (!course.legs.empty() && leg.from_s < course.legs.back().from_s))
            throw std::runtime_error(
                "ROBOSS_SPIDER_COURSE is \"" + std::string(text) +
                "\"\n  remedy: give pairs of a time in s and a heading in degrees, in the "
                "order of time: \"0 0, 4 90\"");
        leg.heading_rad *= roboss::kPi / 180;
        course.legs.push_back(leg);
    }
    return course;
}

/// What is remembered of a spider from one period to the next.
struct Steering {
    double heading = 0;  // rad, where it goes as long as the course does not say
    double turn = 0;     // rad a stride
};

struct Spider {
    roboss::RobotId robot;
    std::size_t compass = 0;
    std::array<roboss::JointId, kJoints> joints;
};

class SpiderProgram final : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {kPeriod, -1, true}; }

    void start(roboss::Client& client) override {
        const char* file = std::getenv("ROBOSS_SPIDER_GAIT");
        gait_ = file != nullptr ? load_gait(file) : Gait{};
        course_ = Course::from_environment();
        spiders_.clear();
        for (std::size_t i = 0; i < client.model().robots.size(); ++i)
            if (const auto spider = spider_of(client.model(), roboss::RobotId(i)))
                spiders_.push_back(*spider);
        if (spiders_.empty())
            throw std::runtime_error(
                "this world has no spider\n  remedy: take worlds/spider.sdf, or make a "
                "world with `roboss-world spiders -o spiders.sdf`");
        steering_.clear();
    }

    void control(roboss::Client& client) override {
        if (steering_.size() != spiders_.size()) {
            steering_.clear();
            for (const Spider& spider : spiders_) steering_.push_back({heading_of(client, spider), 0});
        }
        // Orders take effect a period after the observation.
        const double walked = client.time_s() + kPeriod - kStand;
        const std::optional<double> course = course_.heading_at(client.time_s());
        for (std::size_t i = 0; i < spiders_.size(); ++i) {
            if (course) steering_[i].heading = *course;
            steer(steering_[i], heading_of(client, spiders_[i]));
            const auto angles = targets(gait_, walked, steering_[i].turn);
            for (std::size_t j = 0; j < kJoints; ++j)
                client.set_joint(spiders_[i].robot, spiders_[i].joints[j], roboss::MotorMode::kPosition,
                                 angles[j]);
        }
    }

    std::string memory() const override {
        std::string bytes(steering_.size() * sizeof(Steering), '\0');
        if (!bytes.empty()) std::memcpy(bytes.data(), steering_.data(), bytes.size());
        return bytes;
    }

    void restore(const std::string& bytes) override {
        if (bytes.size() != spiders_.size() * sizeof(Steering))
            throw std::runtime_error(
                "the saved run remembers other spiders than this world has\n  remedy: "
                "continue it with the world that it was saved from");
        steering_.resize(spiders_.size());
        std::memcpy(steering_.data(), bytes.data(), bytes.size());
    }

  private:
    static constexpr double kPeriod = 0.01;  // s

    static std::optional<Spider> spider_of(const roboss::Model& model, roboss::RobotId robot) {
        const roboss::RobotType& type = model.type_of(robot);
        const auto compass = type.find_sensor("compass");
        if (!compass) return std::nullopt;
        Spider spider{robot, *compass, {}};
        for (std::size_t j = 0; j < kJoints; ++j) {
            const std::string name = std::string(kLegNames[j / kLegJoints]) + "_" +
                                     std::string(kPartNames[j % kLegJoints]) + "_joint";
            const auto joint = type.find_joint(name);
            if (!joint) return std::nullopt;
            spider.joints[j] = *joint;
        }
        return spider;
    }

    /// Counterclockwise from the world's x axis; the compass counts clockwise from its y axis.
    static double heading_of(roboss::Client& client, const Spider& spider) {
        return roboss::kPi / 2 - client.compass(spider.robot, spider.compass).heading_rad;
    }

    static void steer(Steering& steering, double heading) {
        const double wish =
            std::clamp(kTurnGain * roboss::wrap_angle(steering.heading - heading), -kMostTurn, kMostTurn);
        steering.turn += std::clamp(wish - steering.turn, -kTurnChange * kPeriod, kTurnChange * kPeriod);
    }

    Gait gait_;
    Course course_;
    std::vector<Spider> spiders_;
    std::vector<Steering> steering_;  // one a spider; empty before the first observation
};

}  // namespace
}  // namespace spider

using SpiderProgram = spider::SpiderProgram;
ROBOSS_CONTROL_PROGRAM(SpiderProgram)
