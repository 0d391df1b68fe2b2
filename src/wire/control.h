// Requests to the run itself (pause, rewind, add ...) and their replies, as plain data. The text forms, for
// command lines and web pages, are in client/control_text.h.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"
#include "core/types.h"
#include "math/box32.h"
#include "math/pose.h"
#include "model/copy_place.h"

namespace roboss {

// --- requests. Those that change nothing:
/// Asks for RunStatus.
struct GetStatus {
    bool robots = false;  // with the names of all robots, which are many
    /// Compares all members.
    friend bool operator==(const GetStatus&, const GetStatus&) = default;
};
/// Asks for RobotGroups.
struct GetGroups {
    /// Compares all members.
    friend bool operator==(const GetGroups&, const GetGroups&) = default;
};
/// Asks for RobotBounds.
struct GetBounds {
    /// Compares all members.
    friend bool operator==(const GetBounds&, const GetBounds&) = default;
};
/// Asks for RunProfile. The run measures its steps for a few seconds from then on, which costs some per cent.
struct GetProfile {
    /// Compares all members.
    friend bool operator==(const GetProfile&, const GetProfile&) = default;
};

/// Asks for RunTimeline: the branches and bookmarks of the journal.
struct GetTimeline {
    /// Compares all members.
    friend bool operator==(const GetTimeline&, const GetTimeline&) = default;
};
/// Asks for RunPreview: what the world looked like at an earlier time of the journal. The run goes on
/// meanwhile. Of one requester the newest request counts.
struct PreviewRun {
    std::int64_t branch = 0;  ///< of the journal; 0: the current one
    double time_s = 0;        ///< at least 0
    /// The reply comes after this time at the latest, with the nearest earlier moment that was reached
    /// (RunPreview::exact is false then); the next request for the same time continues from there. 0 to
    /// 10000 ms.
    std::uint32_t patience_ms = 100;
    /// Compares all members.
    friend bool operator==(const PreviewRun&, const PreviewRun&) = default;
};

// --- requests that do not change the result:
/// Names a moment of the journal.
struct AddBookmark {
    std::string name;         ///< for people, at most 200 bytes
    std::int64_t branch = 0;  ///< of the journal; 0: the current one
    double time_s = -1;       ///< negative: the present
    /// Compares all members.
    friend bool operator==(const AddBookmark&, const AddBookmark&) = default;
};
/// Removes a bookmark from the journal.
struct RemoveBookmark {
    std::int64_t id = 0;  ///< Bookmark::id
    /// Compares all members.
    friend bool operator==(const RemoveBookmark&, const RemoveBookmark&) = default;
};
/// Pauses at the end of the current window.
struct PauseRun {
    /// Compares all members.
    friend bool operator==(const PauseRun&, const PauseRun&) = default;
};
/// Continues a paused run.
struct ResumeRun {
    /// Compares all members.
    friend bool operator==(const ResumeRun&, const ResumeRun&) = default;
};
/// Advances by this many ticks, then pauses.
struct StepRun {
    Tick ticks = 1;  ///< at least 1
    /// Compares all members.
    friend bool operator==(const StepRun&, const StepRun&) = default;
};
/// The slowest and the fastest speed that can be wanted, simulated seconds per real second.
inline constexpr double kSlowest = 1e-3, kFastest = 1e6;
/// Sets the wanted speed.
struct SetSpeed {
    /// How the speed is given.
    enum class Kind : std::uint8_t {
        kFactor,  ///< by `factor`
        kMax,     ///< as fast as possible
        kWorld,   ///< as the world file says
    };
    Kind kind = Kind::kFactor;  ///< which of them
    double factor = 1;          ///< simulated seconds per real second, kSlowest to kFastest; of kFactor
    /// Compares all members.
    friend bool operator==(const SetSpeed&, const SetSpeed&) = default;
};
/// Sets the synchronization interval.
struct SetWindow {
    Tick ticks = 0;  // 0: adaptive
    /// Compares all members.
    friend bool operator==(const SetWindow&, const SetWindow&) = default;
};
/// Starts one more Simulator.
struct AddSimulator {
    /// Compares all members.
    friend bool operator==(const AddSimulator&, const AddSimulator&) = default;
};
/// Makes a Simulator leave; refused if it is the only one.
struct RemoveSimulator {
    /// Compares all members.
    friend bool operator==(const RemoveSimulator&, const RemoveSimulator&) = default;
};
/// Kills a Simulator process that the run started, to watch the run recover.
struct KillSimulator {
    std::uint32_t id = 0;  // MemberStatus::id
    /// Compares all members.
    friend bool operator==(const KillSimulator&, const KillSimulator&) = default;
};
/// Saves the run to a file below the folder that the run allows (`--save-folder`).
struct SaveRun {
    std::string file;        ///< on the Controller's computer, from that folder on
    bool overwrite = false;  ///< an existing file may be replaced; else that is refused [file-exists]
    /// Compares all members.
    friend bool operator==(const SaveRun&, const SaveRun&) = default;
};
/// Ends the run as if its duration were over.
struct QuitRun {
    /// Compares all members.
    friend bool operator==(const QuitRun&, const QuitRun&) = default;
};

// --- requests that change the world at a tick. With a journal each starts a new branch:
/// Continues from an earlier time of the journal, in a new branch.
struct RewindRun {
    std::int64_t branch = 0;  // of the journal; 0: the current one
    double time_s = 0;        // >= 0
    /// Compares all members.
    friend bool operator==(const RewindRun&, const RewindRun&) = default;
};
/// Continues from the world's beginning (the world file as it was loaded, at tick 0) or from the last save.
struct ResetRun {
    /// Where the run returns to.
    enum class To : std::uint8_t {
        kStart,     ///< the world's beginning
        kLastSave,  ///< the last SaveRun of this run, else the state that it was started from (`--from`)
    };
    To to = To::kStart;  ///< which of them
    /// Compares all members.
    friend bool operator==(const ResetRun&, const ResetRun&) = default;
};
/// Changes the numbers of <roboss:accuracy>.
struct ChangeAccuracy {
    /// A number by its name.
    struct Number {
        std::string name;  ///< as in <roboss:accuracy>
        double value = 0;  ///< in its range
        /// Compares all members.
        friend bool operator==(const Number&, const Number&) = default;
    };
    std::string setting;          // "fast", "standard", "high"; empty: as it is
    std::vector<Number> numbers;  ///< besides the setting
    /// Compares all members.
    friend bool operator==(const ChangeAccuracy&, const ChangeAccuracy&) = default;
};
/// Adds the models of an SDF or URDF file, once or many times: all of them or none. The request carries the
/// content, since the file may be on another computer; files that it refers to are looked up on the
/// Controller's.
struct AddModels {
    std::string file;     ///< its name, for messages
    std::string content;  ///< SDF or URDF
    Pose X_WA;            // of the file's world frame
    std::string name;     // in the world; empty: the name in the file
    /// If there are any: a copy at each, instead of one at X_WA by `name`.
    std::vector<CopyPlace> copies{};
    bool on_ground = false;  ///< they are stood on the scenery below their places
    /// Compares all members.
    friend bool operator==(const AddModels&, const AddModels&) = default;
};
/// Removes robots by name.
struct RemoveRobots {
    std::vector<std::string> names;  ///< in the world
    /// Compares all members.
    friend bool operator==(const RemoveRobots&, const RemoveRobots&) = default;
};
/// Adds copies of robots of the world: all of them or none. A copy has the joint positions that the original
/// has at that tick; else it is as at the start, and at rest.
struct CopyRobots {
    /// One copy.
    struct Copy {
        std::string robot;  ///< the original, by its name in the world
        std::string name;   ///< of the copy; not taken
        Pose X_WR;          ///< m, of the copy's robot (SDF model) frame in the world
        /// Compares all members.
        friend bool operator==(const Copy&, const Copy&) = default;
    };
    std::vector<Copy> copies;  ///< at least one
    /// Compares all members.
    friend bool operator==(const CopyRobots&, const CopyRobots&) = default;
};
/// Brings back robots that were removed in this run, each in the state in which it was removed last. The run
/// keeps the last 10'000 of them.
struct RestoreRobots {
    std::vector<std::string> names;  ///< that they had
    /// Compares all members.
    friend bool operator==(const RestoreRobots&, const RestoreRobots&) = default;
};

/// A request to the run.
using ControlAction =
    std::variant<GetStatus, GetGroups, GetBounds, PauseRun, ResumeRun, StepRun, SetSpeed, SetWindow,
                 AddSimulator, RemoveSimulator, KillSimulator, SaveRun, QuitRun, RewindRun, ChangeAccuracy,
                 AddModels, RemoveRobots, ResetRun, GetTimeline, PreviewRun, AddBookmark, RemoveBookmark,
                 CopyRobots, RestoreRobots, GetProfile>;

/// The request's name on the command line: "pause", "step" ...
const char* control_verb(const ControlAction& action);
/// The request only asks; it is not logged.
bool only_asks(const ControlAction& action);
/// Why a request is invalid, whatever the run; null: it is valid.
const char* broken_rule(const ControlAction& action);

// --- replies
/// Messages and bytes per second to and from the Controller.
struct MessageRate {
    double messages_in = 0;   ///< to the Controller
    double messages_out = 0;  ///< from the Controller
    double bytes_in = 0;      ///< to the Controller
    double bytes_out = 0;     ///< from the Controller
    /// Compares all members.
    friend bool operator==(const MessageRate&, const MessageRate&) = default;
};
/// Where a Simulator stands.
enum class MemberState : std::uint8_t {
    kActive,   ///< it takes part
    kLeaving,  ///< it hands over its states
    kLeft,     ///< it has left
    kLost,     ///< it failed or was silent for too long
};
/// A Simulator of the run.
struct MemberStatus {
    std::uint32_t id = 0;                      // in the order of joining, from 0
    std::string name;                          ///< host and process
    MemberState state = MemberState::kActive;  ///< where it stands
    std::uint32_t threads = 1;                 ///< that step
    std::uint64_t robots = 0;                  ///< that it has now
    std::uint64_t islands = 0;                 ///< that it has now
    double step_us = 0;                        // stepping CPU time per tick and thread
    double load = 0;                           // the same, relative to the busiest Simulator
    MessageRate messages;                      ///< of this member
    bool own_process = false;                  ///< the run started it as a process and can kill it
    /// Compares all members.
    friend bool operator==(const MemberStatus&, const MemberStatus&) = default;
};
/// The run at its committed tick.
struct RunStatus {
    std::string world;           ///< the world file
    Tick tick = 0;               ///< committed
    double time_s = 0;           ///< simulated time of that tick
    bool paused = false;         ///< by a request, or because the duration is over
    bool over = false;           ///< the duration is over; the run stays for inspection
    double speed = 0;            // simulated seconds per real second that are wanted; 0: as fast as possible
    std::uint64_t islands = 0;   // of the last window
    std::int64_t window = 0;     // ticks of the next window
    std::uint64_t windows = 0;   // committed
    std::uint64_t repeated = 0;  // of these, stepped again with islands merged
    double efficiency = 1;       // mean load of the Simulators, relative to the busiest
    double step_cpu_s = 0;       ///< CPU time of all stepping, s
    std::uint64_t losses = 0;    ///< Simulators lost
    std::uint64_t recoveries = 0;       ///< of lost states
    std::uint64_t migrations = 0;       ///< of robots between Simulators
    std::uint64_t cuts = 0;             ///< windows with work stealing
    MessageRate messages;               // of all members
    std::uint64_t model_hash = 0;       ///< of the Model
    std::uint64_t state_hash = 0;       ///< of the world at `tick`
    std::int64_t branch = 0;            // of the journal; 0: there is none
    double first_s = 0;                 // the journal's first time
    std::uint64_t timeline = 0;         ///< another number after each change of RunTimeline; 0: no journal
    std::uint64_t journal_bytes = 0;    ///< size of the journal's file
    double journal_mb_per_min = 0;      ///< how fast it grew lately, MB per minute of real time
    bool replay = false;                ///< a recorded run is stepped again
    std::vector<MemberStatus> members;  // Simulators that hold or held a seat
    std::vector<std::string> robots;    // by RobotId, if they were requested
    std::uint64_t robot_count = 0;      ///< robots in the world
    /// Compares all members.
    friend bool operator==(const RunStatus&, const RunStatus&) = default;
};
/// By RobotId.
struct RobotGroups {
    std::uint64_t model_hash = 0;         ///< of the Model whose robots these are
    std::vector<std::int32_t> simulator;  // id of the robot's Simulator; -1: none yet
    std::vector<std::int32_t> island;     // lowest RobotId of its island; -1: none yet
    /// Compares all members.
    friend bool operator==(const RobotGroups&, const RobotGroups&) = default;
};
/// By RobotId: the box that the robot swept in the last window, with its contact margin, m, world axes.
struct RobotBounds {
    std::uint64_t model_hash = 0;  ///< of the Model whose robots these are
    std::vector<Box32> boxes;      ///< by RobotId
    /// Compares all members.
    friend bool operator==(const RobotBounds&, const RobotBounds&) = default;
};
/// A stage of the steps (docs/physics.md), and the time it took.
struct StageTime {
    std::string name;    ///< "forward kinematics", say
    double seconds = 0;  ///< wall time, summed over threads and Simulators
    /// Compares all members.
    friend bool operator==(const StageTime&, const StageTime&) = default;
};
/// Where the time of the steps goes, and what the solver does: of the last second that was measured.
/// Windows that were stepped again count again.
struct RunProfile {
    Tick ticks = 0;                     ///< that were committed in it; 0: nothing was measured yet
    std::vector<StageTime> stages;      ///< in the order of a tick
    std::uint64_t islands = 0;          ///< contact islands, counted in each tick
    std::uint64_t largest_island = 0;   ///< robots of the largest contact island
    std::uint64_t most_contacts = 0;    ///< contact points and near misses of one island of several robots
    std::uint64_t largest_part = 0;     ///< the most robots that were solved together
    std::uint64_t iterations = 0;       ///< of Newton's method, of all islands
    std::uint64_t iterations_most = 0;  ///< of one island in one tick
    double residual = 0;                ///< of the momentum balance, relative, in the worst island
    std::uint64_t friction_solves = 0;  ///< parts with friction at contacts that push
    std::uint64_t friction_misses = 0;  ///< of these, whose friction is off by more than friction_tolerance
    double friction_error = 0;  ///< the most that friction is off by, relative to its part's largest impulse
    double friction_tolerance = 0;  ///< of the accuracy
    /// Compares all members.
    friend bool operator==(const RunProfile&, const RunProfile&) = default;
};
/// A branch of the journal, as far as the file still has it.
struct TimelineBranch {
    std::int64_t id = 0;      ///< 1, 2, 3 ...
    std::int64_t parent = 0;  ///< 0: none, or it is no longer in the file
    double begin_s = 0;       ///< where it left its parent
    double first_s = 0;       ///< its first time that can be restored; later than begin_s once it is pruned
    double end_s = 0;         ///< its last time; of the current branch when the timeline last changed
    std::string reason;       ///< for people
    /// Compares all members.
    friend bool operator==(const TimelineBranch&, const TimelineBranch&) = default;
};
/// A named moment of the journal.
struct TimelineBookmark {
    std::int64_t id = 0;      ///< unique in the file
    std::int64_t branch = 0;  ///< of the journal
    double time_s = 0;        ///< simulated time
    std::string name;         ///< for people
    /// Compares all members.
    friend bool operator==(const TimelineBookmark&, const TimelineBookmark&) = default;
};
/// What can be looked at again.
struct RunTimeline {
    std::uint64_t serial = 0;                 ///< RunStatus::timeline
    std::int64_t branch = 0;                  ///< the current one
    std::vector<TimelineBranch> branches;     ///< ascending by id
    std::vector<TimelineBookmark> bookmarks;  ///< ascending by id
    /// Compares all members.
    friend bool operator==(const RunTimeline&, const RunTimeline&) = default;
};
/// The world at an earlier time, for display: robots of the present Model by name, as they were then.
struct RunPreview {
    std::uint64_t model_hash = 0;       ///< of the present Model, whose robots these are
    std::int64_t branch = 0;            ///< of the journal
    Tick tick = 0;                      ///< the moment that is shown
    double time_s = 0;                  ///< simulated time of that tick
    bool exact = false;                 ///< it is the moment that was requested, not an earlier one
    std::uint64_t gone = 0;             ///< robots of that moment that the present Model does not have
    std::uint64_t absent = 0;           ///< robots of the present Model that did not exist then
    std::vector<std::uint8_t> entries;  ///< view states by RobotId (wire/view_state.h), without absent robots
    /// Compares all members.
    friend bool operator==(const RunPreview&, const RunPreview&) = default;
};
/// The request was carried out.
struct ControlDone {
    Tick tick = 0;     // at which it took effect
    std::string text;  // for people
    /// Compares all members.
    friend bool operator==(const ControlDone&, const ControlDone&) = default;
};
/// The request was refused; nothing has changed. Fields as in Error.
struct ControlRefused {
    std::string message;  ///< what is wrong
    std::string remedy;   ///< what to do about it
    std::string code;     ///< for programs
    ControlRefused() = default;
    /// From an Error.
    ControlRefused(const Error& e) : message(e.message), remedy(e.remedy), code(e.code) {}
    /// The same as an Error.
    Error error() const { return {message, remedy, code}; }
    /// Compares all members.
    friend bool operator==(const ControlRefused&, const ControlRefused&) = default;
};
/// What became of a request.
using ControlOutcome = std::variant<ControlDone, ControlRefused, RunStatus, RobotGroups, RobotBounds,
                                    RunTimeline, RunPreview, RunProfile>;

/// False if the request was refused.
inline bool is_done(const ControlOutcome& outcome) {
    return !std::holds_alternative<ControlRefused>(outcome);
}

}  // namespace roboss
