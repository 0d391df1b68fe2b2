// See device_run.h.
#include "device/device_run.h"

#include <algorithm>
#include <cmath>

#include "client/user_code.h"
#include "core/error_text.h"

namespace roboss {
namespace {

constexpr double kReopen_s = 0.25;   // between attempts to open a broken line
constexpr double kFarewell_s = 0.8;  // for devices to acknowledge that they rest
constexpr double kBraking_s = 0.1;   // then: until their readings say where they stand

std::string text_of(double seconds) {
    const long tenths = std::lround(10 * seconds);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

std::string called(const Model& model, const Device& device) {
    const std::string what = device.robot.valid() ? model.robots[device.robot.index()].name : "the camera";
    return what + " (" + device.adapter->protocol() + " at " + device.address + ")";
}

}  // namespace

DeviceRun::DeviceRun(std::shared_ptr<const Model> model, std::vector<ConnectedDevice> devices,
                     std::unique_ptr<ControlProgram> program, const DeviceRunOptions& options)
    : model_(std::move(model)), program_(std::move(program)), o_(options) {
    for (ConnectedDevice& each : devices) {
        devices_.push_back({std::move(each.adapter), each.line->address(), each.robot});
        const bool is_camera = !each.robot.valid();
        const OnSilence chosen =
            is_camera && each.on_silence == OnSilence::kStopThis ? OnSilence::kStopAll : each.on_silence;
        connections_.push_back({std::move(each.line), false, kNever, {}, chosen, kNever});
    }
    client_ = std::make_unique<DeviceClient>(model_, devices_, o_.seed);
}

void DeviceRun::advance(double now_s) {
    if (phase_ == Phase::kOver) return;
    if (entered_s_ == kNever) entered_s_ = now_s;
    for (std::size_t i = 0; i < devices_.size(); ++i) serve(i, now_s);
    const double elapsed_s = now_s - std::exchange(last_s_, now_s);
    if (phase_ == Phase::kDriving) count_.driven_s += elapsed_s;
    if (stop_wanted_ && phase_ != Phase::kStopping) enter(Phase::kStopping, now_s);

    watch_silence(now_s);
    const Device* silent = waited_for(now_s);
    const double waited_s = now_s - entered_s_;
    switch (phase_) {
        case Phase::kConnecting:
        case Phase::kSilent:
            if (silent == nullptr) {
                notices_.push_back(phase_ == Phase::kSilent
                                       ? "the robots are driven again after " + text_of(waited_s) + " [back]"
                                       : "all devices answer; the program drives [driving]");
                enter(Phase::kDriving, now_s);
            } else if (waited_s > o_.give_up_s) {
                fail({called(*model_, *silent) + " gave no readings for " + text_of(waited_s),
                      "check its power, its line and its protocol; --give-up sets this time", "device-lost"},
                     now_s);
            }
            break;
        case Phase::kDriving:
            if (silent != nullptr)
                enter(Phase::kSilent, now_s);
            else
                drive(now_s);
            break;
        case Phase::kStopping: {
            if (!stand(now_s) && waited_s < kFarewell_s) break;
            tell_unstopped(now_s);
            return enter(Phase::kOver, now_s);
        }
        case Phase::kOver:
            break;
    }
}

/// Whether all robots have stopped, and said where.
bool DeviceRun::stand(double now_s) {
    const auto each = [&](auto&& is) {
        return std::ranges::all_of(devices_,
                                   [&](const Device& d) { return !d.robot.valid() || is(*d.adapter); });
    };
    const bool all_rest = each([](const DeviceAdapter& adapter) { return adapter.at_rest(); });
    if (!all_rest || rested_s_ == kNever) rested_s_ = all_rest ? now_s : kNever;
    return all_rest && each([&](const DeviceAdapter& adapter) {
               return adapter.readings().fresh_s >= rested_s_ + kBraking_s;
           });
}

/// Reads and writes the line; opens it again if it broke.
void DeviceRun::serve(std::size_t i, double now_s) {
    Connection& connection = connections_[i];
    DeviceAdapter& adapter = *devices_[i].adapter;
    if (connection.broken) {
        if (now_s - connection.tried_s < kReopen_s) return;
        connection.tried_s = now_s;
        if (Result<> open = connection.line->reopen(); !open) return note_trouble(i, open.error());
        connection.broken = false;
        connection.trouble.clear();
        adapter.line_renewed();
        notices_.push_back("the line " + devices_[i].address + " is open again");
    }
    Result<std::vector<std::string>> pieces = connection.line->receive();
    if (!pieces) {
        connection.broken = true;
        return note_trouble(i, pieces.error());
    }
    for (const std::string& piece : pieces.value()) adapter.receive(piece, now_s);
    for (std::string& notice : adapter.take_notices())
        notices_.push_back(called(*model_, devices_[i]) + ": " + notice);
    for (const std::string& bytes : adapter.due(now_s))
        if (Result<> sent = connection.line->send(bytes); !sent) {
            connection.broken = true;
            return note_trouble(i, sent.error());
        }
}

void DeviceRun::note_trouble(std::size_t i, const Error& why) {
    if (connections_[i].trouble == why.message) return;
    connections_[i].trouble = why.message;
    notices_.push_back(why.text());
}

bool DeviceRun::is_old(std::size_t i, double now_s) const {
    return now_s - devices_[i].adapter->readings().fresh_s > o_.max_age_s;
}

/// One without which nothing is driven; null: there is none. All devices are waited for at the begin.
const Device* DeviceRun::waited_for(double now_s) const {
    for (std::size_t i = 0; i < devices_.size(); ++i)
        if (is_old(i, now_s) &&
            (phase_ == Phase::kConnecting || connections_[i].on_silence == OnSilence::kStopAll))
            return &devices_[i];
    return nullptr;
}

/// Notes which devices became silent or answer again, once they were driven.
void DeviceRun::watch_silence(double now_s) {
    if (phase_ != Phase::kDriving && phase_ != Phase::kSilent) return;
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        Connection& connection = connections_[i];
        const bool old = is_old(i, now_s);
        if (old == (connection.silent_s != kNever)) continue;
        const std::string who = called(*model_, devices_[i]);
        if (old) {
            ++count_.losses;
            connection.silent_s = now_s;
            const char* const then[] = {"the robots rest until it answers",
                                        "it rests until it answers; the others go on",
                                        "the program goes on with its last readings"};
            notices_.push_back(who + " is silent; " + then[static_cast<int>(connection.on_silence)] +
                               " [lost]");
        } else {
            const double lost_s = now_s - std::exchange(connection.silent_s, kNever);
            notices_.push_back(who + " answers again after " + text_of(lost_s) + " [back]");
        }
        if (connection.on_silence == OnSilence::kStopThis && phase_ == Phase::kDriving)
            devices_[i].adapter->rest(old);
    }
}

/// Names the robots that may still move at the end.
void DeviceRun::tell_unstopped(double now_s) {
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        const Device& device = devices_[i];
        if (!device.robot.valid() || device.adapter->at_rest()) continue;
        const std::string who = called(*model_, device);
        const double fresh_s = device.adapter->readings().fresh_s;
        if (fresh_s == kNever && begin_s_ == kNever)
            notices_.push_back(who + " never answered; it got no order but to stop [unstopped]");
        else if (is_old(i, now_s))
            notices_.push_back(
                who + " has been silent for " + text_of(now_s - fresh_s) +
                " and did not acknowledge that it stops: look whether it still moves [unstopped]");
        else
            notices_.push_back(who +
                               " did not acknowledge that it stops: look whether it still moves [unstopped]");
    }
}

