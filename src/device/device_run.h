// DeviceRun: a control program and its devices in real time. It owns no clock: advance() is called with the
// time, every millisecond or so.
#pragma once

#include "client/bus_client.h"
#include "client/control_program.h"
#include "device/device_client.h"
#include "device/line.h"

namespace roboss {

/// What happens while the readings of a device are too old.
enum class OnSilence {
    kStopAll,   ///< all robots rest, and control() is not called
    kStopThis,  ///< this robot rests; the program drives the others. Of a camera: as kStopAll
    kGoOn       ///< nothing: the program has its last readings
};

/// A device on its line.
struct ConnectedDevice {
    std::unique_ptr<DeviceLine> line;
    std::unique_ptr<DeviceAdapter> adapter;
    RobotId robot;  ///< that it is; not valid: a camera
    OnSilence on_silence = OnSilence::kStopAll;
};

struct DeviceRunOptions {
    std::string name = "device";  ///< of the program, for messages
    Tick period = 1;              ///< between two calls of control()
    double max_age_s = 0.5;       ///< of readings: with older ones a device is silent
    double give_up_s = 10;        ///< without first readings, or all robots resting for so long, it ends
    double duration_s = 0;        ///< of driving; 0: until stop()
    std::uint64_t seed = 0;       ///< Client::seed()
};

class DeviceRun {
  public:
    /// Where the run is.
    enum class Phase {
        kConnecting,  ///< no readings of some device yet -> kDriving, or kStopping when it gives up
        kDriving,     ///< control() is called once a period -> kSilent, kStopping
        kSilent,      ///< a device of kStopAll is silent, all robots rest -> kDriving, kStopping
        kStopping,    ///< the robots are told to rest -> kOver, when all have said so or do not answer
        kOver         ///< nothing more is sent
    };
    /// What happened so far.
    struct Count {
        std::uint64_t calls = 0,  ///< of control()
            late = 0;  ///< periods in which it was not called, because the one before took too long
        std::uint64_t losses = 0;  ///< times that a device became silent while it was driven
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
        OnSilence on_silence = OnSilence::kStopAll;
        double silent_s = kNever;  // since when its readings are too old, once it was driven
    };

    bool stand(double now_s);
    void serve(std::size_t i, double now_s);
    void note_trouble(std::size_t i, const Error& why);
    bool is_old(std::size_t i, double now_s) const;
    const Device* waited_for(double now_s) const;
    void watch_silence(double now_s);
    void tell_unstopped(double now_s);
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
    double rested_s_ = kNever;   // since then all devices say that they rest
    double begin_s_ = kNever;    // tick 0
    double last_s_ = kNever;     // of advance()
    Tick due_ = 0;               // the next observation
    Count count_;
    std::optional<Error> failure_;
    std::vector<std::string> notices_;
};

}  // namespace roboss
