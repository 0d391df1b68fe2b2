// DeviceRun: a control program and its devices in real time. It owns no clock: advance() is called with the
// time, every millisecond or so.
#pragma once

#include "client/bus_client.h"
#include "client/control_program.h"
#include "device/device_client.h"
#include "device/line.h"

namespace roboss {

/// A device on its line.
struct ConnectedDevice {
    std::unique_ptr<DeviceLine> line;
    std::unique_ptr<DeviceAdapter> adapter;
    RobotId robot;  ///< that it is; not valid: a camera
};

struct DeviceRunOptions {
    std::string name = "device";  ///< of the program, for messages
    Tick period = 1;              ///< between two calls of control()
    double max_age_s = 0.5;       ///< of readings: older ones stop the robots until there are new ones
    double give_up_s = 10;        ///< without new readings the run ends
    double duration_s = 0;        ///< of driving; 0: until stop()
    std::uint64_t seed = 0;       ///< Client::seed()
};

class DeviceRun {
  public:
    /// Where the run is.
    enum class Phase {
        kConnecting,  ///< no readings of some device yet -> kDriving, or kStopping when it gives up
        kDriving,     ///< control() is called once a period -> kSilent, kStopping
        kSilent,      ///< readings of some device are too old, all robots rest -> kDriving, kStopping
        kStopping,    ///< the robots are told to rest -> kOver, when all have said so or do not answer
        kOver         ///< nothing more is sent
    };
    /// What happened so far.
    struct Count {
        std::uint64_t calls = 0,  ///< of control()
            late = 0;  ///< periods in which it was not called, because the one before took too long
        std::uint64_t losses = 0;  ///< times in kSilent
        double driven_s = 0;       ///< in kDriving
    };

    DeviceRun(std::shared_ptr<const Model> model, std::vector<ConnectedDevice> devices,
              std::unique_ptr<ControlProgram> program, const DeviceRunOptions& options);

    void advance(double now_s);
    /// Ends it: the robots rest first.
    void stop() { stop_wanted_ = true; }
    Phase phase() const { return phase_; }
    /// Why it ended, if it failed: "client-failed", "device-lost".
    const std::optional<Error>& failure() const { return failure_; }
    std::vector<std::string> take_notices();
    const Count& count() const { return count_; }
    std::span<const Device> devices() const { return devices_; }
    DeviceClient& client() { return *client_; }

  private:
    /// A line that breaks is opened again now and then.
    struct Connection {
        std::unique_ptr<DeviceLine> line;
        bool broken = false;
        double tried_s = kNever;
        std::string trouble;  // that was reported
    };

    void serve(std::size_t i, double now_s);
    void note_trouble(std::size_t i, const Error& why);
    const Device* oldest(double now_s) const;
    void enter(Phase phase, double now_s);
    void drive(double now_s);
    Tick reached(double now_s) const;
    void fail(Error error, double now_s);
    template <class Call>
    bool guarded(const char* what, double now_s, Call&& call);

    std::shared_ptr<const Model> model_;
    std::unique_ptr<ControlProgram> program_;
    DeviceRunOptions o_;
    std::vector<Device> devices_;
    std::vector<Connection> connections_;
    std::unique_ptr<DeviceClient> client_;
    Phase phase_ = Phase::kConnecting;
    bool started_ = false, stop_wanted_ = false;
    double entered_s_ = kNever;  // this phase
    double begin_s_ = kNever;    // tick 0
    double last_s_ = kNever;     // of advance()
    Tick due_ = 0;               // the next observation
    Count count_;
    std::optional<Error> failure_;
    std::vector<std::string> notices_;
};

}  // namespace roboss