void DeviceRun::enter(Phase phase, double now_s) {
    phase_ = phase;
    entered_s_ = now_s;
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        const Connection& connection = connections_[i];
        const bool alone = connection.on_silence == OnSilence::kStopThis && connection.silent_s != kNever;
        devices_[i].adapter->rest(phase != Phase::kDriving || alone);
    }
    if (phase != Phase::kDriving) return;
    if (begin_s_ == kNever) begin_s_ = now_s;
    due_ = (reached(now_s) + o_.period - 1) / o_.period * o_.period;  // periods of silence are not late
}

/// The last tick that has begun by the wall clock.
Tick DeviceRun::reached(double now_s) const {
    return static_cast<Tick>(std::floor((now_s - begin_s_) / model_->dt_s + 1e-6));
}

void DeviceRun::drive(double now_s) {
    if (o_.duration_s > 0 && now_s - begin_s_ >= o_.duration_s) return enter(Phase::kStopping, now_s);
    if (reached(now_s) < due_) return;
    const Tick skipped = (reached(now_s) - due_) / o_.period;
    count_.late += static_cast<std::uint64_t>(skipped);
    const Tick tick = due_ + skipped * o_.period;
    due_ = tick + o_.period;
    client_->observe(tick);
    if (!started_) {
        started_ = true;
        if (!guarded("start()", now_s, [&] { program_->start(*client_); })) return;
    }
    ++count_.calls;
    guarded("control()", now_s, [&] { program_->control(*client_); });
}

template <class Call>
bool DeviceRun::guarded(const char* what, double now_s, Call&& call) {
    const UserCode mark(o_.name, what);
    std::string why = "an object that is not a std::exception";
    try {
        call();
        return true;
    } catch (const std::exception& e) {
        why = e.what();
    } catch (...) {
    }
    fail(error_of_text(std::string(what) + " threw: ", why, "fix the control program", "client-failed"),
         now_s);
    return false;
}

void DeviceRun::fail(Error error, double now_s) {
    failure_ = std::move(error);
    enter(Phase::kStopping, now_s);
}

std::vector<std::string> DeviceRun::take_notices() {
    for (std::string& refusal : client_->take_refusals()) notices_.push_back(std::move(refusal));
    return std::exchange(notices_, {});
}

}  // namespace roboss
