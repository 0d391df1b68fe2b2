// roboss-fuzz: checks properties of the engine on random worlds, for a range of seeds, or for one seed with a
// line per tick.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "app/commands/numbers.h"
#include "core/output_check.h"
#include "core/thread_pool.h"
#include "fuzz/property.h"
#include "fuzz/shot.h"

namespace roboss::fuzz {
namespace {

const char* const kFooter =
    R"(A seed determines a world, the same on every machine. Kinds of world, time steps and spins alternate from seed to seed;
--kind, --dt, --spin and --speed fix them instead.

Examples:
  roboss-fuzz                                          all properties, seeds 0 to 47
  roboss-fuzz --property energy --seeds 0..1000        one property, a thousand seeds
  roboss-fuzz --property energy --kind tree --dt 0.004 --spin 30 --seeds 0..60
  roboss-fuzz --property energy --seed 17              replays one seed and prints a line per tick
  roboss-fuzz world 17                                 one seed, all properties of a world
  roboss-fuzz cluster 17                               one seed, a cluster with faults and losses
  roboss-fuzz --seeds 0..10000 --json soak.json        the soak of docs/testing.md (an hour or two)
  roboss-fuzz --list                                   properties and kinds of world

For each failing seed, the command that replays it is printed. A seed whose state is not finite has an infinite figure.

Exit codes: 0 all hold, 1 a seed fails (or a file could not be written), 2 wrong usage.)";

struct Options {
    std::vector<std::string> properties{"all"}, kinds;
    std::string seeds = "0..48", json;
    std::optional<std::uint64_t> seed, one_seed;
    std::optional<double> dt_s, spin, speed, seconds;
    unsigned jobs = 1, every = 1;
    bool list = false;
};

/// Those of one world in one process.
std::vector<std::string> world_properties() {
    std::vector<std::string> names;
    for (const Property& p : properties())
        if (p.name != "cluster" && p.name != "branches") names.push_back(p.name);
    return names;
}

/// `world SEED` and `cluster SEED`: one seed in words that a bug report can hold.
void add_commands(CLI::App& app, Options& o) {
    const auto add = [&](const char* name, const char* what, std::vector<std::string> properties) {
        CLI::App* sub = app.add_subcommand(name, what);
        sub->add_option("seed", o.one_seed, "the seed")->required();
        sub->callback([&o, properties = std::move(properties)] {
            o.properties = properties;
            o.seeds = std::to_string(*o.one_seed) + ".." + std::to_string(*o.one_seed + 1);
        });
    };
    add("world", "check all properties of one world, with the invariants of its states", world_properties());
    add("cluster", "run one cluster with faults and losses, and compare its state hash", {"cluster"});
}

struct Range {
    std::uint64_t from = 0, until = 0;
};

/// "A..B": A, ..., B - 1.
std::optional<Range> parse_range(const std::string& text) {
    unsigned long long from = 0, until = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%llu..%llu%c", &from, &until, &rest) != 2 || until <= from)
        return std::nullopt;
    return Range{from, until};
}

std::vector<std::string> names_of(std::span<const Property> all) {
    std::vector<std::string> names{"all"};
    for (const Property& p : all) names.push_back(p.name);
    return names;
}

void add_options(CLI::App& app, Options& o) {
    app.footer(kFooter);
    app.add_option("--property", o.properties, "check this property only (may be repeated)")
        ->check(CLI::IsMember(names_of(properties())))
        ->capture_default_str();
    app.add_option("--seeds", o.seeds, "seeds A to B - 1, as A..B")->capture_default_str();
    app.add_option("--seed", o.seed, "replay this seed only and print a line per tick");
    app.add_option("--kind", o.kinds, "use these kinds of world only (may be repeated; see --list)");
    app.add_option("--dt", o.dt_s, "time step of every world, s")->check(CLI::Range(1e-5, 5e-3));
    app.add_option("--spin", o.spin, "largest initial angular speed of bases and joints, rad/s")
        ->check(non_negative_number());
    app.add_option("--speed", o.speed, "speed of shots, m/s (ghost, tunnel)")->check(positive_number());
    app.add_option("--seconds", o.seconds, "simulated time of each seed, s (default: set by each property)")
        ->check(positive_number());
    app.add_option("--jobs", o.jobs, "number of seeds run in parallel; results do not depend on it")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--every", o.every, "with --seed: print every N-th tick")->check(CLI::Range(1, 1000000));
    app.add_option("--json", o.json, "write the figure of every seed to this JSON file");
    app.add_flag("--list", o.list, "print the properties and kinds of world, and exit");
}

void print_list() {
    fmt::print("properties:\n");
    for (const Property& p : properties()) {
        fmt::print("  {:10} {}\n             figure: {}; {} s each\n             kinds:", p.name, p.claim,
                   p.figure, p.seconds);
        for (const std::string& kind : p.kinds) fmt::print(" {}", kind);
        fmt::print("\n");
    }
    fmt::print("kinds of world:\n");
    for (const SceneKind& kind : scene_kinds()) fmt::print("  {:14} {}\n", kind.name, kind.what);
    for (const ShotKind& kind : shot_kinds()) fmt::print("  {:14} {}\n", kind.name, kind.what);
}

/// The property as the options narrow it; nullopt: none of the wanted kinds is one of its own.
std::optional<Property> narrowed(Property property, const Options& o) {
    if (!o.kinds.empty())
        std::erase_if(property.kinds, [&](const std::string& kind) {
            return std::ranges::find(o.kinds, kind) == o.kinds.end();
        });
    if (property.kinds.empty()) return std::nullopt;
    if (o.dt_s) property.steps_s = {*o.dt_s};
    if (o.spin) property.spins = {*o.spin};
    if (o.speed) property.speeds = {*o.speed};
    if (o.seconds) property.seconds = *o.seconds;
    return property;
}

struct Row {
    const Property* property = nullptr;  // as registered
    Request request;
    Finding finding;
};

std::string failure_line(const Row& row) {
    return fmt::format("FAILED {} at {:.4f} s: {} {:.4g}\n  replay: {}\n", row.property->name,
                       static_cast<double>(row.finding.tick) * row.request.setting.dt_s, row.finding.text,
                       row.finding.figure, replay_command(*row.property, row.request));
}

/// Prints failures immediately, and progress every ten seconds.
class Progress {
  public:
    Progress(const Property& property, std::size_t seeds) : property_(property), seeds_(seeds) {}

