// Saves states.
#include "app/commands/save_command.h"

#include <fmt/format.h>

#include <memory>

#include "app/commands/control_command.h"
#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/run/journal_location.h"
#include "app/run/run.h"
#include "core/output_check.h"

namespace roboss {
namespace {

const char* const kSaveFooter =
    R"(The file has the format of `roboss run --save`: `roboss run WORLD --from FILE` continues from it; `roboss replay` and
`roboss journal` read it too.

Examples:
  roboss save half.roboss --from run.journal@30       from a journal
  roboss save half.roboss                             from the run of this computer
  roboss save half.roboss --simulation mine           of several, the one of this name; with network options, from
                                                      one on another computer, which writes the file there

Exit codes: 0 done, 1 the journal cannot be read or no run was found, 2 wrong usage, 3 the file cannot be
written.)";

struct SaveOptions {
    MemberOptions member;
    std::string file, from;
    bool overwrite = false, json = false;
};

int save_from_journal(const SaveOptions& o) {
    Result<OpenedJournalTime> opened = open_location(o.from);
    if (!opened) return print(opened.error()), kBadInput;
    const auto& [location, journal, time] = opened.value();
    OutputCheck check;
    check.reads(location.file);
    check.writes("the command", o.file, "saved state");
    if (Result<> fine = check.check(); !fine) return print(fine.error()), kBadInput;
    const Model& model = *time.model;
    Result<SavedRun> run = journal.run_at(time.branch, model, time.tick);
    if (!run) return print(run.error()), kBadInput;
    if (Result<> saved = save_run(o.file, model, run.value()); !saved)
        return print(saved.error()), kRunFailed;
    const std::string text = fmt::format("saved {:.6f} s (tick {}) in {}",
                                         static_cast<double>(time.tick) * model.dt_s, time.tick, o.file);
    say("{}\n", o.json ? done_json(time.tick, text) : text);
    return kSuccess;
}

}  // namespace

void add_save_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("save", "save one point in time of a journal or of a running simulation");
    command->footer(kSaveFooter);
    auto o = std::make_shared<SaveOptions>();
    command->add_option("file", o->file, "the file to write")->required();
    command->add_option(
        "--from", o->from,
        "FILE, FILE@TIME or FILE#BRANCH@TIME of a journal; without it, a running simulation saves its state");
    command->add_flag("--overwrite", o->overwrite,
                      "of a running simulation: replace a saved run of this name");
    command->add_flag("--json", o->json, "print what was done as one JSON object");
    add_member_options(*command, o->member);
    command->callback([o, command, &exit_code] {
        note_given(*command, o->member);
        exit_code = o->from.empty()
                        ? ask_controller(o->member, save_words(o->file, o->overwrite), {false, o->json})
                        : save_from_journal(*o);
    });
}

}  // namespace roboss
