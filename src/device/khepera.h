// The serial protocol of K-Team's Khepera and Khepera II. The host sends a command, a capital letter with
// numbers, and the robot answers with the same letter in lower case: "D,5,-5" -> "d", "N" -> "n,12,...".
// Source: K-Team, "Khepera II User Manual" 1.1 (2002), appendix A.
#pragma once

#include <array>

#include "device/adapter.h"

namespace roboss {

/// Numbers of the manual. A pulse is 1/600 turn of a wheel, 0.08 mm; a unit of speed is a pulse in 10 ms, 8
/// mm/s.
struct KheperaUnits {
    static constexpr double kRadians = 2 * kPi / 600;  ///< of a pulse
    static constexpr double kSpeed = 100 * kRadians;   ///< rad/s, of a unit of speed
    static constexpr double kMetres = 0.08e-3;         ///< of a pulse
    static constexpr double kAxle = 0.053;             ///< m, between the wheels
    static constexpr int kMostSpeed = 127;             ///< units
};

/// Drives the joints "left" and "right" and reads eight infrared sensors, in the order of the file.
class KheperaAdapter final : public DeviceAdapter {
  public:
    /// An Error: the robot lacks a joint or a sensor.
    static Result<std::unique_ptr<DeviceAdapter>> create(const Model& model, RobotId robot);

    const char* protocol() const override { return "khepera"; }
    void receive(std::string_view bytes, double now_s) override;
    std::vector<std::string> due(double now_s) override;
    Result<> order(const Action& action) override;
    void rest(bool resting) override { resting_ = resting; }
    bool at_rest() const override { return resting_ && acknowledged_ == Speeds{}; }
    void line_renewed() override;

  private:
    using Speeds = std::array<int, 2>;
    using Counts = std::array<long, 2>;

    KheperaAdapter(const RobotType& type, RobotId robot, Pose X_WR);
    Speeds wanted() const { return resting_ ? Speeds{} : ordered_; }
    char next_question(double now_s) const;
    void take_line(const std::string& line, double now_s);
    bool take_numbers(char letter, const std::vector<long>& numbers, double now_s);
    bool take_proximity(const std::vector<long>& values, double now_s);
    bool take_counts(const Counts& counts, double now_s);
    double fastest_now() const;
    bool take_speeds(const std::vector<long>& speeds);
    void count_on(long left, long right, double now_s);
    void note_reboot(const std::string& said, double now_s);

    const RobotType& type_;
    RobotId robot_;
    std::array<JointId, 2> wheels_;
    std::vector<std::size_t> sensors_;
    Speeds ordered_{};
    std::optional<Speeds> acknowledged_;  // that the robot drives; none while that is open
    bool resting_ = true;
    Speeds sent_{};         // with the last D
    char asked_ = 0;        // that is to be answered
    std::size_t turn_ = 0;  // in the round of questions
    double asked_s_ = kNever, set_s_ = kNever, proximity_s_ = kNever, counts_s_ = kNever;
    double rebooted_s_ = kNever, suspicion_s_ = kNever;
    std::optional<Counts> counts_;  // of pulses, that were believed last
    Counts suspicion_{};            // that jumped: believed if the next ones agree
    int suspicions_ = 0;            // number of successive counts that agree
    bool restarted_ = false;        // the first of these is out of a wheel's reach
    double fastest_ = 0;            // pulses in 10 ms, since the counts that were believed last
    Counts offset_{};               // of the joints' positions, in pulses: a reboot sets counts to zero
    bool reset_ = false;            // the next counts start from zero
    std::string part_;              // of a line
};

}  // namespace roboss
