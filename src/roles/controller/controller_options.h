// What a Controller is given, and what it reports.
#pragma once

#include <string>
#include <vector>

#include "journal/run_log.h"
#include "roles/controller/control_service.h"
#include "roles/controller/model_server.h"
#include "schedule/forecast.h"

namespace roboss {

/// Options of a Controller.
struct ControllerOptions {
    Tick window = 0;             // ticks; 0: adaptive
    Tick window_max = 0;         // limit of the adaptive length; 0: by the robots per worker (longest_window)
    ForecastOptions forecast;    // of the islands of a window
    std::size_t simulators = 1;  // the first window waits for this many
    std::vector<std::string> clients;  // and for these Clients; their ids are their indices here
    std::uint64_t seed = 1;            // sent to Clients
    std::int64_t resend_ms = 100;      // after which an unanswered message is sent again
    std::size_t ahead_least = 500;     // orders of the next window that are worth sending ahead of it
    /// Work stealing only in windows with at least this much work per Simulator.
    double stealing_least_ns = 500'000;
    std::int64_t heartbeat_ms = 250;  // heartbeat interval
    std::int64_t loss_ms = 0;         // a Simulator silent for so long is considered lost; 0: never
    std::int64_t client_loss_ms = 0;  // so is a Client that does not reply to an observation; 0: never
    std::int64_t client_gone_ms = 0;  // and a Client that the Bus reports as vanished for so long; 0: never
    Tick checkpoint_ticks = 0;        // between recovery checkpoints, at most; 0: none by ticks
    /// Stepping CPU time of the busiest Simulator between two of them; 0: none by work.
    double checkpoint_work_s = 0;
    /// State of the Controller that this one succeeds on the same Bus (after a rewind, say).
    struct Before {
        /// Id of the first Simulator; no other Simulator of the run had it, or a greater one.
        std::uint32_t first_id = 0;
        std::uint32_t epoch = 0;            // of the assignments
        std::uint64_t window = 0;           // number of the last window
        std::vector<std::uint64_t> models;  // hashes of earlier Models of the run
        bool went_back = false;             // a rewind: Clients may have seen ticks that were discarded
        ControlService control;             // requests, and answers that may have to be repeated
    } before;                               ///< none: it is the first
    /// Makes the scene, in bytes for viewers; called when the first viewer requests it.
    ModelServer::SceneOf scene;
    /// The same of the visuals for cameras of Clients in other processes.
    ModelServer::SceneOf visuals;
    RunLog* log = nullptr;  // outlives the Controller; null: nothing is logged
    Tick log_ticks = 0;     // checkpoints for the log at multiples of so many ticks; 0: none
};

/// Where a run starts: the world's beginning, a saved run, or a journal.
struct StartingPoint {
    Tick tick = 0;                    // of the states
    std::vector<RobotState> states;   // by RobotId
    std::vector<LoggedOrder> orders;  // still to be applied
    /// Up to here the run follows `orders`: no new order gets an earlier tick.
    Tick logged_until = 0;
    /// By ClientId: replies to observations up to this one are in `orders` already and are not accepted
    /// again.
    std::vector<Tick> answered;
};
/// The world's beginning: tick 0, no orders.
StartingPoint beginning_of(const Model& model);

/// Counts since a Simulation was made.
struct Counters {
    std::uint64_t windows = 0;           // committed
    std::uint64_t windows_repeated = 0;  // of these, with islands merged and stepped again
    std::uint64_t robots_repeated = 0;   // robots stepped again, summed over attempts
    std::uint64_t islands = 0;           // summed over windows
    std::uint64_t ticks = 0;             // committed by this run
    std::uint64_t island_ticks = 0;      // islands times ticks: islands_mean = island_ticks / ticks
    std::uint64_t contacts = 0;          // between robots, summed over ticks
    std::uint64_t static_contacts = 0;   // with scenery, summed over ticks
    double step_cpu_s = 0;               // all stepping, repeats included
    double critical_cpu_s = 0;   // of the busiest Simulator of each attempt: a lower bound for many machines
    std::uint64_t silences = 0;  // of the losses, those noticed by silence alone
    std::uint64_t losses = 0;    // Simulators lost
    std::uint64_t recoveries = 0;      // of lost states
    std::uint64_t migrations = 0;      // of robots between Simulators
    std::uint64_t checkpoints = 0;     // for recovery
    std::uint64_t orders_refused = 0;  // of Clients
    std::uint64_t orders_ahead = 0;    // sent ahead of the assignment of their window
    std::uint64_t cuts = 0;            // late assignments of which others took a part (work stealing)
    std::size_t simulators = 0;        // that are alive
    std::size_t islands_now = 0;       // of the last window
};

/// A Simulator for status reports. Loads and times are running means over windows.
struct MemberReport {
    std::uint32_t number = 0;   // in the order of joining, from 0
    std::string name;           // where it runs
    std::uint32_t threads = 1;  // that step
    bool alive = false;         // neither lost nor gone
    bool leaving = false;       // it wants to leave; if it is not alive: it has left
    std::size_t robots = 0;     // that it has now
    std::size_t islands = 0;    // that it has now
    double step_us = 0;         // stepping CPU time per tick and thread
    double load = 0;            // the same, relative to the busiest
    Address address;            // on the Bus
};

}  // namespace roboss
