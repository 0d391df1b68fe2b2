// One question at a time: the line is slow (9600 baud: 0.9 bytes a millisecond), and answers carry no number.
#include "device/khepera.h"

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/fixed_math.h"
#include "model/robot_state.h"

namespace roboss {
namespace {

constexpr double kPatience_s = 0.2;    // for an answer; the longest takes 50 ms at 9600 baud
constexpr double kRepeat_s = 0.3;      // a robot that rebooted unseen drives on after this long
constexpr double kSlack = 2;           // wheels turn no faster than this many times the greatest speed
constexpr int kAgreed = 3;             // counts in a row, to believe a jump
constexpr long kMostCount = 1L << 31;  // of a counter
constexpr std::size_t kLongest = 80;   // characters of a line
constexpr std::size_t kEyes = 8;
constexpr double kAgain_s = 0.5;  // the banner has several lines

/// The inverse of the curve of InfraredSpec "khepera": m, +infinity where nothing is seen.
double range_of(double value) {
    if (value <= 0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, 0.01 - 0.025 * std::log(value / 1100));
}

/// The numbers behind the letter: "h,12,-3" -> 12, -3; nothing if one is no number.
std::optional<std::vector<long>> numbers_of(std::string_view line) {
    std::vector<long> numbers;
    for (std::size_t at = 1; at < line.size();) {
        if (line[at] != ',') return std::nullopt;
        long number = 0;
        const char* begin = line.data() + at + 1;
        const auto [end, failed] = std::from_chars(begin, line.data() + line.size(), number);
        if (failed != std::errc() || end == begin) return std::nullopt;
        numbers.push_back(number);
        at = static_cast<std::size_t>(end - line.data());
    }
    return numbers;
}

Error cannot(const std::string& what, const std::string& remedy) {
    return {"a khepera has no " + what, remedy, "no-ability"};
}

}  // namespace

Result<std::unique_ptr<DeviceAdapter>> KheperaAdapter::create(const Model& model, RobotId robot) {
    if (!robot.valid()) return Error{"the protocol khepera drives a robot", "give --robot", "no-robot"};
    const RobotType& type = model.type_of(robot);
    const auto one_axis = [&](const char* name) {
        const auto joint = type.find_joint(name);
        return joint && type.joints[joint->index()].nv == 1;
    };
    std::size_t eyes = 0;
    for (const SensorInfo& sensor : type.sensors) eyes += sensor.spec.as<InfraredSpec>() != nullptr ? 1 : 0;
    if (!one_axis("left") || !one_axis("right") || eyes != kEyes)
        return Error{"robot '" + model.robots[robot.index()].name + "' is no khepera: it has " +
                         std::to_string(eyes) + " infrared sensors" +
                         (one_axis("left") && one_axis("right") ? "" : ", and no joints left and right"),
                     "describe it with wheels at the joints left and right and eight infrared sensors, as "
                     "worlds/khepera.sdf does",
                     "not-this-robot"};
    const Pose X_WR = model.robots[robot.index()].X_WR;
    return std::unique_ptr<DeviceAdapter>(new KheperaAdapter(type, robot, X_WR));
}

KheperaAdapter::KheperaAdapter(const RobotType& type, RobotId robot, Pose X_WR) : type_(type), robot_(robot) {
    wheels_[0] = *type.find_joint("left");
    wheels_[1] = *type.find_joint("right");
    for (std::size_t s = 0; s < type.sensors.size(); ++s)
        if (type.sensors[s].spec.as<InfraredSpec>() != nullptr) sensors_.push_back(s);
    readings_.poses[robot] = {X_WR, {}, {}, true};
}

Result<> KheperaAdapter::order(const Action& action) {
    const auto* set = std::get_if<SetJoint>(&action);
    if (set == nullptr) return cannot("such order", "give set_joint() with MotorMode::kVelocity");
    const bool left = set->joint == wheels_[0];
    if (!left && set->joint != wheels_[1])
        return cannot("motor at joint '" + type_.joints[set->joint.index()].name + "'",
                      "drive left and right");
    if (set->mode != MotorMode::kVelocity)
        return cannot("motors for positions, efforts or free wheels",
                      "give set_joint() with MotorMode::kVelocity");
    if (set->max_effort >= 0) return cannot("bound of efforts", "leave max_effort out");
    const double units = set->target / KheperaUnits::kSpeed;
    const double most = KheperaUnits::kMostSpeed;
    ordered_[left ? 0 : 1] = static_cast<int>(std::lround(std::clamp(units, -most, most)));
    return Ok{};
}

void KheperaAdapter::line_renewed() {
    part_.clear();
    asked_ = 0;
    acknowledged_.reset();
}

/// Speeds first when they changed; else what is read, by turns.
char KheperaAdapter::next_question(double now_s) const {
    if (acknowledged_ != wanted() || now_s - set_s_ > kRepeat_s) return 'D';
    return "NHE"[turn_ % 3];
}

std::vector<std::string> KheperaAdapter::due(double now_s) {
    if (asked_ != 0 && now_s - asked_s_ < kPatience_s) return {};
    if (asked_ != 0) {
        ++count_.lost;
        part_.clear();
    }
    const bool silent = asked_ != 0;
    asked_ = next_question(now_s);
    asked_s_ = now_s;
    std::string text(1, asked_);
    if (asked_ == 'D') {
        sent_ = wanted();
        fastest_ = std::max(fastest_, fastest_now());
        text += "," + std::to_string(sent_[0]) + "," + std::to_string(sent_[1]);
        set_s_ = now_s;
        acknowledged_.reset();
    } else {
        ++turn_;
    }
    // A newline first ends what the robot may have understood of a damaged command.
    return {(silent ? "\n" : "") + text + "\n"};
}

void KheperaAdapter::receive(std::string_view bytes, double now_s) {
    for (const char c : bytes) {
        if (c != '\n' && c != '\r') {
            if (part_.size() < kLongest) part_ += c;
        } else if (!part_.empty()) {
            take_line(std::exchange(part_, {}), now_s);
        }
    }
}

void KheperaAdapter::take_line(const std::string& line, double now_s) {
    const char letter = line[0];
    const bool is_answer = letter >= 'a' && letter <= 'z' && (line.size() == 1 || line[1] == ',');
    if (!is_answer && line.find(' ') != std::string::npos) return note_reboot(line, now_s);
    const auto numbers = is_answer ? numbers_of(line) : std::nullopt;
    if (!numbers || !take_numbers(letter, *numbers, now_s)) {
        ++count_.damaged;
    } else {
        ++count_.taken;
    }
    if (letter == asked_ - 'A' + 'a') asked_ = 0;  // damaged or not: nothing more will come
    readings_.fresh_s = std::min(proximity_s_, counts_s_);
}

bool KheperaAdapter::take_numbers(char letter, const std::vector<long>& numbers, double now_s) {
    switch (letter) {
        case 'd':
            if (asked_ == 'D' && numbers.empty()) acknowledged_ = sent_;
            return numbers.empty();
        case 'n':
            return take_proximity(numbers, now_s);
        case 'h':
            return numbers.size() == 2 && take_counts({numbers[0], numbers[1]}, now_s);
        case 'e':
            return numbers.size() == 2 && take_speeds(numbers);
        default:
            return false;
    }
}

bool KheperaAdapter::take_proximity(const std::vector<long>& values, double now_s) {
    if (values.size() != kEyes) return false;
    for (const long value : values)
        if (value < 0 || value > 1023) return false;
    for (std::size_t i = 0; i < kEyes; ++i) {
        const auto value = static_cast<double>(values[i]);
        readings_.sensors[sensors_[i]] = InfraredReading{range_of(value), value, 0};
    }
    proximity_s_ = now_s;
    return true;
}

/// Pulses in 10 ms, the faster wheel: what was ordered last or what the robot says.
double KheperaAdapter::fastest_now() const {
    double most = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        most = std::max(most, std::fabs(static_cast<double>(sent_[i])));
        const auto wheel = readings_.joints.find(wheels_[i]);
        if (wheel == readings_.joints.end()) continue;
        most = std::max(most, std::fabs(wheel->second.velocity) / KheperaUnits::kSpeed);
    }
    return most;
}

