// roboss-accuracy: runs the cases on the engines, one after the other, and writes the page, the JSON, the
// picture. Progress goes to stderr, one line a case; stdout keeps the table of ours.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "accuracy/results.h"
#include "accuracy/trial.h"
#include "app/commands/numbers.h"
#include "support/bodies.h"

namespace roboss::bench {
namespace {

const char* const kFooter = R"(Examples:
  roboss-accuracy                                     everything, on all engines: some minutes
  roboss-accuracy --list                              the names of cases and engines
  roboss-accuracy --case arm --case slide             two cases on all engines
  roboss-accuracy --engine RoBOSS                     ours alone, a minute or two
  roboss-accuracy --markdown page.md --json rows.json --picture arm.svg

Each line of the table is a figure, what it must be, and what it is. Bounds and their truths stand in docs/accuracy.md.

Exit codes: 0 every figure of RoBOSS keeps its bound, 1 one does not (or a file could not be written), 2 wrong usage.)";

struct Options {
    std::vector<std::string> cases, engines;
    bool list = false, only_main = false;
    double patience_s = 12;
    double dt_s = 0;  // 0: each case's own
    std::string markdown, json, picture;
};

void add_options(CLI::App& app, Options& o) {
    app.footer(kFooter);
    std::vector<std::string> names, kinds;
    for (const Case& c : all_cases()) names.push_back(c.name);
    for (const EngineKind& k : engines()) kinds.push_back(k.name);
    kinds.push_back(kFloats);
    app.add_option("--case", o.cases, "run this case only (may be repeated)")->check(CLI::IsMember(names));
    app.add_option("--engine", o.engines, "run on this engine only (may be repeated)")
        ->check(CLI::IsMember(kinds));
    app.add_flag("--list", o.list, "print the names of cases and engines, and end");
    app.add_flag("--skip-coarse", o.only_main, "leave out the second table, at dt 2 ms");
    app.add_option("--patience", o.patience_s,
                   "wall time that a peer gets for a case, s (four times as much for the slow ones); RoBOSS "
                   "always finishes")
        ->check(positive_number())
        ->capture_default_str();
    app.add_option("--dt", o.dt_s,
                   "step of every case, s (default: the case's own); leaves the second table out")
        ->check(positive_number());
    app.add_option("--markdown", o.markdown, "write the page to this file");
    app.add_option("--json", o.json, "write all rows to this file");
    app.add_option("--picture", o.picture, "write the picture of the arm's energy (SVG) to this file");
}

void print_list() {
    for (const Case& c : all_cases()) fmt::print("{:18} {}\n", c.name, c.title);
    fmt::print("\nengines:");
    for (const EngineKind& k : engines()) fmt::print(" {}", k.name);
    fmt::print(" {}\n", kFloats);
}

bool chosen(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

Results describe() {
    const char* commit = std::getenv("ROBOSS_COMMIT");  // set by bench.sh
    return {all_cases(), {}, {}, {}, commit != nullptr ? commit : "unknown", ROBOSS_COMPILER, processor()};
}

EngineNote describe(const EngineKind& kind) {
    World world = test::empty_world(1e-3);
    test::place(world, test::solid_sphere(1, 0.1, test::surface(0.5)), "ball");
    EngineOptions options;
    options.dt_s = world.dt_s;
    const auto engine = kind.make(world, options);
    return {kind.name, engine->name(), engine->settings()};
}

/// An engine that gives up says why.
Outcome run_case(const Case& c, const Contender& contender) {
    try {
        return c.run(contender);
    } catch (const std::exception& error) {
        Outcome out = Trial::impossible(c.quantities.size());
        out.remark = error.what();
        return out;
    }
}

void measure(Results& all, std::size_t which, const EngineKind& kind, bool coarse, double patience_s) {
    const Case& c = all.cases[which];
    Contender contender{&kind, coarse ? 2e-3 : c.dt_s};
    const bool ours = kind.name == kOurs || kind.name == kFloats;
    if (!ours) contender.patience_s = c.slow ? 4 * patience_s : patience_s;
    fmt::print(stderr, "{:18} {:8} dt {:g} ms ... ", c.name, kind.name, contender.dt_s * 1e3);
    std::fflush(stderr);
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run_case(c, contender);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    fmt::print(stderr, "{:.1f} s {}\n", spent.count(), outcome.remark);
    all.results.push_back({which, kind.name, contender.dt_s, coarse, outcome, spent.count()});
}

void measure_all(Results& all, const Options& options) {
    for (const EngineKind& kind : engines())
        if (chosen(options.engines, kind.name)) all.engines.push_back(describe(kind));
    const bool in_floats = chosen(options.engines, kFloats);
    if (in_floats) all.floats = describe(floats());
    for (std::size_t which = 0; which < all.cases.size(); ++which) {
        const Case& c = all.cases[which];
        if (!chosen(options.cases, c.name)) continue;
        for (const bool coarse : {false, true}) {
            if (coarse && (options.only_main || !c.also_coarse)) continue;
            for (const EngineKind& kind : engines()) {
                if (!chosen(options.engines, kind.name)) continue;
                if (c.ours_only && kind.name != kOurs) continue;
                measure(all, which, kind, coarse, options.patience_s);
            }
            if (in_floats && !coarse && !c.of_the_kernel)
                measure(all, which, floats(), coarse, options.patience_s);
        }
    }
}

void print_table(const Results& all) {
    for (const Result& r : all.results) {
        const Case& c = all.cases[r.which];
        for (std::size_t i = 0; i < c.quantities.size(); ++i) {
            const Quantity& q = c.quantities[i];
            const double figure = r.outcome.figures[i];
            const char* verdict = !r.outcome.possible ? "cannot"
                                  : !q.bound          ? ""
                                  : passes(q, figure) ? "pass"
                                                      : "MISSED";
            fmt::print("{:18} {:8} {:4g} ms  {:52} {:12.5g} {:5} {:7} {}\n", c.name, r.engine, r.dt_s * 1e3,
                       q.name, figure, q.unit, verdict,
                       q.target  ? fmt::format("must be {:.5g} +- {:.2g}", *q.target, *q.bound)
                       : q.bound ? fmt::format("must be <= {:g}", *q.bound)
                                 : "");
        }
    }
}

bool refuse(const std::string& name) {
    fmt::print(
        stderr,
        "roboss-accuracy: could not write '{}'\n  remedy: does its folder exist, may you write there?\n",
        name);
    return false;
}

/// Opened for more, so what is there stays until there is something new.
bool can_write(const std::string& name) {
    return name.empty() || std::ofstream(name, std::ios::app) || refuse(name);
}

bool write_file(const std::string& name, const std::string& text) {
    if (name.empty()) return true;
    std::ofstream file(name);
    file << text;
    file.close();
    return file ? true : refuse(name);
}

/// As the page's link: relative to the page's folder if the picture lies below it.
std::string link_to(const std::string& picture, const std::string& page) {
    const std::string folder = page.substr(0, page.find_last_of('/') + 1);
    return picture.starts_with(folder) ? picture.substr(folder.size()) : picture;
}

int run(const Options& options) {
    if (options.list) {
        print_list();
        return 0;
    }
    for (const std::string& file : {options.picture, options.json, options.markdown})
        if (!can_write(file)) return 1;
    Results all = describe();
    if (options.dt_s > 0)
        for (Case& c : all.cases) c.dt_s = options.dt_s, c.also_coarse = false;
    measure_all(all, options);
    print_table(all);
    const std::string picture = to_svg(all);
    const bool written =
        write_file(options.picture, picture) && write_file(options.json, to_json(all)) &&
        write_file(options.markdown, to_markdown(all, link_to(options.picture, options.markdown)));
    return written && all_ours_pass(all) ? 0 : 1;
}

}  // namespace
}  // namespace roboss::bench

int main(int argc, char** argv) {
    CLI::App app("Measures RoBOSS and its peers on motions whose truth is known.", "roboss-accuracy");
    roboss::bench::Options options;
    roboss::bench::add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return roboss::bench::run(options);
}
