// A cluster on a FaultyBus, all in one thread and by one seed: roles take turns in random order, and while a
// Simulator steps others go on; Simulators are killed, hang, leave and join at random moments.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bus/faulty_bus.h"
#include "client/program_host.h"
#include "roles/controller/controller.h"
#include "roles/simulator/simulator.h"

namespace roboss::test {

struct Trouble {
    // chances per turn, in 1/100000
    std::uint64_t kill = 0, hang = 0, leave = 0, join = 0;
    std::uint64_t rescue = 0;     // that a Simulator joins when none is left
    std::uint64_t rumour = 0;     // that a living Simulator is said to have vanished
    std::uint64_t partition = 0;  // that the network to a Simulator is cut for a while; it steps on
};

/// A network that loses, doubles and delays some messages, by the seed.
inline FaultOptions bad_network(std::uint64_t seed) {
    FaultOptions faults;
    faults.seed = seed;
    faults.drop = 0.02 * static_cast<double>(seed % 4);
    faults.duplicate = 0.02 * static_cast<double>(seed % 3);
    faults.delay_ms_max = static_cast<std::int64_t>(seed % 6);
    return faults;
}

class FaultyCluster {
  public:
    FaultyCluster(std::shared_ptr<const Model> model, ControllerOptions options, const FaultOptions& faults,
                  const Trouble& trouble, std::size_t simulators);

    void add_program(const std::string& name, const ControlOptions& options);  // a DrivingProgram
    void add_program(const std::string& name, std::unique_ptr<ControlProgram> program);
    void add_simulator();
    void kill(std::size_t i);
    void kill_all();

    /// Gives everybody turns until the world rests at `target`; false: it did not come to it in so many
    /// turns.
    bool run_until(Tick target, int turns_max = 400'000);
    void turn();

    /// The Controller is killed and started again from here. Like a real one it knows nothing of the old one.
    void restart_controller(StartingPoint start);

    Controller& controller() { return *controller_; }
    FaultyBus& bus() { return bus_; }
    std::size_t simulators() const { return simulators_.size(); }
    Simulator& simulator(std::size_t i) { return *simulators_[i].role; }
    int kills() const { return kills_; }
    ProgramHost& host(std::size_t i) { return *hosts_[i]; }

  private:
    struct Member {
        std::unique_ptr<Simulator> role;
        Address address;
        int hangs_for = 0;   // turns
        int cut_for = 0;     // turns
        bool at_it = false;  // has its turn
    };
    void give_turn(std::size_t role);
    void let_others_go_on();
    std::size_t roles() const { return 1 + hosts_.size() + simulators_.size(); }
    void make_trouble();
    void make_partitions();
    bool happens(std::uint64_t chance) { return bus_.random(100'000) < chance; }

    std::shared_ptr<const Model> model_;
    ControllerOptions options_;
    Trouble trouble_;
    FaultyBus bus_;
    ThreadPool pool_{1};
    std::unique_ptr<Controller> controller_;
    std::vector<std::unique_ptr<ProgramHost>> hosts_;
    std::vector<Member> simulators_;
    std::uint64_t instance_ = 0;
    std::size_t steppers_ = 0;  // Simulators during their turn
    bool controller_at_it_ = false;
    int others_went_on_ = 0;  // in this turn
    int kills_ = 0;
};

}  // namespace roboss::test
