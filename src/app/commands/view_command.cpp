// Joins the network of a run and serves the viewer.
#include "app/commands/view_command.h"

#include "app/commands/exit_codes.h"
#include "app/processes/interrupt.h"
#include "app/processes/member.h"
#include "app/viewer/viewer.h"

namespace roboss {
namespace {

const char* const kViewFooter =
    R"(The viewer needs no world file: it gets the Model and its visuals from the Controller when the first browser opens the
page. It keeps running when the Controller ends, and shows the next run of that name. Watching a run does not change its
result; orders given in the viewer do.

Examples:
  roboss view                                      a run on this computer (`roboss controller ...`)
  roboss view --view 0.0.0.0:8090                  for browsers on other computers, over TLS, with a token

Exit codes: 0 ended by Ctrl-C, 1 an option is wrong, or no Controller was found in time (--patience).)";

struct ViewCommandOptions {
    MemberOptions member;
    ViewerOptions viewer;
};

int view(const ViewCommandOptions& o) {
    Member member("view", o.member);
    Result<std::unique_ptr<Gateway>> gateway = open_viewer(o.viewer, true, o.member.network.insecure);
    if (!gateway) return member.report_error(gateway.error()), kBadInput;
    if (!member.open()) return kBadInput;
    print_urls(*gateway.value());
    while (!interrupted()) {
        gateway.value()->advance(member.bus());
        for (const std::string& line : gateway.value()->take_notices()) member.report(line);
        if (!member.wait()) return member.exit_code();
    }
    gateway.value()->say_farewell({"'roboss view' was stopped; the run itself may continue"});
    member.bus().flush(500);
    return kSuccess;
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("view", "serve the viewer of a running simulation to browsers");
    command->footer(kViewFooter);
    auto options = std::make_shared<ViewCommandOptions>();
    add_viewer_options(*command, options->viewer, ViewerDefault::kAlways);
    add_member_options(*command, options->member);
    command->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace roboss
