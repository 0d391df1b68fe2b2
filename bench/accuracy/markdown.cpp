// docs/accuracy.md: one table of what the project must keep, one of further cases, one at a coarser step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "accuracy/results.h"

namespace roboss::bench {
namespace {

using Text = fmt::memory_buffer;

const char* const kOfFloats = R"(## In floats, dt 1 ms

The cases again with `--precision float`, with their bounds. *The same*: no robot of the case goes through floats (lone
bodies, free motion, loops, robots that touch each other: docs/physics.md, Precision), or none shows it in these
figures. A float has 24 bits: the change of a velocity in one tick is exact to some 1e-7 of itself, so what needs 1e-9
of it (a stalled motor's force) is met in doubles only.

)";

template <class... Args>
void add(Text& text, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

std::string number(const Quantity& quantity, double figure) {
    if (!std::isfinite(figure)) return "blew up";
    if (quantity.target) return fmt::format("{:.4g}", figure);
    return figure == 0 ? "0" : fmt::format("{:.2g}", figure);
}

std::string must(const Quantity& q) {
    if (!q.bound) return "stated";
    if (!q.target) return fmt::format("<= {:g}", *q.bound);
    return fmt::format("{:.4g} +- {:.2g}", *q.target, *q.bound);
}

/// Collects remarks and gives each its number.
class Footnotes {
  public:
    /// " [3]", or nothing for an empty remark.
    std::string mark(const std::string& remark) {
        if (remark.empty()) return {};
        auto at = std::find(remarks_.begin(), remarks_.end(), remark);
        if (at == remarks_.end()) at = remarks_.insert(at, remark);
        return fmt::format(" [{}]", at - remarks_.begin() + 1);
    }
    void write(Text& text) const {
        for (std::size_t i = 0; i < remarks_.size(); ++i) add(text, "{}. {}\n", i + 1, remarks_[i]);
        if (!remarks_.empty()) add(text, "\n");
    }

  private:
    std::vector<std::string> remarks_;
};

std::string cell(const Result* result, const Quantity& quantity, std::size_t i, Footnotes& notes) {
    if (result == nullptr) return "";
    if (!result->outcome.possible) return "cannot" + (i == 0 ? notes.mark(result->outcome.remark) : "");
    if (result->outcome.share < 0.5) return "too slow" + (i == 0 ? notes.mark(result->outcome.remark) : "");
    const double figure = result->outcome.figures[i];
    const std::string mark = passes(quantity, figure) ? "" : " ✗";
    return number(quantity, figure) + mark + (i == 0 ? notes.mark(result->outcome.remark) : "");
}

/// Says by how much ours missed.
std::string verdict(const Result* ours, const Quantity& quantity, std::size_t i) {
    if (ours == nullptr || !ours->outcome.possible) return "not measured";
    if (!quantity.bound) return "";
    const double figure = ours->outcome.figures[i];
    if (passes(quantity, figure)) return "pass";
    if (!std::isfinite(figure)) return "**missed**";
    const double times = std::fabs(figure - quantity.target.value_or(0)) / *quantity.bound;
    if (times < 1 + 1e-6) return "**at the bound**, missed by rounding";
    return fmt::format("**missed**, {:.{}g} times the bound", times, times < 1.1 ? 4 : 2);
}

void write_case(Text& text, const Results& all, std::size_t which, bool coarse, Footnotes& notes) {
    const Case& c = all.cases[which];
    const Result* ours = find(all, which, kOurs, coarse);
    const bool measured = std::any_of(all.results.begin(), all.results.end(), [&](const Result& r) {
        return r.which == which && r.coarse == coarse;
    });
    if (!measured) return;
    for (std::size_t i = 0; i < c.quantities.size(); ++i) {
        const Quantity& q = c.quantities[i];
        add(text, "| {} |", i == 0 ? c.title + notes.mark(c.remark) : "");
        if (!coarse) add(text, " {} |", i == 0 ? c.oracle : "");
        add(text, " {} | {} | {} |", q.unit.empty() ? q.name : q.name + ", " + q.unit, must(q),
            verdict(ours, q, i));
        for (const EngineNote& engine : all.engines)
            add(text, " {} |", cell(find(all, which, engine.name, coarse), q, i, notes));
        add(text, "\n");
    }
}

template <class Wanted>
void write_table(Text& text, const Results& all, bool coarse, Wanted wanted) {
    add(text, "| case |{} figure | must | ours |", coarse ? "" : " closed form or oracle |");
    for (const EngineNote& engine : all.engines) add(text, " {} |", engine.name);
    add(text, "\n|---|{}---|---|---|", coarse ? "" : "---|");
    for (std::size_t i = 0; i < all.engines.size(); ++i) add(text, "---:|");
    add(text, "\n");
    Footnotes notes;
    for (std::size_t which = 0; which < all.cases.size(); ++which)
        if (wanted(all.cases[which])) write_case(text, all, which, coarse, notes);
    add(text, "\n");
    notes.write(text);
}

/// The table of floats: beside doubles, and how far each is from its bound.
void write_floats(Text& text, const Results& all) {
    add(text, "{}", kOfFloats);
    add(text, "| case | figure | must | in floats | doubles | floats |\n|---|---|---|---|---:|---:|\n");
    Footnotes notes;
    for (std::size_t which = 0; which < all.cases.size(); ++which) {
        const Case& c = all.cases[which];
        const Result *doubles = find(all, which, kOurs, false), *floats = find(all, which, kFloats, false);
        if (floats == nullptr) continue;
        const bool same = doubles != nullptr && doubles->outcome.figures == floats->outcome.figures;
        for (std::size_t i = 0; i < c.quantities.size(); ++i) {
            const Quantity& q = c.quantities[i];
            add(text, "| {} | {} | {} | {} | {} | {} |\n", i == 0 ? c.title : "",
                q.unit.empty() ? q.name : q.name + ", " + q.unit, must(q), verdict(floats, q, i),
                cell(doubles, q, i, notes), same ? "the same" : cell(floats, q, i, notes));
        }
    }
    add(text, "\n");
    notes.write(text);
}

/// What of ours misses its bound, how far, and why.
void write_misses(Text& text, const Results& all) {
    Text list;
    for (const Result& r : all.results) {
        if (r.coarse || r.engine != kOurs) continue;
        const Case& c = all.cases[r.which];
        for (std::size_t i = 0; i < c.quantities.size(); ++i) {
            const Quantity& q = c.quantities[i];
            if (passes(q, r.outcome.figures[i])) continue;
            add(list, "- {}, {}: {}, must be {}. {}\n", c.title, q.name, number(q, r.outcome.figures[i]),
                must(q), c.remark);
        }
    }
    add(text, "## Where RoBOSS misses a bound\n\n{}\n",
        list.size() == 0 ? "Nowhere, in this run (in doubles; floats have a table of their own below).\n"
                         : fmt::to_string(list));
}

const char* const kIntroduction = R"(# Accuracy

Motions with a known truth: a closed form, a reference converged in long double, or that nothing should move. Every case
runs on RoBOSS and on the engines that Debian 12 packages (random trees and shots also on MuJoCo 4), in the same run,
through one interface (`bench/engines/engine.h`); velocities and poses of all engines are read alike, and energies
summed alike. This page is written by the program; `./bench.sh accuracy` makes it again (`--list` names the cases,
`--case NAME` runs some, `--json FILE` writes the rows for programs).
What the settings `fast`, `standard` and `high` cost and give:
[price list](performance.md#price-list-of-the-accuracy).

How to read the tables: figures are errors unless the unit says otherwise, and `✗` marks one that does not keep the
bound in the column *must*. The bounds are for RoBOSS, at its default accuracy. The peers, set up as in the benchmark of
speed, were not made for them and are shown for scale. *Stated* figures have no bound. *Cannot*: the engine does not
support it. An engine that needs more than its share of wall time is stopped; the note says when, and *too slow* means
that it did not reach half of the time.

)";

}  // namespace

std::string to_markdown(const Results& all, const std::string& picture) {
    Text text;
    add(text, "{}", kIntroduction);
    if (!picture.empty())
        add(text, "![Energy error of a swinging arm over ten seconds, by engine]({})\n\n", picture);
    add(text, "## What must hold, dt 1 ms\n\n");
    write_table(text, all, false, [](const Case& c) { return c.from_issue; });
    add(text, "## Further cases, where simulators are often wrong, dt 1 ms\n\n");
    write_table(text, all, false, [](const Case& c) { return !c.from_issue; });
    write_misses(text, all);
    add(text, "## The same at dt 2 ms\n\nThe bounds are those of 1 ms, for comparison only.\n\n");
    write_table(text, all, true, [](const Case&) { return true; });
    if (all.floats) write_floats(text, all);
    add(text, "## The engines\n\n| engine | version | set-up |\n|---|---|---|\n");
    const auto describe = [&](const EngineNote& e) {
        add(text, "| {} | {} | {} |\n", e.name, e.version, e.settings);
    };
    std::for_each(all.engines.begin(), all.engines.end(), describe);
    if (all.floats) describe(*all.floats);
    add(text, "\nMeasured at commit {}, {}, {}.\n", all.commit, all.compiler, all.processor);
    return fmt::to_string(text);
}

}  // namespace roboss::bench
