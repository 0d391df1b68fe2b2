// Simulation: the Controller and the other roles of its process (Simulators, control programs), and the Bus
// between them. It only calls each role's advance() in turn. With a Bus over a network, others take part from
// their own processes.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "client/program_host.h"
#include "core/thread_pool.h"
#include "journal/run_log.h"
#include "journal/saved_run.h"
#include "physics/probe.h"
#include "roles/controller/controller.h"
#include "roles/simulator/simulator.h"

namespace roboss {

/// A control program of this process, and its name as a Client.
struct NamedProgram {
    std::string name;                         // unique in the run
    std::unique_ptr<ControlProgram> program;  // not null
};

/// Options of a Simulation, its roles in this process, and those it waits for.
struct SimulationOptions {
    std::size_t simulators = 1;          // in this process
    std::size_t simulators_awaited = 0;  // in others: the first window waits for them too
    /// Names of Clients in other processes: the first window waits for them too.
    std::vector<std::string> clients_awaited;
    unsigned threads = 1;            // that step islands, shared by the Simulators of this process
    std::size_t lanes = kMostLanes;  // most robots of a type stepped at once
    std::string world_file;          // for saved runs
    render::VisualsOf visuals;       // what cameras of the programs see; none: they cannot be read
    /// Asked between ticks, by all threads that step; true ends the run at once: the window in progress is
    /// not committed. Empty: never.
    std::function<bool()> interrupted;
    /// Called in every round: advances a viewer, say. No result may depend on it.
    std::function<void(Bus&)> observer;
    ControllerOptions controller;  // its `simulators` and `clients` are set from here
};

/// A run: a world that advances tick by tick, with its Clients and Simulators.
class Simulation {
  public:
    /// At the world's beginning, or where `from` was saved. Orders with equal ticks sort by the programs'
    /// positions, awaited Clients last. `bus`: null if all members are in this process.
    /// An Error: there is no Simulator, two Clients have the same name, or a program's options are invalid.
    static Result<std::unique_ptr<Simulation>> create(std::shared_ptr<const Model> model,
                                                      const SimulationOptions& options,
                                                      std::vector<NamedProgram> programs = {},
                                                      const SavedRun* from = nullptr,
                                                      std::unique_ptr<Bus> bus = nullptr);

    /// An order with its tick, from a file say; refused if it is invalid or too late.
    Result<> submit(const Order& order) { return controller_.submit(order); }

    /// Runs until the world is at `target`. An Error: the run cannot go on (a state not finite, a control
    /// program that threw); the world is intact at tick() and can be saved. `go_on` is called now and then;
    /// false ends the run at the next window's end (at once if it waits for its first Simulators).
    /// SimulationOptions::interrupted ends it sooner.
    Result<> run_until(Tick target, const std::function<bool()>& go_on = {});

    Tick tick() const { return controller_.tick(); }  ///< committed: the world is at its beginning
    /// Simulated time at tick() since the start of the world, s.
    double time_s() const { return static_cast<double>(tick()) * model_->dt_s; }
    const Model& model() const { return *model_; }  ///< the compiled world
    std::uint64_t seed() const { return seed_; }    ///< of the run: for sensor noise and control programs
    /// Hash of the world at tick(): of the model and all states.
    std::uint64_t hash() const { return controller_.hash(); }
    /// All states at tick(), by RobotId. Valid until the next run_until().
    const std::vector<RobotState>& states();
    /// All contact points of the tick that begins at tick(), as long as no order takes effect at it
    /// (physics/probe.h). Valid until the next run_until().
    std::span<const ContactReport> contacts() { return probe().contacts(); }
    /// What the joints of the robot bear in the same tick.
    std::vector<JointReaction> joint_reactions(RobotId robot) { return probe().joint_reactions(robot); }
    /// Waits until states() returns at once. False: `go_on`, which is called now and then, said no.
    /// Simulators in other processes may be lost, and then others have to step again what they held.
    bool await_states(const std::function<bool()>& go_on);
    /// The run has failed (run_until() says why).
    bool failed() const { return controller_.failure().has_value(); }
    /// Everything needed to continue exactly.
    SavedRun saved_run();
    /// Writes saved_run() to a file. An Error if that fails.
    Result<> save(const std::string& path) { return save_run(path, *model_, saved_run()); }
    /// Logs the run from now on, with checkpoints at multiples of log_ticks. The log of a new branch begins
    /// with a checkpoint here.
    void start_log(RunLog* log, Tick log_ticks);