/// A count that jumps further than the wheels turned, by all that is known, may have been falsified on the
/// line: it is believed if the next ones agree. If no wheel turns that fast, the robot started again unseen.
bool KheperaAdapter::take_counts(const Counts& counts, double now_s) {
    for (const long count : counts)
        if (count < -kMostCount || count > kMostCount) return false;
    const auto is_far = [&](const Counts& other, double other_s, double speed) {
        const double elapsed_s = std::min(now_s - other_s, 3600.0);
        const long most =
            std::lround(kSlack * (KheperaUnits::kMostSpeed / 4 + speed * (1 + 100 * elapsed_s)));
        return std::labs(counts[0] - other[0]) > most || std::labs(counts[1] - other[1]) > most;
    };
    constexpr double kAny = KheperaUnits::kMostSpeed;
    bool anew = reset_ || !counts_;
    if (!anew && is_far(*counts_, counts_s_, fastest_)) {
        const bool agrees = suspicions_ > 0 && !is_far(suspicion_, suspicion_s_, kAny);
        if (!agrees) suspicions_ = 0, restarted_ = is_far(*counts_, counts_s_, kAny);
        suspicion_ = counts, suspicion_s_ = now_s;
        if (++suspicions_ < kAgreed) return false;
        anew = restarted_;
    }
    const Counts before = counts_.value_or(Counts{});
    Counts moved{};
    for (std::size_t i = 0; i < 2; ++i) {
        if (anew)
            offset_[i] += before[i] - counts[i];
        else
            moved[i] = counts[i] - before[i];
        readings_.joints[wheels_[i]].position =
            static_cast<double>(counts[i] + offset_[i]) * KheperaUnits::kRadians;
    }
    count_on(moved[0], moved[1], now_s);
    counts_ = counts, counts_s_ = now_s;
    suspicions_ = 0, reset_ = false;
    fastest_ = fastest_now();
    return true;
}

