// Every message that Controller, Simulators and Clients exchange, as plain data. A Bus may drop, double,
// delay or reorder any of them: requests are sent again until answered, and every answer names what it
// answers, so nothing here is harmful when it comes late or twice.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/types.h"
#include "math/box32.h"
#include "model/order.h"
#include "wire/robot_frame.h"

namespace roboss {

enum class Role : std::uint8_t { kController, kSimulator, kClient };

/// Who a message is from or for. `instance` is chosen by whoever starts the role and never used twice; the
/// Controller is 0.
struct Address {
    Role role = Role::kController;
    std::uint64_t instance = 0;
    friend auto operator<=>(const Address&, const Address&) = default;
};

/// States of some robots at one tick, bit for bit: hand-offs, checkpoints, observations.
struct StateBlock {
    Tick tick = 0;
    std::vector<RobotId> robots;
    std::vector<std::uint32_t> sizes;  // bytes of each robot's state, in the order of `robots`
    std::vector<std::uint8_t> bytes;
    friend bool operator==(const StateBlock&, const StateBlock&) = default;
};

/// Which robots' states can be had from whom.
struct Holding {
    Address source;
    std::vector<RobotId> robots;
    friend bool operator==(const Holding&, const Holding&) = default;
};

/// Robots whose states are to be sent to somebody.
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
    std::string name;  // for people: where it runs
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
struct Expelled {  // Controller -> Simulator that was given up; it may say Hello again
    SimulatorId simulator;
    friend bool operator==(const Expelled&, const Expelled&) = default;
};
struct RunOver {  // Controller -> everybody: the run has ended
    std::string reason;
    friend bool operator==(const RunOver&, const RunOver&) = default;
};
/// Simulator -> Controller, every 50 ms, also from within a long step; and Controller -> all others now and
/// then, so that who hears nothing knows that the line is dead.
struct Alive {
    SimulatorId simulator;
    friend bool operator==(const Alive&, const Alive&) = default;
};
struct LeaveRequest {  // Simulator -> Controller
    SimulatorId simulator;
    friend bool operator==(const LeaveRequest&, const LeaveRequest&) = default;
};
struct Goodbye {  // Controller -> Simulator: nothing depends on it any more
    SimulatorId simulator;
    friend bool operator==(const Goodbye&, const Goodbye&) = default;
};

// --- windows
// -------------------------------------------------------------------------------------------------------------

/// One Simulator's part of an attempt at a window. Island i is robots[island_offsets[i] .. island_offsets[i +
/// 1]).
struct Plan {
    std::uint32_t epoch = 0;    // grows when a Simulator is lost
    std::uint64_t window = 0;   // grows with every window planned
    std::uint32_t attempt = 0;  // grows when touching islands of the window are merged, and with every Cut
    SimulatorId simulator;
    Tick window_from = 0;  // where the window starts, for all
    /// What this plan steps: the whole window, or what a Cut left of it.
    Tick from = 0, until = 0;
    std::vector<std::uint32_t> island_offsets;
    std::vector<RobotId> robots;
    std::vector<Holding>
        hand_offs;  // robots whose states at `from` come from elsewhere; the others are here already
    std::vector<HandOver>
        gives;                  // robots that others get: their states at `from` are sent before any stepping
    std::vector<Order> orders;  // for these robots, from <= apply_at < until, canonical order; besides:
    std::uint64_t ahead = 0;    // those of the OrdersAhead of this window; 0: none
    std::vector<RobotId> keep;  // robots of this Simulator whose states at `from` somebody still wants
    Tick release_before = 0;    // states kept for earlier ticks may go
    /// CPU time that everybody is expected to need for the window, or for what a Cut left; who sees that it
    /// will need more says Late. 0: nobody does.
    std::uint64_t due_ns = 0;
    /// The window in whose midst this begins; 0: it begins at a window's start.
    std::uint64_t midst() const { return from > window_from ? window : 0; }
    friend bool operator==(const Plan&, const Plan&) = default;
};

/// Controller -> Simulator while it steps a window: orders for the ticks after it, of the robots that it has
/// there. The next plan says only what else there is, or all, if this gets lost.
struct OrdersAhead {
    std::uint64_t window = 0;  // that is being stepped
    SimulatorId simulator;
    std::vector<Order> orders;  // canonical order
    friend bool operator==(const OrdersAhead&, const OrdersAhead&) = default;
};

/// Simulator -> Controller while it steps: it will need so much CPU time for this plan, more than was due.
struct Late {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    std::uint32_t attempt = 0;
    std::uint64_t needs_ns = 0;
    friend bool operator==(const Late&, const Late&) = default;
};

/// Controller -> Simulator that is late, when others have nothing to do: to stop where it is; what is left of
/// the window will be shared out. Who is nearly done goes on to the end, so nothing depends on its coming.
struct Cut {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    std::uint32_t attempt = 0;
    SimulatorId simulator;
    friend bool operator==(const Cut&, const Cut&) = default;
};

/// Interaction bounds from earlier in the window: from before a teleport, or of a robot that somebody else
/// steps on after a Cut.
struct EarlierBox {
    RobotId robot;
    Box32 swept;
    friend bool operator==(const EarlierBox&, const EarlierBox&) = default;
};

struct IslandFrame {
    /// Thread CPU time of the stepping; for balance and telemetry, never for results.
    std::uint64_t cost_ns = 0;
    std::uint64_t contacts = 0, static_contacts = 0;  // summed over the ticks
    /// Valid: this robot's state was not finite after the step from tick `failed_at`, the first in which one
    /// of the island's was (StepReport::not_finite, not_finite_joint, beyond_numbers).
    RobotId failed;
    Tick failed_at = 0;
    JointId failed_joint;
    bool beyond_numbers = false;
    friend bool operator==(const IslandFrame&, const IslandFrame&) = default;
};

/// Simulator -> Controller: the answer to a Plan, robots and islands in the Plan's order. After a Cut:
/// without robots, and islands tell of the ticks stepped; bounds so far come with the frame of what was left.
struct Frame {
    std::uint32_t epoch = 0;
    std::uint64_t window = 0;
    std::uint32_t attempt = 0;
    std::uint64_t left = 0;  // ticks that were not stepped, because of a Cut
    std::vector<RobotFrame> robots;
    std::vector<EarlierBox> earlier;
    std::vector<IslandFrame> islands;
    friend bool operator==(const Frame&, const Frame&) = default;
};

// --- the Model
// -----------------------------------------------------------------------------------------------------------

/// What the Controller gives to whoever asks: the Model (wire/model_codec.h), or what the world looks like,
/// in bytes that only viewers understand (none: the Controller does not know).
enum class Whole : std::uint8_t { kModel, kScene };
struct ModelRequest {  // anyone -> Controller, before anything else: who joins needs no file
    Whole what = Whole::kModel;
    std::uint64_t offset = 0;
    friend bool operator==(const ModelRequest&, const ModelRequest&) = default;
};
/// Controller -> who asked: some of its bytes. Equal hashes: of the same whole.
struct ModelPart {
    Whole what = Whole::kModel;
    std::uint64_t bytes_hash = 0, total = 0, offset = 0;
    std::vector<std::uint8_t> bytes;
    friend bool operator==(const ModelPart&, const ModelPart&) = default;
};

// --- states
// --------------------------------------------------------------------------------------------------------------

struct StateRequest {  // anyone -> whoever holds the robots
    Tick tick = 0;
    std::vector<RobotId> robots;
    /// Of states in the midst of a window (where a Cut ended it), for such may be of no account tomorrow: the
    /// window's number. 0: of states at a window's start, which are committed.
    std::uint64_t window = 0;
    friend bool operator==(const StateRequest&, const StateRequest&) = default;
};
struct StateReply {
    StateBlock states;         // may lack robots that are not here (yet)
    std::uint64_t window = 0;  // the request's
    friend bool operator==(const StateReply&, const StateReply&) = default;
};

// --- views: what is shown of the world; nothing is computed from them, and none is missed
// -----------------------------------------------------

/// Viewer -> Controller: show me the world as it is committed. Said again each second; forgotten after a few.
struct ViewRequest {
    std::uint64_t model_hash = 0;         // another than the run's is answered by ModelChanged
    std::uint32_t interval_ms = 0;        // at most one view in so long; 0: none
    std::uint32_t exact_interval_ms = 0;  // and exact states of these (StateReply)
    bool exact_all = false;
    std::vector<RobotId> exact;
    friend bool operator==(const ViewRequest&, const ViewRequest&) = default;
};
/// Controller -> who holds the robots: send these to the viewer, if they are still here.
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
    bool guest = false;  // comes and goes: nobody waits for it, whatever it said before
    // Of a Client that was here before and meets a Controller that does not know it:
    Tick expected = -1;              // its next observation; negative: it is new
    std::uint64_t acknowledged = 0;  // its last word that a Controller has acknowledged
    std::uint64_t said = 0;          // its last word; those between are on their way
    friend bool operator==(const ClientHello&, const ClientHello&) = default;
};
struct ClientWelcome {
    ClientId client;
    Tick first = 0;  // tick of its first observation
    std::uint64_t seed = 0;
    friend bool operator==(const ClientWelcome&, const ClientWelcome&) = default;
};
/// Controller -> Client: the world at `tick` is committed and may be fetched. Sent again until the Client's
/// word comes.
struct Observation {
    Tick tick = 0;
    std::uint64_t last_word = 0;  // the Client's last word that the Controller has
    std::vector<Holding> holders;
    friend bool operator==(const Observation&, const Observation&) = default;
};
struct ClientOrder {
    std::uint64_t sequence = 0;
    RobotId robot;
    Action action;
    friend bool operator==(const ClientOrder&, const ClientOrder&) = default;
};
/// Client -> Controller, numbered 1, 2, 3 ...; accepted in this order. One for each observation, with its
/// orders.
struct ClientWord {
    ClientId client;
    std::uint64_t word = 0;
    Tick observed = 0;
    std::vector<ClientOrder> orders;
    friend bool operator==(const ClientWord&, const ClientWord&) = default;
};
struct ClientUnknown {  // Controller -> Client whose seat it does not have: it may say ClientHello again
    ClientId client;
    friend bool operator==(const ClientUnknown&, const ClientUnknown&) = default;
};
struct RefusedOrder {
    std::uint64_t sequence = 0;
    std::string reason;
    friend bool operator==(const RefusedOrder&, const RefusedOrder&) = default;
};
struct WordAck {
    ClientId client;
    std::uint64_t word = 0;             // the last word accepted
    std::vector<RefusedOrder> refused;  // orders of that word that were refused
    friend bool operator==(const WordAck&, const WordAck&) = default;
};
/// Client -> Controller: its last word; it takes no part any more. A failure ends the run.
struct ClientBye {
    ClientId client;
    std::uint64_t word = 0;
    bool failed = false;
    std::string reason;
    friend bool operator==(const ClientBye&, const ClientBye&) = default;
};

