// Fetches the Model, drives the Simulator role, and leaves the run in an orderly way on request.
#include "app/commands/simulator_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/processes/interrupt.h"
#include "app/processes/local_process.h"
#include "app/processes/member.h"
#include "app/processes/memory_guard.h"
#include "app/processes/threads.h"
#include "core/hash.h"
#include "roles/simulator/simulator.h"

namespace roboss {
namespace {

constexpr std::int64_t kGoodbye_ms = 5'000;

const char* const kSimulatorFooter =
    R"(A Simulator needs no world file: it receives the compiled Model from the Controller. Ctrl-C (or SIGTERM) makes it
leave: its robots move to other Simulators first. A second Ctrl-C ends it immediately; the run stalls briefly and its
results do not change.

Exit codes: 0 the run has ended or the Simulator has left, 1 an option is wrong, no Controller was found, or the
Controller refused it, 3 the run has failed, or the memory was not enough.)";

struct SimulatorProcessOptions {
    MemberOptions member;
    int threads = 0;  // 0: the cores of this computer
    std::size_t lanes = kMostLanes;
};

class SimulatorProcess {
  public:
    explicit SimulatorProcess(const SimulatorProcessOptions& options)
        : o_(options),
          member_("simulator", options.member),
          pool_(static_cast<unsigned>(threads_of_each(options.threads, 1))) {}

    int go() {
        if (!member_.open()) return member_.exit_code();
        for (;;) {
            const Address self = member_.new_address(Role::kSimulator);
            const auto model = member_.fetch_model(self);
            if (!model) return member_.exit_code();
            member_.report(
                fmt::format("received world '{}' (model hash {})", model->name, to_hex(model->hash)));
            SimulatorOptions role;
            role.lanes = o_.lanes;
            role.name = process_name(getpid());
            Simulator simulator(model, self, role, pool_);
            if (!serve(simulator)) return member_.exit_code();
            if (interrupted()) return kSuccess;
            if (simulator.outdated()) {
                member_.report("the world has changed; fetching it again");
            } else if (simulator.dismissed()) {
                member_.report("dismissed by the Controller");
                return kSuccess;
            } else if (!simulator.over().empty()) {
                const int code = member_.end({simulator.over(), simulator.failed()});
                if (!o_.member.stay) return code;
            } else if (!o_.member.stay && !simulator.refusal().empty()) {
                return member_.report_error({"refused by the Controller: " + simulator.refusal(),
                                             "start it again", "refused"}),
                       kBadInput;
            }
        }
    }

  private:
    /// Until the role is done. False: the Member has ended.
    bool serve(Simulator& simulator) {
        std::int64_t asked_ms = 0;
        while (!simulator.gone()) {
            if (interrupted()) {
                const std::int64_t now = member_.bus().now_ms();
                if (asked_ms == 0) asked_ms = now;
                simulator.leave();
                if (!member_.bus().present(kControllerAddress) || now - asked_ms > kGoodbye_ms) return true;
            }
            if (const std::optional<std::string> why = guard_.exceeded()) return leave_at_once(*why);
            simulator.advance(member_.bus());
            for (const std::string& line : simulator.take_notices()) member_.report(line);
            if (!member_.wait()) return false;
        }
        return true;
    }

    /// Others bring back its robots from a checkpoint: handing them over would take memory.
    bool leave_at_once(const std::string& why) {
        member_.leave_at_once({"this Simulator leaves: " + why,
                               "give it more memory, or let more Simulators share the robots",
                               "out-of-memory"});
        return false;
    }

    MemoryGuard guard_;
    const SimulatorProcessOptions& o_;
    Member member_;
    ThreadPool pool_;
};

}  // namespace

void add_simulator_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("simulator", "join a Controller's run and step robots for it");
    command->footer(kSimulatorFooter);
    auto options = std::make_shared<SimulatorProcessOptions>();
    command
        ->add_option(
            "--threads", options->threads,
            "threads; the result is the same (default: one per core of this computer; if several Simulators "
            "share the computer, give each its share)")
        ->check(whole_number(1, 1024));
    command
        ->add_option(
            "--lanes", options->lanes,
            "SIMD lanes: largest number of robots of a type stepped together: 1, 2 (NEON), 4 (AVX2, NEON) "
            "or 8 (AVX-512, NEON), with floats twice as many; the result is the same")
        ->check(whole_number(1, kMostLanes))
        ->capture_default_str();
    command->add_flag("--stay", options->member.stay, "wait for the next run when one ends");
    add_member_options(*command, options->member);
    command->callback([options, &exit_code] { exit_code = SimulatorProcess(*options).go(); });
}

}  // namespace roboss
