// Inspects, verifies and exports journals.
#include "app/commands/journal_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/output/say.h"
#include "app/processes/interrupt.h"
#include "app/run/journal_location.h"
#include "app/run/run.h"
#include "app/worlds/orders_file.h"
#include "core/hash.h"
#include "simulation/replay.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

const char* const kJournalFooter =
    R"(A journal is written by `roboss run|controller --journal FILE`; a file written by --save is a small journal.
FILE#BRANCH names a branch (default: the newest), FILE@TIME a point in time, in s; FILE#2@1.5 names both.

Exit codes: 0 done, 1 the file is missing, damaged, or of another version, 2 wrong usage, 3 verify found a difference.
Examples:
  roboss journal info run.journal
  roboss journal verify run.journal --threads 4
  roboss journal export run.journal --orders > orders.jsonl
  roboss run world.sdf --orders orders.jsonl)";

struct JournalOptions {
    std::string location;
    bool json = false, all = false, orders = false;
    int threads = 1;
};

void print_json(const Json& o) {
    say("{}\n", o.dump(2, ' ', false, Json::error_handler_t::replace));
}

/// Opens the journal that the options name; nullopt if it cannot be opened (it has been reported).
struct Opened {
    Journal journal;
    JournalLocation location;
};
std::optional<Opened> open(const JournalOptions& o, bool thorough) {
    Result<JournalLocation> location = parse_location(o.location);
    if (!location) return print(location.error()), std::nullopt;
    Result<Journal> journal = Journal::open(location.value().file, thorough);
    if (!journal) return print(journal.error()), std::nullopt;
    return Opened{std::move(journal).value(), std::move(location).value()};
}

Json to_json(const Branch& b, double dt_s) {
    return {{"branch", b.id},
            {"parent", b.parent},
            {"reason", b.reason},
            {"world_file", b.world_file},
            {"model_hash", to_hex(b.model_hash)},
            {"seed", b.seed},
            {"tick", b.tick},
            {"first_tick", b.first},
            {"first_s", static_cast<double>(b.first) * dt_s},
            {"time_s", static_cast<double>(b.tick) * dt_s},
            {"end_tick", b.end},
            {"end_s", static_cast<double>(b.end) * dt_s},
            {"committed_tick", b.committed},
            {"committed_hash", to_hex(b.hash)},
            {"checkpoints", b.checkpoints},
            {"orders", b.orders},
            {"bytes", b.bytes}};
}

/// Branches whose parent was pruned stand at the root.
void print_tree(const Journal& journal, BranchId parent, int depth, double dt) {
    for (const Branch& b : journal.branches()) {
        if ((journal.find(b.parent) != nullptr ? b.parent : 0) != parent) continue;
        say("{:{}}branch {}  {:.3f} s to {:.3f} s  {} checkpoints, {} orders, {:.1f} MB  ({}, hash {} at "
            "tick {})\n",
            "", 2 * depth, b.id, static_cast<double>(b.first) * dt, static_cast<double>(b.end) * dt,
            b.checkpoints, b.orders, 1e-6 * static_cast<double>(b.bytes), b.reason, to_hex(b.hash),
            b.committed);
        print_tree(journal, b.id, depth + 1, dt);
    }
}

Json bookmarks_json(const Journal& journal, double dt_s) {
    Json list = Json::array();
    for (const Bookmark& mark : journal.bookmarks())
        list.push_back({{"id", mark.id},
                        {"branch", mark.branch},
                        {"tick", mark.tick},
                        {"time_s", static_cast<double>(mark.tick) * dt_s},
                        {"name", mark.name}});
    return list;
}

void print_bookmarks(const Journal& journal, double dt_s) {
    for (const Bookmark& mark : journal.bookmarks())
        say("bookmark {}  {:.3f} s of branch {}  {}\n", mark.id, static_cast<double>(mark.tick) * dt_s,
            mark.branch, mark.name);
}

