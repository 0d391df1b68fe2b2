// The protocol `joints`: JSON datagrams for any robot (docs/devices.md). Each packet carries all setpoints or
// all readings, so one that is lost, late or doubled does no harm; the device stops by itself when none come.
#pragma once

#include "device/adapter.h"

namespace roboss {

inline constexpr int kJointsVersion = 1;  ///< "roboss" in each packet

/// Speaks `joints` for a robot; without one it only listens to a camera's poses.
class JointsAdapter final : public DeviceAdapter {
  public:
    /// `session`: another number for each JointsAdapter, so that the device knows a new one.
    JointsAdapter(const Model& model, RobotId robot, std::uint32_t session);

    const char* protocol() const override { return "joints"; }
    void receive(std::string_view bytes, double now_s) override;
    std::vector<std::string> due(double now_s) override;
    Result<> order(const Action& action) override;
    void rest(bool resting) override;
    bool at_rest() const override { return resting_ && !is_changed_ && acknowledged_ >= changed_; }
    void line_renewed() override {}

  private:
    struct Setpoint {
        MotorMode mode = MotorMode::kPassive;
        double target = 0, max_effort = -1;
        friend bool operator==(const Setpoint&, const Setpoint&) = default;
    };
    /// What a packet says, once it is known to be whole.
    struct Packet {
        std::uint64_t boot = 0, number = 0, acknowledged = 0;
        double stamp_s = 0;
        DeviceReadings readings;
        std::map<RobotId, bool> has_velocity;  // of its poses
        std::optional<std::vector<std::string>> commands;
    };

    /// Why the packet is none; nullopt: it is one.
    std::optional<std::string> read(std::string_view bytes, Packet& packet) const;
    void take(Packet packet, double now_s);
    bool is_new(const Packet& packet, double now_s);
    void note_once(const std::string& text);
    std::string packet();

    const Model& model_;
    RobotId robot_;
    std::uint32_t session_;
    bool resting_ = true;
    std::map<JointId, Setpoint> setpoints_;
    std::map<std::uint32_t, std::vector<double>> commands_;  // by channel
    std::vector<std::string> taken_commands_;                // names that the device takes
    std::vector<std::uint64_t> boots_;                       // of the device, the last is now
    std::uint64_t heard_ = 0;                                // number of the last packet of this boot
    double stamp_s_ = 0;                                     // of the last packet, by the device's clock
    std::uint64_t sent_ = 0, acknowledged_ = 0;              // packets to the device
    std::uint64_t changed_ = 1;  // number of the packet that first said what is now
    bool is_changed_ = true;
    double sent_s_ = kNever, rebooted_s_ = kNever;
    std::vector<std::string> noted_;
};

}  // namespace roboss
