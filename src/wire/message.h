// Every message that Controller, Simulators and Clients exchange, as plain data. A Bus may drop, duplicate,
// delay or reorder any of them: requests are sent again until answered, and every answer names the request
// that it answers, so late and duplicate messages are harmless.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/types.h"
#include "math/box32.h"
#include "model/order.h"
#include "physics/step_profile.h"
#include "wire/control.h"
#include "wire/robot_result.h"
#include "wire/view_extras.h"

namespace roboss {

enum class Role : std::uint8_t { kController, kSimulator, kClient };

/// Sender or receiver of a message. Whoever starts a role chooses its `instance`, which is never used again;
/// the Controller has 0.
struct Address {
    Role role = Role::kController;
    std::uint64_t instance = 0;
    friend auto operator<=>(const Address&, const Address&) = default;
};

/// Exact states of some robots at one tick, for hand-offs, checkpoints and observations.
struct StateBlock {
    Tick tick = 0;
    std::vector<RobotId> robots;
    std::vector<std::uint32_t> sizes;  // bytes of each robot's state, in the order of `robots`
    std::vector<std::uint8_t> bytes;
    friend bool operator==(const StateBlock&, const StateBlock&) = default;
};

/// Who holds the states of which robots.
struct Holding {
    Address source;
    std::vector<RobotId> robots;
    friend bool operator==(const Holding&, const Holding&) = default;
};

/// Robots whose states the receiver of the message sends to `to`.
struct HandOver {
    Address to;
    std::vector<RobotId> robots;
    friend bool operator==(const HandOver&, const HandOver&) = default;
};

// --- joining and leaving
// -------------------------------------------------------------------------------------------------

struct Hello {  // Simulator -> Controller
    std::uint64_t model_hash = 0;
    std::uint32_t threads = 1;
    std::string name;  // where it runs, for reports
    friend bool operator==(const Hello&, const Hello&) = default;
};
struct Welcome {  // Controller -> Simulator
    SimulatorId simulator;
    friend bool operator==(const Welcome&, const Welcome&) = default;
};
struct Refused {  // Controller -> Simulator or Client that cannot take part
    std::string reason;
    friend bool operator==(const Refused&, const Refused&) = default;
};
struct Expelled {  // Controller -> Simulator that is considered lost; it may send Hello again
    SimulatorId simulator;
    friend bool operator==(const Expelled&, const Expelled&) = default;
};
struct RunOver {  // Controller -> everybody: the run has ended
    std::string reason;
    bool failed = false;  ///< it could not go on; the reason says why
    friend bool operator==(const RunOver&, const RunOver&) = default;
};
/// Simulator -> Controller, every 50 ms, also during a long step; and Controller -> everybody, every 250 ms,
/// so that a member notices when its connection to the Controller is lost.
struct Heartbeat {
    SimulatorId simulator;
    friend bool operator==(const Heartbeat&, const Heartbeat&) = default;
};
struct LeaveRequest {  // Simulator -> Controller
    SimulatorId simulator;
    friend bool operator==(const LeaveRequest&, const LeaveRequest&) = default;
};
struct Goodbye {  // Controller -> Simulator: it may end, nothing depends on it any more
    SimulatorId simulator;
    friend bool operator==(const Goodbye&, const Goodbye&) = default;
};

// --- windows
// -------------------------------------------------------------------------------------------------------------

/// One Simulator's part of an attempt at a window. Island i is robots[island_offsets[i] .. island_offsets[i +
/// 1]).
struct Assignment {
    std::uint32_t epoch = 0;    // grows when a Simulator is lost
    std::uint64_t window = 0;   // grows with every window planned
    std::uint32_t attempt = 0;  // grows when touching islands of the window are merged, and with each Cut
    SimulatorId simulator;
    Tick window_from = 0;  // where the window starts for everybody
    /// The ticks of this assignment: the whole window, or what a Cut left of it.
    Tick from = 0, until = 0;
    std::vector<std::uint32_t> island_offsets;
    std::vector<RobotId> robots;
    std::vector<Holding> hand_offs;  // robots whose states at `from` others send; the Simulator has the rest
    std::vector<HandOver>
        transfers;              // robots that others get: it sends their states at `from` before it steps
    std::vector<Order> orders;  // for these robots, from <= apply_at < until, canonical order; in addition:
    std::uint64_t ahead = 0;    // the OrdersAhead sent during this window; 0: none
    std::vector<RobotId> keep;  // robots whose states at `from` it keeps, since others still need them
    Tick release_before = 0;    // states kept for earlier ticks may be dropped
    /// CPU time that each Simulator is expected to need for the window, or for what a Cut left. A Simulator
    /// that will need more sends Late. 0: no limit.
    std::uint64_t due_ns = 0;
    bool measured = false;  // its result has a profile
    /// The window within which this assignment begins; 0: it begins at a window's start.
    std::uint64_t mid_window() const { return from > window_from ? window : 0; }
    friend bool operator==(const Assignment&, const Assignment&) = default;
};

/// Controller -> Simulator while it steps a window: orders for the ticks after the window, for the robots
/// that it steps. The next assignment then has only the remaining orders, or all of them if this message was
/// lost.
struct OrdersAhead {
    std::uint64_t window = 0;  // the window being stepped
    SimulatorId simulator;
    std::vector<Order> orders;  // canonical order
    friend bool operator==(const OrdersAhead&, const OrdersAhead&) = default;
};

/// Simulator -> Controller while it steps: it will need `needs_ns` of CPU time for this assignment, more than
/// its due_ns.
struct Late {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    std::uint32_t attempt = 0;
    std::uint64_t needs_ns = 0;
    friend bool operator==(const Late&, const Late&) = default;
};

/// Controller -> Simulator that is late, when others are idle (work stealing): stop at the current tick; the
/// remaining ticks are distributed. A Simulator that is nearly done steps on to the end, so this message may
/// get lost.
struct Cut {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    std::uint32_t attempt = 0;
    SimulatorId simulator;
    friend bool operator==(const Cut&, const Cut&) = default;
};

/// Interaction bounds from earlier in the window: before a teleport, or before a Cut if another Simulator
/// steps the robot from then on.
struct EarlierBox {
    RobotId robot;
    Box32 swept;
    friend bool operator==(const EarlierBox&, const EarlierBox&) = default;
};

struct IslandResult {
    /// Thread CPU time of the stepping. For load balancing and telemetry only; results never depend on it.
    std::uint64_t cost_ns = 0;
    std::uint64_t contacts = 0, static_contacts = 0;  // summed over the ticks
    /// Valid: this robot's state was not finite after the step from tick `failed_at`, the first in which one
    /// of the island's was (StepReport::not_finite, not_finite_joint, beyond_numbers).
    RobotId failed;
    Tick failed_at = 0;
    JointId failed_joint;
    bool beyond_numbers = false;
    friend bool operator==(const IslandResult&, const IslandResult&) = default;
};

/// Simulator -> Controller: the answer to an Assignment, robots and islands in its order. After a Cut it has
/// no robots, its islands report the ticks stepped, and the bounds so far come with the result of the rest.
struct WindowResult {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    std::uint32_t attempt = 0;
    std::uint64_t left = 0;  // ticks not stepped because of a Cut
    std::vector<RobotResult> robots;
    std::vector<EarlierBox> earlier;
    std::vector<IslandResult> islands;
    std::optional<StepProfile> profile{};  // of a measured assignment
    friend bool operator==(const WindowResult&, const WindowResult&) = default;
};

// --- the Model
// -----------------------------------------------------------------------------------------------------------

/// What the Controller sends on request: the Model (wire/model_codec.h), the scene for viewers
/// (scene/scene_file.h), or the visuals for cameras (scene/scene_codec.h). Of the last two no bytes: the
/// Controller has none.
enum class Whole : std::uint8_t { kModel, kScene, kVisuals };
struct ModelRequest {  // anyone -> Controller, first of all: a member that joins needs no file
    Whole what = Whole::kModel;
    std::uint64_t offset = 0;
    friend bool operator==(const ModelRequest&, const ModelRequest&) = default;
};
/// Controller -> requester: some of the bytes. Parts with equal hashes belong together.
struct ModelPart {
    Whole what = Whole::kModel;
    std::uint64_t bytes_hash = 0, total = 0, offset = 0;
    std::vector<std::uint8_t> bytes;
    friend bool operator==(const ModelPart&, const ModelPart&) = default;
};

// --- states
// --------------------------------------------------------------------------------------------------------------

struct StateRequest {  // anyone -> holder of the robots
    Tick tick = 0;
    std::vector<RobotId> robots;
    /// For states within a window (where a Cut ended an assignment), which may never be committed: the
    /// window's number. 0: for states at a window's start, which are committed.
    std::uint64_t window = 0;
    friend bool operator==(const StateRequest&, const StateRequest&) = default;
};
struct StateReply {
    StateBlock states;         // may lack robots whose states the sender does not have (yet)
    std::uint64_t window = 0;  // the request's
    friend bool operator==(const StateReply&, const StateReply&) = default;
};

// --- views: for display only; a lost one is not sent again
// -----------------------------------------------------

/// Viewer -> Controller: subscribes to views of the committed world. Repeated each second; expires after a
/// few.
struct ViewRequest {
    std::uint64_t model_hash = 0;         // if it is not the run's, the answer is ModelChanged
    std::uint32_t interval_ms = 0;        // least time between two views; 0: no views
    std::uint32_t exact_interval_ms = 0;  // the same for exact states of the robots below (StateReply)
    bool exact_all = false;
    std::vector<RobotId> exact;
    friend bool operator==(const ViewRequest&, const ViewRequest&) = default;
};
/// Controller -> holder of the robots: send these to the viewer, if you still have them.
struct ViewDue {
    std::uint32_t epoch = 0;   // of the Controller
    std::uint64_t serial = 0;  // of its views, ascending
    Tick tick = 0;             // committed
    Address viewer;
    std::vector<RobotId> robots, exact;
    friend bool operator==(const ViewDue&, const ViewDue&) = default;
};
struct ViewStates {  // -> viewer: entries of wire/view_state.h
    std::uint64_t model_hash = 0;
    std::uint32_t epoch = 0;
    std::uint64_t serial = 0;
    Tick tick = 0;
    std::vector<std::uint8_t> entries;
    ViewExtras extras;  // of the same robots
    friend bool operator==(const ViewStates&, const ViewStates&) = default;
};

// --- Clients
// -------------------------------------------------------------------------------------------------------------

struct ClientHello {
    std::string name;
    std::uint64_t model_hash = 0;
    Tick period = 1;   // ticks between observations
    Tick latency = 1;  // ticks from an observation to the effect of its orders
    bool synchronous = true;
    bool observer = false;  // nobody ever waits for it, whatever its other options are
    // Set by a Client that had joined before and meets a Controller that does not know it:
    Tick expected = -1;              // its next observation; negative: it is new
    std::uint64_t acknowledged = 0;  // its last reply that a Controller has acknowledged
    std::uint64_t last_reply = 0;    // the last one it has sent; those between are on their way
    friend bool operator==(const ClientHello&, const ClientHello&) = default;
};
struct ClientWelcome {
    ClientId client;
    Tick first = 0;  // tick of its first observation
    std::uint64_t seed = 0;
    friend bool operator==(const ClientWelcome&, const ClientWelcome&) = default;
};
/// Controller -> Client: the world at `tick` is committed and can be fetched. Sent again until the Client
/// replies.
struct Observation {
    Tick tick = 0;
    std::uint64_t last_reply = 0;  // the Client's last reply that the Controller has
    std::vector<Holding> holders;
    friend bool operator==(const Observation&, const Observation&) = default;
};
struct ClientOrder {
    std::uint64_t sequence = 0;
    RobotId robot;
    Action action;
    friend bool operator==(const ClientOrder&, const ClientOrder&) = default;
};
/// Client -> Controller: one for each observation, with its orders. Numbered 1, 2, 3 ... and accepted in this
/// order.
struct ClientReply {
    ClientId client;
    std::uint64_t number = 0;
    Tick observed = 0;
    std::vector<ClientOrder> orders;
    std::uint64_t acknowledged = 0;  // the last reply that it knows to have arrived
    friend bool operator==(const ClientReply&, const ClientReply&) = default;
};
struct ClientUnknown {  // Controller -> Client that it does not know: it may send ClientHello again
    ClientId client;
    friend bool operator==(const ClientUnknown&, const ClientUnknown&) = default;
};
struct RefusedOrder {
    std::uint64_t sequence = 0;
    std::string reason, code;  // why, for people and for programs
    friend bool operator==(const RefusedOrder&, const RefusedOrder&) = default;
};
struct ReplyAck {
    ClientId client;
    std::uint64_t number = 0;           // the last reply accepted
    std::vector<RefusedOrder> refused;  // orders of the last replies that were refused, by ascending sequence
    friend bool operator==(const ReplyAck&, const ReplyAck&) = default;
};
/// Client -> Controller: its last reply; it leaves. A failure ends the run.
struct ClientBye {
    ClientId client;
    std::uint64_t number = 0;
    bool failed = false;
    std::string reason;
    friend bool operator==(const ClientBye&, const ClientBye&) = default;
};

// --- control of the run
// --------------------------------------------------------------------------------------------------

/// Anyone -> Controller: pause, step, speed, rewind ... Sent again until answered.
struct ControlRequest {
    std::uint64_t number = 0;  // of the sender's requests, ascending
    ControlAction action;
    friend bool operator==(const ControlRequest&, const ControlRequest&) = default;
};
struct ControlReply {          // Controller -> requester
    std::uint64_t number = 0;  // of the request
    ControlOutcome outcome;
    friend bool operator==(const ControlReply&, const ControlReply&) = default;
};
/// Controller -> member that has an earlier Model of this run: fetch the new one and join again.
struct ModelChanged {
    std::uint64_t model_hash = 0;
    friend bool operator==(const ModelChanged&, const ModelChanged&) = default;
};

using Message =
    std::variant<Hello, Welcome, Refused, Expelled, Heartbeat, LeaveRequest, Goodbye, Assignment,
                 WindowResult, StateRequest, StateReply, ClientHello, ClientWelcome, Observation, ClientReply,
                 ReplyAck, ClientBye, RunOver, ModelRequest, ModelPart, ClientUnknown, ControlRequest,
                 ControlReply, ModelChanged, ViewRequest, ViewDue, ViewStates, OrdersAhead, Late, Cut>;

struct Rights;

struct Envelope {
    Address from, to;
    Message message;
    /// Rights of the sender's key. The receiving Bus adds them; they are not on the wire. Null: all.
    std::shared_ptr<const Rights> rights{};
    friend bool operator==(const Envelope&, const Envelope&) = default;
};

}  // namespace roboss
