// RobotTopics: the topics of ROS 2 that the robots of a world have, and their messages at a tick. What
// records a run and what speaks to ROS 2 nodes take them from here, so that both say the same.
//
// /clock, /tf and /tf_static are of the world. In the namespace of its robot stand joint_states and one topic
// or two for each sensor: "/car_3/scan"; "/car_3/front/scan" where the robot has several sensors with such a
// topic, and always for cameras. A topic or frame that the file gives to a sensor takes its place. Frames are
// "world", "car_3/chassis" for a link, "car_3/chassis/front" for a sensor, "car_3/chassis/eye_optical_frame"
// for images, "car_3/odom" for odometry. Plain frames are "chassis" and "odom"; each robot then has "tf" and
// "tf_static" in its namespace, and its base stands where its odometry sees it.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"
#include "ros2/topic_options.h"
#include "ros2_types/transport.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss::ros2 {

class BridgedTopics;

/// A topic.
struct Topic {
    std::string name;           ///< "/car_3/scan"
    const MessageType* type{};  ///< of its messages
    bool is_latched = false;    ///< who comes later gets the last message, too
    RobotId robot{};            ///< that has it; not valid: the world
};

class FleetTopics;

/// See the top of the file.
class RobotTopics {
  public:
    /// A reading of a sensor (RobotType::sensors) of a robot at the tick of the messages; none: there shall
    /// be no message.
    using Measure = std::function<Result<std::optional<Sample>>(RobotId, std::size_t)>;
    /// Topics of the world, in topics().
    static constexpr std::size_t kClock = 0, kTf = 1, kTfStatic = 2;
    /// A message.
    struct Message {
        std::size_t topic = 0;  ///< number in topics()
        std::string bytes;      ///< CDR
    };

    /// Collects the topics of all robots of a world.
    explicit RobotTopics(std::shared_ptr<const Model> model, const TopicOptions& options = {});
    ~RobotTopics();
    RobotTopics(RobotTopics&&) noexcept;
    RobotTopics& operator=(RobotTopics&&) noexcept;

    /// All topics, in a fixed order: those of the world first.
    const std::vector<Topic>& topics() const { return topics_; }
    /// Entries of TopicOptions::bridge that have no effect in this world, one line each.
    const std::vector<std::string>& bridge_notices() const { return bridge_notices_; }
    /// Sensors that have no messages in ROS 2: "car_3.radio".
    const std::vector<std::string>& left_out() const { return left_out_; }
    /// From now on only these topics have messages; `wanted`: one for each of topics(). At first all have.
    void select(std::vector<bool> wanted);

    /// The messages of latched topics.
    std::vector<Message> latched(Tick tick) const;
    /// The other messages at a tick, with all states by RobotId. A sensor with an `<update_rate>` has them if
    /// a sample is due since the tick of the last call. An Error names a sensor that cannot measure.
    Result<std::vector<Message>> messages(Tick tick, std::span<const RobotState> states,
                                          const Measure& measure);
    /// The run went back in time: all samples are due again.
    void forget() { last_ = before_ = -1; }
    /// The next call of messages() is for the tick of the last one once more.
    void repeat() { last_ = before_; }

  private:
    struct Taken;
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    /// A sensor with messages.
    struct Source {
        RobotId robot;
        std::size_t sensor = 0;
        std::size_t first = 0, count = 0;  // its topics
        std::string frame, optical_frame, odometry_frame;
        Transform X_WO;                          // of an odometry: its frame in the world
        const DriveController* drive = nullptr;  // of an odometry: that of controllers_ whose it is
    };

    /// The names of a robot.
    struct RobotPart {
        std::string name;                                        // in ROS 2
        std::string prefix;                                      // of its frames
        bool is_plain = false;                                   // its frames have no prefix
        std::vector<std::string> frames;                         // by LinkId; the first is the base
        std::vector<JointId> joints;                             // of one axis, that move
        std::size_t joint_states = 0;                            // its topic; 0: none
        std::size_t ground_truth = 0;                            // its topic; 0: none
        std::size_t description = 0;                             // its topic
        std::vector<std::size_t> tf{kTf}, tf_static{kTfStatic};  // topics of its frames
        std::size_t odometry = kNone;                            // its first odometry, in sources_
        bool publishes_base = true;  // in its odometry's frame; false: others say where it is

        bool is_link(const std::string& frame) const {
            return std::ranges::find(frames, frame) != frames.end();
        }
    };

    std::size_t add_topic(const std::string& name, const MessageType& type, bool is_latched, RobotId robot);
    void add_robot(RobotId robot, const std::string& name, const TopicOptions& options, Taken& taken);
    void add_sensors(RobotId robot, Taken& taken);
    void use(const Bridge& bridge);
    void add_fixed_frames(Tick tick, std::vector<Message>& out) const;
    Result<> add_moving_frames(Tick tick, std::span<const RobotState> states, const Measure& measure,
                               std::vector<Message>& out) const;
    void add_robot_messages(Tick tick, RobotId robot, const RobotState& state,
                            std::vector<Message>& out) const;
    bool is_due(const Source& source, Tick tick) const;
    void add_readings(const Source& source, Tick tick, const Sample& sample, std::vector<Message>& out) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const Controllers> controllers_;  // of a file; null: there is none
    std::vector<Topic> topics_;
    std::vector<bool> wanted_;
    std::vector<std::string> left_out_, bridge_notices_;
    std::vector<Source> sources_;
    std::vector<RobotPart> robots_;
    std::unique_ptr<FleetTopics> fleet_;      // null: there are none
    std::shared_ptr<BridgedTopics> bridged_;  // null: there is no bridge's file
    Tick last_ = -1, before_ = -1;            // ticks of the last two calls
};

}  // namespace roboss::ros2