    /// Names of the Clients that take part from other processes.
    std::vector<std::string> clients_elsewhere() const;
    /// Advances all roles once while the run rests: members join and leave, requests are accepted.
    void serve();
    /// Adds a Simulator in this process.
    void add_simulator();
    /// Makes the Simulator with the last seat leave; false: there is only one left.
    bool remove_simulator();
    /// Ends this Simulation and returns its Bus for the next one. (It must not be used after that.)
    std::unique_ptr<Bus> release_bus() { return std::move(bus_); }

    /// Counts of windows, islands, losses and so on since this Simulation was made.
    const Counters& counters() const { return controller_.counters(); }
    /// What happened since the last call, one line each: for the log.
    std::vector<std::string> take_notices();
    /// Connects the roles; lives until release_bus() or the end of this Simulation.
    Bus& bus() { return *bus_; }

    // --- requests to the run itself (wire/control.h); the owner of the run executes them
    /// Those that came since the last call.
    std::vector<ControlCall> take_control_calls() { return controller_.control().take_calls(); }
    /// Sends the outcome of a request to the Client that made it.
    void answer(const ControlCall& call, ControlOutcome outcome) {
        controller_.control().answer(*bus_, call, std::move(outcome));
    }
    /// Whether Simulators measure their steps from the next window on.
    void measure(bool wanted) { controller_.measure(wanted); }
    /// Of all windows measured since the last call, summed over Simulators.
    StepProfile take_profile() { return controller_.take_profile(); }
    /// Length of the next windows in ticks; 0: adaptive.
    void set_window(Tick ticks) { controller_.set_window(ticks); }
    /// What the next Simulation on the same Bus has to know.
    ControllerOptions::Before hand_over() { return controller_.hand_over(); }
    /// Tells all members that the run is over.
    void dismiss(const RunOver& over) { controller_.dismiss(*bus_, over); }

    // --- how the run is distributed, for display
    /// The members for whom the world waits, in words; empty: none.
    std::string waits_for() const { return controller_.waits_for(); }
    /// All Simulators and Clients that the first window waits for have joined.
    bool started() const { return controller_.started(); }
    /// All Simulators that have joined so far, those that left or were lost included.
    std::vector<MemberReport> members() const { return controller_.members(); }
    /// Seat of the Simulator that holds the robot: MemberReport::number, if that is a member.
    std::uint32_t seat_of(RobotId robot) const { return controller_.seat_of(robot); }
    /// Islands of the last window.
    const Islands& islands() const { return controller_.islands(); }
    /// Each robot's motion in the last window, by RobotId.
    std::span<const RobotMotion> motions() const { return controller_.motions(); }
    /// Length of the next window in ticks.
    Tick window_ticks() const { return controller_.window_ticks(); }
    /// Load balance of the stepping in recent windows: 1 is perfect.
    double balance() const { return controller_.balance(); }

  private:
    Simulation(std::shared_ptr<const Model> model, const SimulationOptions& options,
               std::vector<NamedProgram> programs, const SavedRun* from, std::unique_ptr<Bus> bus);
    bool is_interrupted() const { return interrupted_ && interrupted_(); }
    void turn();
    /// Advances all roles until done().
    template <class Done>
    void turn_until(Done&& done);
    void wait();
    void serve_log();
    StepProbe& probe();

    std::shared_ptr<const Model> model_;
    std::string world_file_;
    std::uint64_t seed_;
    std::unique_ptr<Bus> bus_;
    ThreadPool pool_;
    std::size_t lanes_;  // robots of a type stepped at once
    std::function<void(Bus&)> observer_;
    std::function<bool()> interrupted_;
    std::uint64_t instance_ = 0;  // of the last role made here
    Controller controller_;
    std::vector<std::unique_ptr<ProgramHost>> hosts_;
    std::vector<std::unique_ptr<Simulator>> simulators_;
    StepProbe probe_;

    RunLog* log_ = nullptr;
    std::optional<RunCheckpoint> log_checkpoint_;  // complete but for its memory
    std::optional<Tick> noting_;                   // the memory of control programs is noted at this tick
    ClientMemory noted_;
};

}  // namespace roboss