int info(const JournalOptions& o) {
    const std::optional<Opened> opened = open(o, false);
    if (!opened) return kBadInput;
    const Journal& journal = opened->journal;
    Json branches = Json::array();
    double dt_s = 0;  // the same for all branches
    double recorded_s = 0;
    std::size_t robots = 0;
    for (const Branch& b : journal.branches()) {
        Result<std::shared_ptr<const Model>> model = journal.model(b);
        if (!model) return print(model.error()), kBadInput;
        dt_s = model.value()->dt_s;
        recorded_s += static_cast<double>(b.end - b.first) * dt_s;
        robots = model.value()->robots.size();
        branches.push_back(to_json(b, dt_s));
        branches.back()["robots"] = robots;
        branches.back()["dt_s"] = dt_s;
    }
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(journal.path(), none);
    const double mb_per_min = recorded_s > 0 ? 60e-6 * static_cast<double>(bytes) / recorded_s : 0.0;
    if (o.json) {
        print_json({{"file", journal.path()},
                    {"version", journal.version()},
                    {"bytes", bytes},
                    {"mb_per_recorded_min", mb_per_min},
                    {"branches", branches},
                    {"bookmarks", bookmarks_json(journal, dt_s)}});
        return kSuccess;
    }
    const Branch& youngest = journal.branches().back();
    say("journal           {}, written by RoBOSS {}\n", journal.path(), journal.version());
    say("world             {}, model hash {}\n", youngest.world_file, to_hex(youngest.model_hash));
    say("robots            {}, step {:g} ms, seed {}\n", robots, dt_s * 1e3, youngest.seed);
    say("size              {:.1f} MB, {:.2f} MB per recorded minute\n", 1e-6 * static_cast<double>(bytes),
        mb_per_min);
    print_tree(journal, 0, 0, dt_s);
    print_bookmarks(journal, dt_s);
    return kSuccess;
}

Json to_json(const Stretch& s) {
    return {
        {"branch", s.branch}, {"from_tick", s.from},         {"until_tick", s.until},        {"next", s.next},
        {"good", s.good()},   {"kept_hash", to_hex(s.kept)}, {"found_hash", to_hex(s.found)}};
}

std::string line_of(const Stretch& s) {
    const std::string beginning = s.next != 0 ? fmt::format("the beginning of branch {}: ", s.next) : "";
    return fmt::format(
        "branch {}  ticks {} to {}  {}{}\n", s.branch, s.from, s.until, beginning,
        s.good() ? "equal"
                 : fmt::format("DIFFERENT: recorded {}, replayed {}", to_hex(s.kept), to_hex(s.found)));
}

/// Branches at whose ends rows of the log could be missing unnoticed.
std::vector<BranchId> open_ends(const Journal& journal, const std::vector<Branch>& branches) {
    std::vector<BranchId> open;
    for (const Branch& b : branches)
        if (!journal.has_end(b.id)) open.push_back(b.id);
    return open;
}

/// How far a verification is, on standard error: a line that changes on a terminal, else one every ten
/// seconds.
class VerifyProgress {
  public:
    explicit VerifyProgress(Tick all) : all_(std::max<Tick>(1, all)) {}
    void show(Tick done) {
        const auto now = std::chrono::steady_clock::now();
        if (now - shown_ < (terminal_ ? std::chrono::milliseconds(500) : std::chrono::seconds(10))) return;
        shown_ = now;
        say(stderr, "{}verified {} of {} ticks ({:.0f} %){}", terminal_ ? "\r" : "roboss: ", done, all_,
            100.0 * static_cast<double>(done) / static_cast<double>(all_), terminal_ ? "  " : "\n");
        std::fflush(stderr);
        open_ = terminal_;
    }
    /// Before other text.
    void clear() {
        if (std::exchange(open_, false)) say(stderr, "\n");
    }

