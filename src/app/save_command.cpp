// Saving states.
#include "app/save_command.h"

#include <fmt/format.h>

#include <memory>

#include "app/control_command.h"
#include "app/exit_codes.h"
#include "app/journal_location.h"
#include "app/run.h"

namespace roboss {
namespace {

const char* const kFooter =
    R"(The file is as `roboss run --save` writes it: `--from FILE` goes on from it, and `roboss replay` and `roboss journal`
read it too.
Examples:
  roboss save half.roboss --from run.journal@30       out of a journal
  roboss save half.roboss --simulation mine           of a running simulation: its Controller writes the file, on its
                                                      computer

Exit codes: 0 done, 1 it cannot be read, 2 wrong usage, 3 it cannot be written.)";

struct SaveOptions {
    MemberOptions member;
    std::string file, from;
};

int save_from_journal(const SaveOptions& o) {
    Result<OpenedJournalTime> opened = open_moment(o.from);
    if (!opened) return print(opened.error()), kBadInput;
    const auto& [location, journal, time] = opened.value();
    const Model& model = *time.model;
    Result<SavedRun> run = journal.run_at(time.branch, model, time.tick);
    if (!run) return print(run.error()), kBadInput;
    if (Result<> saved = save_run(o.file, model, run.value()); !saved)
        return print(saved.error()), kRunFailed;
    fmt::print("saved {:.6f} s (tick {}) in {}\n", static_cast<double>(time.tick) * model.dt_s, time.tick,
               o.file);
    return kDone;
}

}  // namespace

void add_save_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("save", "save one point in time of a journal or of a running simulation");
    command->footer(kFooter);
    auto o = std::make_shared<SaveOptions>();
    command->add_option("file", o->file, "the file to write")->required();
    command->add_option(
        "--from", o->from,
        "FILE, FILE@TIME or FILE#BRANCH@TIME of a journal; without it, a running simulation is asked");
    add_member_options(*command, o->member);
    command->callback([o, &exit_code] {
        exit_code = o->from.empty() ? ask_controller(o->member, {"save", o->file}) : save_from_journal(*o);
    });
}

}  // namespace roboss