    void done(const Row& row) {
        const std::lock_guard lock(mutex_);
        ++done_, failed_ += row.finding.failed;
        if (row.finding.failed) fmt::print("{}", failure_line(row)), std::fflush(stdout);
        const auto now = std::chrono::steady_clock::now();
        if (now - printed_ < std::chrono::seconds(10)) return;
        printed_ = now;
        fmt::print(stderr, "{}: {} of {} seeds, {} failed\n", property_.name, done_, seeds_, failed_);
    }

  private:
    const Property& property_;
    std::size_t seeds_, done_ = 0, failed_ = 0;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point printed_ = std::chrono::steady_clock::now();
};

std::vector<Row> run_seeds(const Property& registered, const Property& property, Range range,
                           ThreadPool& pool) {
    std::vector<Row> rows(range.until - range.from);
    Progress progress(registered, rows.size());
    pool.run(rows.size(), [&](std::size_t i, std::size_t) {
        Row& row = rows[i];
        row.property = &registered;
        row.request.setting = property.setting(range.from + i);
        row.request.seconds = property.seconds;
        row.finding = property.run(row.request);
        progress.done(row);
    });
    return rows;
}

struct Tally {
    int seeds = 0, failed = 0, not_finite = 0;
    double worst = 0;
};

/// Failures by kind of world, step, spin and speed.
void print_summary(const Property& property, const std::vector<Row>& rows) {
    std::map<std::tuple<std::string, double, double, double>, Tally> tallies;
    Tally all;
    for (const Row& row : rows) {
        const Setting& s = row.request.setting;
        for (Tally* t : {&tallies[{s.kind, s.dt_s, s.spin, s.speed}], &all}) {
            ++t->seeds, t->failed += row.finding.failed, t->not_finite += !std::isfinite(row.finding.figure);
            t->worst = std::fmax(t->worst, row.finding.figure);
        }
    }
    fmt::print("\n{}: {}\n  worst: {}\n", property.name, property.claim, property.figure);
    fmt::print("  {:14} {:>7} {:>7} {:>7} {:>6} {:>7} {:>10} {:>11}\n", "kind", "dt ms", "spin", "speed",
               "seeds", "failed", "not finite", "worst");
    for (const auto& [key, t] : tallies) {
        const auto& [kind, dt_s, spin, speed] = key;
        fmt::print("  {:14} {:7g} {:7g} {:7g} {:6} {:7} {:10} {:11.3g}\n", kind, dt_s * 1e3, spin, speed,
                   t.seeds, t.failed, t.not_finite, t.worst);
    }
    fmt::print("  {:14} {:7} {:7} {:7} {:6} {:7} {:10} {:11.3g}\n", "all", "", "", "", all.seeds, all.failed,
               all.not_finite, all.worst);
}

bool write_json(const std::string& name, const std::vector<Row>& rows) {
    if (!may_become(name, "figures")) {
        fmt::print(stderr, "roboss-fuzz: '{}' exists and holds something else\n  remedy: give another name\n",
                   name);
        return false;
    }
    nlohmann::json list = nlohmann::json::array();
    for (const Row& row : rows) {
        const Setting& s = row.request.setting;
        nlohmann::json entry{{"property", row.property->name},
                             {"seed", s.seed},
                             {"kind", s.kind},
                             {"dt_s", s.dt_s},
                             {"spin", s.spin},
                             {"speed", s.speed},
                             {"seconds", row.request.seconds},
                             {"failed", row.finding.failed},
                             {"tick", row.finding.tick},
                             {"replay", replay_command(*row.property, row.request)}};
        entry["figure"] = std::isfinite(row.finding.figure) ? nlohmann::json(row.finding.figure)
                                                            : nlohmann::json("infinite");
        if (!row.finding.text.empty()) entry["text"] = row.finding.text;
        list.push_back(std::move(entry));
    }
    std::ofstream file(name);
    file << list.dump(1) << "\n";
    file.close();
    if (!file)
        fmt::print(stderr,
                   "roboss-fuzz: cannot write '{}'\n  remedy: check the folder, its permissions and the free "
                   "space\n",
                   name);
    return static_cast<bool>(file);
}

/// One seed, tick by tick.
bool replay(const Property& registered, const Property& property, const Options& o) {
    Row row;
    row.property = &registered;
    row.request.setting = property.setting(*o.seed);
    row.request.seconds = property.seconds;
    row.request.print_line = [&, tick = 0u](const std::string& line) mutable {
        if (tick++ % o.every == 0) fmt::print("{}\n", line);
    };
    row.finding = property.run(row.request);
    fmt::print("{}", row.finding.failed
                         ? failure_line(row)
                         : fmt::format("holds: {} {:.4g}\n", property.figure, row.finding.figure));
    return !row.finding.failed;
}

int usage(const std::string& text) {
    fmt::print(stderr, "roboss-fuzz: {}\n", text);
    return 2;
}

int run(const Options& o) {
    if (o.list) {
        print_list();
        return 0;
    }
    const std::optional<Range> range = parse_range(o.seeds);
    if (!range) return usage("--seeds takes A..B with A < B, e.g. 0..100");
    ThreadPool pool(o.jobs);
    std::vector<Row> all;
    bool held = true, any = false;
    for (const Property& registered : properties()) {
        if (std::ranges::find(o.properties, registered.name) == o.properties.end() &&
            std::ranges::find(o.properties, "all") == o.properties.end())
            continue;
        const std::optional<Property> property = narrowed(registered, o);
        if (!property) continue;
        any = true;
        if (o.seed) {
            held &= replay(registered, *property, o);
            continue;
        }
        const std::vector<Row> rows = run_seeds(registered, *property, *range, pool);
        print_summary(registered, rows);
        held &= std::ranges::none_of(rows, [](const Row& row) { return row.finding.failed; });
        all.insert(all.end(), rows.begin(), rows.end());
    }
    if (!any) return usage("no property has such a kind of world; --list prints them");
    const bool written = o.json.empty() || write_json(o.json, all);
    return held && written ? 0 : 1;
}

}  // namespace
}  // namespace roboss::fuzz

int main(int argc, char** argv) {
    CLI::App app("Checks properties of the engine on random worlds.", "roboss-fuzz");
    roboss::fuzz::Options options;
    roboss::fuzz::add_options(app, options);
    roboss::fuzz::add_commands(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return roboss::fuzz::run(options);
}