  private:
    Tick all_;
    bool terminal_ = isatty(STDERR_FILENO) == 1, open_ = false;
    std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

int verify(const JournalOptions& o) {
    const std::optional<Opened> opened = open(o, true);
    if (!opened) return kBadInput;
    const Journal& journal = opened->journal;
    if (Result<> whole = journal.inspect(); !whole) return print(whole.error()), kBadInput;
    watch_for_interrupts();
    std::vector<Branch> branches;
    Tick all = 0, done_before = 0;
    for (const Branch& b : journal.branches()) {
        if (opened->location.branch && *opened->location.branch != b.id) continue;
        branches.push_back(b);
        for (const Stretch& s : stretches_of(journal, b)) all += s.until - s.from;
    }
    VerifyProgress progress(all);
    Json stretches = Json::array();
    std::size_t bad = 0;
    const auto report = [&](const Stretch& s) {
        bad += s.good() ? 0 : 1;
        done_before += s.until - s.from;
        stretches.push_back(to_json(s));
        progress.clear();
        if (!o.json) say("{}", line_of(s));
    };
    const auto watch = [&](const Stretch& s, Tick now) {
        progress.show(done_before + now - s.from);
        return !interrupted();
    };
    for (const Branch& b : branches) {
        auto done = roboss::verify(journal, b, {static_cast<unsigned>(o.threads), 0}, report, watch);
        progress.clear();
        if (!done) return print(done.error()), interrupted() ? kInterrupted : kRunFailed;
    }
    const std::vector<BranchId> unended = open_ends(journal, branches);
    if (o.json) {
        print_json({{"file", journal.path()},
                    {"good", bad == 0},
                    {"different", bad},
                    {"open_ends", unended},
                    {"stretches", stretches}});
    } else {
        for (const BranchId branch : unended)
            say("branch {}  its end is open: the run still writes or was killed, or an older version wrote "
                "it; "
                "rows that are missing there are not noticed\n",
                branch);
        say("{} stretches replayed, {} different\n", stretches.size(), bad);
    }
    return bad == 0 ? kSuccess : kRunFailed;
}

void print_line(const Json& o) {
    say("{}\n", o.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// The log that a branch of a lineage has from a tick on, as JSON lines, in the order of time. Orders that
/// apply when the next branch has begun are in the log of that one.
int export_part(const Journal& journal, const Lineage& lineage, const Lineage::Part& part, Tick from,
                bool orders_only) {
    Result<Branch> branch = journal.branch(part.branch);
    if (!branch) return print(branch.error()), kBadInput;
    Result<std::shared_ptr<const Model>> read = journal.model(branch.value());
    if (!read) return print(read.error()), kBadInput;
    const Model& model = *read.value();
    constexpr Tick kAll = std::numeric_limits<Tick>::max();
    const Tick until = lineage.after(part) != nullptr ? part.until : kAll;
    Result<LogBatch> log = journal.log(branch.value(), from, until);
    if (!log) return print(log.error()), kBadInput;
    const auto seconds = [&](Tick tick) { return static_cast<double>(tick) * model.dt_s; };
    if (!orders_only) {
        print_line(to_json(branch.value(), model.dt_s));
        for (const CheckpointEntry& c : journal.checkpoints(branch.value()))
            if (c.tick < until)
                print_line({{"checkpoint", c.tick}, {"t", seconds(c.tick)}, {"state_hash", to_hex(c.hash)}});
        for (const auto& [client, name] : log.value().clients)
            print_line({{"client", client}, {"name", name}});
        for (const LogNote& note : log.value().notes)
            print_line({{"note", note.text}, {"tick", note.tick}, {"t", seconds(note.tick)}});
    }
    for (const LoggedOrder& o : log.value().orders) {
        if (o.order.apply_at >= until) continue;
        if (Result<> good = check_order(model, o.order); !good) return print(good.error()), kBadInput;
        say("{}\n", order_line(o.order, model));
    }
    return kSuccess;
}

int export_log(const JournalOptions& o) {
    const std::optional<Opened> opened = open(o, false);
    if (!opened) return kBadInput;
    Result<JournalTime> time = find_time(opened->journal, opened->location);
    if (!time) return print(time.error()), kBadInput;
    const Lineage& lineage = time.value().lineage;
    if (const std::string text = ways(lineage, time.value().model->dt_s); !text.empty())
        say(stderr, "roboss: the export {} [branches]\n", text);
    const bool all = !opened->location.time_s.has_value();
    for (const Lineage::Part& part : lineage.parts()) {
        if (!all && part.until <= time.value().tick && lineage.after(part) != nullptr) continue;
        const int code = export_part(opened->journal, lineage, part, all ? -1 : time.value().tick, o.orders);
        if (code != kSuccess) return code;
    }
    return kSuccess;
}

}  // namespace

void add_journal_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("journal", "inspect a journal: info, verify, export");
    command->footer(kJournalFooter);
    command->require_subcommand(1);
    auto o = std::make_shared<JournalOptions>();
    const auto add = [&](const char* name, const char* what, int (*act)(const JournalOptions&)) {
        CLI::App* sub = command->add_subcommand(name, what);
        sub->footer(kJournalFooter);
        sub->add_option("file", o->location, "FILE, FILE#BRANCH or FILE@TIME")->required();
        sub->callback([o, act, &exit_code] { exit_code = act(*o); });
        return sub;
    };
    add("info", "print the contents: world, branches, checkpoints, orders", info)
        ->add_flag("--json", o->json, "print one JSON object");
    CLI::App* sub = add("verify", "replay every stretch between two checkpoints and compare hashes", verify);
    sub->add_flag("--json", o->json, "print one JSON object");
    sub->add_option("--threads", o->threads, "number of threads")
        ->check(whole_number(1, 1024))
        ->capture_default_str();
    add("export",
        "print a branch, with the history that led to it, as JSON lines: checkpoints, Clients, notes, orders "
        "(from TIME on, if given)",
        export_log)
        ->add_flag("--orders", o->orders, "print only the orders, in the format of `roboss run --orders`");
}

}  // namespace roboss
