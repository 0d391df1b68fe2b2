// A node that drives all robots of a fleet at 10 Hz and reads their scans, odometry and joint states. It
// prints how many robots moved and after what time, waits for the last one at most PATIENCE seconds, then
// counts for SECONDS and prints the rates of what arrived: two lines of JSON.
// Usage: roboss-fleet-peer ROBOTS SECONDS PATIENCE
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "ros2_types/cdr.h"
#include "ros2_types/message_type.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/sensor_messages.h"
#include "ros2_types/open_transport.h"

namespace {

using namespace roboss;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class FleetPeer {
  public:
    FleetPeer(ros2::Transport& transport, std::size_t robots)
        : transport_(transport), node_(transport.add_node("/", "fleet")), moved_(robots, false) {
        for (std::size_t robot = 0; robot < robots; ++robot) {
            const std::string space = "/turtle_" + std::to_string(robot) + "/";
            commands_.push_back(
                transport_.add_publisher(node_, space + "cmd_vel", ros2::type_of<ros2::TwistMessage>(), {})
                    .value());
            subscribe<ros2::LaserScan>(space + "scan", "scan");
            odometry_[subscribe<ros2::Odometry>(space + "odom", "odom")] = robot;
            subscribe<ros2::JointStateMessage>(space + "joint_states", "joint_states");
        }
        transport_.announce();
    }

    void await_all(double patience_s) {
        const Clock::time_point start = Clock::now();
        turn([&] { return !have_all_moved() && seconds_since(start) < patience_s; });
        std::printf("{\"moved\": %zu, \"moved_after_s\": %.1f}\n",
                    static_cast<std::size_t>(std::count(moved_.begin(), moved_.end(), true)),
                    seconds_since(start));
        std::fflush(stdout);
    }

    void count(double duration_s) {
        counts_.clear();
        const Clock::time_point start = Clock::now();
        const double first_s = newest_s_;
        turn([&] { return seconds_since(start) < duration_s; });
        std::printf("{\"real_time_factor\": %.2f", (newest_s_ - first_s) / duration_s);
        for (const auto& [kind, count] : counts_)
            std::printf(", \"%s_hz\": %.2f", kind.c_str(),
                        static_cast<double>(count) / duration_s / static_cast<double>(moved_.size()));
        std::printf("}\n");
    }

  private:
    template <ros2::Message M>
    ros2::EntityId subscribe(const std::string& topic, const char* kind) {
        const ros2::EntityId id = transport_.add_subscription(node_, topic, ros2::type_of<M>(), {}).value();
        kinds_[id] = kind;
        return id;
    }

    bool have_all_moved() const { return std::count(moved_.begin(), moved_.end(), false) == 0; }

    template <class Condition>
    void turn(Condition condition) {
        while (condition()) {
            if (Clock::now() >= next_) {
                drive();
                next_ =
                    std::max(next_, Clock::now() - std::chrono::seconds(1)) + std::chrono::milliseconds(100);
            }
            for (const ros2::Incoming& message : transport_.take(20)) take(message);
        }
    }

    void drive() {
        const std::string order = ros2::to_cdr(ros2::TwistMessage{{0.1, 0, 0}, {0, 0, 0.2}});
        for (const ros2::EntityId command : commands_) transport_.publish(command, order);
    }

    void take(const ros2::Incoming& message) {
        ++counts_[kinds_.at(message.entity)];
        const auto robot = odometry_.find(message.entity);
        if (robot == odometry_.end()) return;
        const Result<ros2::Odometry> odometry = ros2::from_cdr<ros2::Odometry>(message.bytes);
        if (!odometry) return;
        const ros2::Time& stamp = odometry.value().header.stamp;
        newest_s_ = std::max(newest_s_, stamp.sec + 1e-9 * stamp.nanosec);
        if (odometry.value().twist.twist.linear.x < 0.02) return;
        moved_[robot->second] = true;
    }

    ros2::Transport& transport_;
    ros2::EntityId node_;
    std::vector<ros2::EntityId> commands_;
    std::map<ros2::EntityId, std::string> kinds_;
    std::map<ros2::EntityId, std::size_t> odometry_;  // robots
    std::map<std::string, std::size_t> counts_;
    std::vector<bool> moved_;
    double newest_s_ = 0;                    // stamp, simulated
    Clock::time_point next_ = Clock::now();  // order
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return std::fprintf(stderr, "usage: roboss-fleet-peer ROBOTS SECONDS PATIENCE\n"), 2;
    Result<std::unique_ptr<ros2::Transport>> transport = ros2::open_transport({});
    if (!transport) return std::fprintf(stderr, "%s\n", transport.error().text().c_str()), 1;
    FleetPeer peer(*transport.value(), static_cast<std::size_t>(std::atol(argv[1])));
    peer.await_all(std::atof(argv[3]));
    peer.count(std::atof(argv[2]));
    return 0;
}
