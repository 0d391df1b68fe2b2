// Run: loads, runs, watches and ends one run. Everything that decides a result is in the roles; here are
// files, clock and terminal.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "app/company.h"
#include "app/contacts_file.h"
#include "app/path_picture.h"
#include "app/progress.h"
#include "app/run_journal.h"
#include "app/run_options.h"
#include "app/summary.h"
#include "app/trace_file.h"
#include "simulation/simulation.h"

namespace roboss {

class Run {
  public:
    explicit Run(const RunOptions& options) : o_(options), progress_(!options.quiet) {}
    /// The exit code.
    int go();

  private:
    using Clock = std::chrono::steady_clock;
    struct Schedule;  // what is due when

    // run.cpp: the beginning and the end
    bool prepare();
    bool prepare_replay();
    CompileOptions compile_options() const;
    bool create();
    bool load_programs(std::vector<NamedProgram>& programs) const;
    bool submit(const std::vector<Order>& orders);
    bool open_files();
    bool begin();
    Summary summary(double wall_s) const;
    int finish(bool fine, double wall_s);

    // run_loop.cpp: the time between
    bool drive(Clock::time_point began);
    bool look(const Schedule& due);
    bool advance_to(Tick target);
    void tell_notices();
    bool write_trace();
    bool write_contacts();
    void collect_paths();

    const RunOptions& o_;
    Progress progress_;
    std::shared_ptr<const Model> model_;
    std::vector<Order> orders_;  // of the orders file
    std::unique_ptr<RunJournal> journal_;
    std::unique_ptr<Company> company_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<TraceFile> trace_;
    std::optional<ContactsFile> contacts_;
    std::vector<RobotPath> paths_;
    double world_speed_ = 0;  // simulated seconds a real second; 0: as fast as possible
    Tick start_ = 0;
    bool abandoned_ = false;  // nobody is left who has the states
};

void print(const Error& error);

}  // namespace roboss