/// A speed that no wheel has was falsified on the line.
bool KheperaAdapter::take_speeds(const std::vector<long>& speeds) {
    constexpr long kMost = static_cast<long>(kSlack * KheperaUnits::kMostSpeed);
    for (const long speed : speeds)
        if (speed < -kMost || speed > kMost) return false;
    for (std::size_t i = 0; i < 2; ++i)
        readings_.joints[wheels_[i]].velocity = static_cast<double>(speeds[i]) * KheperaUnits::kSpeed;
    fastest_ = std::max(fastest_, fastest_now());
    return true;
}

/// Odometry: an arc of a circle, by the mean heading.
void KheperaAdapter::count_on(long left, long right, double now_s) {
    PoseReading& pose = readings_.poses[robot_];
    const double ahead = 0.5 * static_cast<double>(left + right) * KheperaUnits::kMetres;
    const double turn = static_cast<double>(right - left) * KheperaUnits::kMetres / KheperaUnits::kAxle;
    const auto about_z = [](double angle) { return Quat{std::cos(angle / 2), 0, 0, std::sin(angle / 2)}; };
    const Vec3 step = rotate(pose.X_WR.q * about_z(turn / 2), Vec3{ahead, 0, 0});
    pose.X_WR = {pose.X_WR.p + step, normalized(pose.X_WR.q * about_z(turn))};
    const double elapsed_s = now_s - counts_s_;
    if (elapsed_s > 1) return;
    pose.linear = (1 / elapsed_s) * step;
    pose.angular = rotate(pose.X_WR.q, Vec3{0, 0, turn / elapsed_s});
}

void KheperaAdapter::note_reboot(const std::string& said, double now_s) {
    acknowledged_.reset();
    asked_ = 0;
    reset_ = true;
    if (now_s - std::exchange(rebooted_s_, now_s) < kAgain_s) return;
    ++count_.reboots;
    notices_.push_back("the khepera started again; it says: " + said);
}

}  // namespace roboss