// --- control of the run
// --------------------------------------------------------------------------------------------------

/// Anyone -> Controller: pause, step, speed, rewind ... Sent again until answered.
struct ControlRequest {
    std::uint64_t number = 0;  // of the sender's requests, ascending
    std::vector<std::string> words;
    friend bool operator==(const ControlRequest&, const ControlRequest&) = default;
};
struct ControlReply {  // Controller -> who asked
    std::uint64_t number = 0;
    bool done = false;
    std::string text;
    friend bool operator==(const ControlReply&, const ControlReply&) = default;
};
/// Controller -> member that has an earlier Model of this run: fetch it again and join again.
struct ModelChanged {
    std::uint64_t model_hash = 0;
    friend bool operator==(const ModelChanged&, const ModelChanged&) = default;
};

using Message =
    std::variant<Hello, Welcome, Refused, Expelled, Alive, LeaveRequest, Goodbye, Plan, Frame, StateRequest,
                 StateReply, ClientHello, ClientWelcome, Observation, ClientWord, WordAck, ClientBye, RunOver,
                 ModelRequest, ModelPart, ClientUnknown, ControlRequest, ControlReply, ModelChanged,
                 ViewRequest, ViewDue, ViewStates, OrdersAhead, Late, Cut>;

struct Envelope {
    Address from, to;
    Message message;
    friend bool operator==(const Envelope&, const Envelope&) = default;
};

}  // namespace roboss
