// DeviceAdapter: what a protocol makes of a line to a real robot: readings in, commands out. It owns no clock
// and no line: bytes and times are handed to it, so a test plays hours of line noise in a moment.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "model/model.h"
#include "model/order.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss {

inline constexpr double kNever = -1e300;  ///< s, time of what has not happened

/// What an encoder says of a joint with one axis.
struct JointReading {
    double position = 0,           ///< rad or m
        velocity = 0;              ///< rad/s or m/s
    std::optional<double> effort;  ///< N m or N, if the device measures it
};

/// Where a robot (SDF model) frame is.
struct PoseReading {
    Pose X_WR;               ///< in the world
    Vec3 linear,             ///< m/s, of the base's origin, world axes
        angular;             ///< rad/s, world axes
    bool estimated = false;  ///< by counting wheel turns: good enough for a twin, not for a program
};

/// What a device said last.
struct DeviceReadings {
    std::map<JointId, JointReading> joints;  ///< of its robot's type
    std::map<std::size_t, Sample> sensors;   ///< by index into RobotType::sensors
    std::map<RobotId, PoseReading> poses;    ///< of any robot of the world
    double fresh_s = kNever;  ///< all that the device measures again and again is as new as this
};

/// What happened on the line so far.
struct LineCount {
    std::uint64_t taken = 0,  ///< packets or lines that were read
        lost = 0,             ///< packets that never came, replies that were waited for in vain
        stale = 0,            ///< packets that came late or twice, and were dropped
        damaged = 0,          ///< what could not be read
        reboots = 0;          ///< of the device
};

/// One protocol on one line. See the top of the file; `now_s` never goes back.
class DeviceAdapter {
  public:
    virtual ~DeviceAdapter() = default;
    /// The protocol: "khepera".
    virtual const char* protocol() const = 0;
    /// Takes bytes of a serial line, in pieces of any size, or one datagram.
    virtual void receive(std::string_view bytes, double now_s) = 0;
    /// What is to be sent now, one string for each write.
    virtual std::vector<std::string> due(double now_s) = 0;
    /// Latches an order for its robot, which check_order() has accepted. An Error says what the device cannot
    /// do.
    virtual Result<> order(const Action& action) = 0;
    /// While it rests, the device gets the command to stop, whatever was ordered; then the orders hold again.
    virtual void rest(bool resting) = 0;
    /// Whether the device has acknowledged that it rests.
    virtual bool at_rest() const = 0;
    /// The line was closed and opened again: half a message is dropped.
    virtual void line_renewed() = 0;

    const DeviceReadings& readings() const { return readings_; }
    const LineCount& count() const { return count_; }
    /// What a person should know, since the last call.
    std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }

  protected:
    DeviceReadings readings_;
    LineCount count_;
    std::vector<std::string> notices_;
};

/// The adapter for a protocol, "khepera" or "joints", and a robot of the model. `robot` not valid: a camera
/// that gives poses only (joints). Errors: "no-protocol"; the robot has not what the protocol drives.
Result<std::unique_ptr<DeviceAdapter>> make_adapter(const std::string& protocol, const Model& model,
                                                    RobotId robot);

}  // namespace roboss
