// Gets the Model, gives the Simulator role its turns, and leaves in good order when asked.
#include "app/simulator_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/local_process.h"
#include "app/member.h"
#include "app/threads.h"
#include "core/hash.h"
#include "roles/simulator.h"

namespace roboss {
namespace {

constexpr std::int64_t kGoodbye_ms = 5'000;

const char* const kFooter =
    R"(It needs no world: it gets the compiled Model from the Controller. Ctrl-C (or SIGTERM) makes it leave in good order:
what it holds goes elsewhere first. A second one ends it at once, which costs the run a moment and no result.

Exit codes: 0 the run is over or it has left, 1 an option is wrong, no Controller came or it was refused.)";

struct SimulatorProcessOptions {
    MemberOptions member;
    int threads = 0;  // 0: the cores of this computer
    std::size_t lanes = kMostLanes;
    bool stay = false;
};

class SimulatorProcess {
  public:
    explicit SimulatorProcess(const SimulatorProcessOptions& options)
        : o_(options),
          member_("simulator", options.member),
          pool_(static_cast<unsigned>(threads_of_each(options.threads, 1))) {}

    int go() {
        if (!member_.open()) return kBadInput;
        for (;;) {
            const Address self = member_.new_address(Role::kSimulator);
            const auto model = member_.fetch_model(self);
            if (!model) return interrupted() ? kDone : kBadInput;
            member_.say(fmt::format("has the world '{}' (model hash {})", model->name, to_hex(model->hash)));
            SimulatorOptions role;
            role.lanes = o_.lanes;
            role.name = process_name(getpid());
            Simulator simulator(model, self, role, pool_);
            if (!serve(simulator)) return kBadInput;
            if (interrupted()) return kDone;
            if (simulator.outdated()) {
                member_.say("the world has changed, fetches it again");
            } else if (simulator.dismissed()) {
                member_.say("sent home by the Controller");
                return kDone;
            } else if (!simulator.over().empty()) {
                member_.say(simulator.over());
                if (!o_.stay) return kDone;
            } else if (!o_.stay && !simulator.refusal().empty()) {
                return member_.complain(
                           {"the Controller refuses it: " + simulator.refusal(), "start it again"}),
                       kBadInput;
            }
        }
    }

  private:
    /// Until the role is done. False: the Controller was away for too long.
    bool serve(Simulator& simulator) {
        std::int64_t asked_ms = 0;
        while (!simulator.gone()) {
            if (interrupted()) {
                const std::int64_t now = member_.bus().now_ms();
                if (asked_ms == 0) asked_ms = now;
                simulator.leave();
                if (!member_.bus().present(kControllerAddress) || now - asked_ms > kGoodbye_ms) return true;
            }
            simulator.advance(member_.bus());
            for (const std::string& line : simulator.take_notices()) member_.say(line);
            if (!member_.wait()) return false;
        }
        return true;
    }

    const SimulatorProcessOptions& o_;
    Member member_;
    ThreadPool pool_;
};

}  // namespace

void add_simulator_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("simulator", "step robots for a Controller anywhere");
    command->footer(kFooter);
    auto options = std::make_shared<SimulatorProcessOptions>();
    command
        ->add_option("--threads", options->threads,
                     "threads it steps its islands with; the same result (default: one for each core of this "
                     "computer; where several Simulators share it, give each its part)")
        ->check(CLI::Range(1, 1024));
    command
        ->add_option("--lanes", options->lanes,
                     "robots of a type stepped at once, at most: 1, 4 (AVX2) or 8 (AVX-512), with floats 1, "
                     "8 or 16; the same result")
        ->check(CLI::Range(std::size_t{1}, kMostLanes))
        ->capture_default_str();
    command->add_flag("--stay", options->stay, "wait for the next run when one is over");
    add_member_options(*command, options->member);
    command->callback([options, &exit_code] { exit_code = SimulatorProcess(*options).go(); });
}

}  // namespace roboss
