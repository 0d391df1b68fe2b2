// Fetches the Model, loads the program, and drives it until the run ends.
#include "app/commands/client_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "app/commands/exit_codes.h"
#include "app/processes/client_loop.h"
#include "app/processes/crash_report.h"
#include "app/processes/member.h"
#include "client/plugin.h"
#include "client/program_host.h"
#include "core/error_text.h"

namespace roboss {
namespace {

const char* const kClientFooter =
    R"(PROGRAM is a shared library as for `roboss run --client`; the source is the same. It may attach to a run at any time.
`roboss controller WORLD --await-client NAME` starts a run that waits for it.

Two Clients of a run cannot have the same name. One that has died is succeeded by the next of its name and times: that
is asked again what it did not answer.

Exit codes: 0 the run has ended or the Client has left, 1 an option is wrong, no Controller was found, or it refused the
Client, 3 the program threw an exception, or the run has failed.)";

struct ClientProcessOptions {
    MemberOptions member;
    std::string program, name;
};

class ClientProcess {
  public:
    explicit ClientProcess(const ClientProcessOptions& options)
        : o_(options), member_("client", options.member) {}

    int go() {
        report_crashes({});
        Result<std::unique_ptr<ControlProgram>> program = load_control_program(o_.program);
        if (!program) return member_.report_error(program.error()), kBadInput;
        if (!member_.open()) return kBadInput;
        const Address self = member_.new_address(Role::kClient);
        const auto model = member_.fetch_model(self);
        if (!model) return member_.exit_code();
        const std::string name =
            o_.name.empty() ? std::filesystem::path(o_.program).filename().string() : o_.name;
        if (Result<BusClientOptions> times = client_options(*program.value(), *model, name); !times)
            return member_.report_error(times.error()), kBadInput;
        auto host = std::make_unique<ProgramHost>(model, self, name, std::move(program).value());
        host->client().set_visuals(member_.visuals());
        for (;;) {
            const std::optional<int> ended = serve(*host);
            if (ended) return *ended;
            member_.report("the world has changed; fetching it again");  // and start() is called again
            const Address again = member_.new_address(Role::kClient);
            const auto changed = member_.fetch_model(again);
            if (!changed) return member_.exit_code();
            host = std::make_unique<ProgramHost>(changed, again, name, host->take_program());
            host->client().set_visuals(member_.visuals());
        }
    }

  private:
    /// The exit code; nullopt: the run has a new Model.
    std::optional<int> serve(ProgramHost& host) {
        const ClientEnd end = serve_client(member_, host.client(), [&] {
            host.advance(member_.bus());
            for (const std::string& refusal : host.client().take_refusals()) member_.report(refusal);
            return host.failure().empty();
        });
        if (end == ClientEnd::kNewModel) return std::nullopt;
        if (end == ClientEnd::kRefused) return report_refusal(host.client().refusal());
        if (!host.failure().empty()) {
            member_.report_error(
                error_of_text("", host.failure(), "fix the control program", "client-failed"));
            return kRunFailed;
        }
        return client_exit_code(member_, host.client());
    }

    int report_refusal(const std::string& why) {
        member_.report_error(
            error_of_text("the run refuses this Client: ", why, "start it again", "refused"));
        return kBadInput;
    }

    const ClientProcessOptions& o_;
    Member member_;
};

}  // namespace

void add_client_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("client", "attach a control program to a running Controller");
    command->footer(kClientFooter);
    auto options = std::make_shared<ClientProcessOptions>();
    command->add_option("program", options->program, "the control program: a shared library")->required();
    command->add_option("--name", options->name, "name of the Client in the run (default: the file name)");
    add_member_options(*command, options->member);
    command->callback([options, &exit_code] { exit_code = ClientProcess(*options).go(); });
}

}  // namespace roboss
