// Compares two journals.
#include "app/commands/diff_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/output/say.h"
#include "app/run/journal_location.h"
#include "app/run/run.h"
#include "core/hash.h"
#include "simulation/divergence.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

const char* const kDiffFooter =
    R"(A and B are journals (FILE or FILE#BRANCH): the whole history that led to that branch, through those before it. Their
checkpoints are compared. Both runs are then stepped again, side by side, over the first stretch that ends differently,
so the journals may have any --journal-every.

Exit codes: 0 equal over the time that both cover, 1 a journal cannot be read or they have no time in common, 2 wrong usage,
3 different.)";

struct DiffOptions {
    std::string a, b;
    int threads = 1;
    bool json = false;
};

struct Named {
    Journal journal;
    Branch branch;
};
Result<Named> open(const std::string& text) {
    Result<JournalLocation> location = parse_location(text);
    if (!location) return location.error();
    if (location.value().time_s)
        return Error{text + " names a point in time", "name a whole run: FILE or FILE#BRANCH",
                     "bad-location"};
    Result<Journal> journal = Journal::open(location.value().file);
    if (!journal) return journal.error();
    Result<Branch> branch = journal.value().branch(location.value().branch);
    if (!branch) return branch.error();
    return Named{std::move(journal).value(), branch.value()};
}

void print_orders(const char* what, const std::vector<std::string>& orders) {
    constexpr std::size_t kShown = 3;
    for (std::size_t i = 0; i < std::min(kShown, orders.size()); ++i) say("{}  {}\n", what, orders[i]);
    if (orders.size() > kShown) say("{}  and {} more\n", what, orders.size() - kShown);
}

void print_text(const Comparison& c, double dt_s) {
    if (c.model_a != c.model_b) say("the Models differ: {} and {}\n", to_hex(c.model_a), to_hex(c.model_b));
    const std::string span =
        fmt::format("from {:.6f} s to {:.6f} s (ticks {} to {})", static_cast<double>(c.from) * dt_s,
                    static_cast<double>(c.until) * dt_s, c.from, c.until);
    if (!c.divergence) return say("equal {}\n", span);
    const Divergence& d = *c.divergence;
    say("different; compared {}\n", span);
    say("first at          tick {} ({:.6f} s), {} robots\n", d.tick, d.time_s, d.robots);
    if (!d.robot.empty())
        say("robot             {}\nfield             {}\n  a               {}\n  b               {}\n",
            d.robot, d.field.field, d.field.a, d.field.b);
    print_orders("only in a", d.orders_a_only);
    print_orders("only in b", d.orders_b_only);
    if (!d.remark.empty()) say("remark            {}\n", d.remark);
}

Json to_json(const Comparison& c) {
    Json o{{"equal", !c.divergence},
           {"from_tick", c.from},
           {"until_tick", c.until},
           {"model_hash_a", to_hex(c.model_a)},
           {"model_hash_b", to_hex(c.model_b)}};
    if (!c.divergence) return o;
    const Divergence& d = *c.divergence;
    o["tick"] = d.tick;
    o["time_s"] = d.time_s;
    o["robots"] = d.robots;
    o["robot"] = d.robot;
    o["field"] = d.field.field;
    o["a"] = d.field.a;
    o["b"] = d.field.b;
    o["orders_a_only"] = d.orders_a_only;
    o["orders_b_only"] = d.orders_b_only;
    o["remark"] = d.remark;
    return o;
}

int diff(const DiffOptions& o) {
    Result<Named> a = open(o.a), b = open(o.b);
    if (!a) return print(a.error()), kBadInput;
    if (!b) return print(b.error()), kBadInput;
    Result<std::shared_ptr<const Model>> model = a.value().journal.model(a.value().branch);
    if (!model) return print(model.error()), kBadInput;
    for (const auto& [name, run] : {std::pair(o.a, &a.value()), std::pair(o.b, &b.value())})
        if (const std::string text = ways(run->journal.lineage(run->branch), model.value()->dt_s);
            !text.empty())
            say(stderr, "roboss: {} {} [branches]\n", name, text);
    const Result<Comparison> compared = compare(a.value().journal, a.value().branch, b.value().journal,
                                                b.value().branch, {static_cast<unsigned>(o.threads), 0});
    if (!compared) return print(compared.error()), kBadInput;
    if (o.json)
        say("{}\n", to_json(compared.value()).dump(2, ' ', false, Json::error_handler_t::replace));
    else
        print_text(compared.value(), model.value()->dt_s);
    return compared.value().divergence ? kRunFailed : kSuccess;
}

}  // namespace

void add_diff_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("diff", "find the first tick, robot and field in which two journals differ");
    command->footer(kDiffFooter);
    auto o = std::make_shared<DiffOptions>();
    command->add_option("a", o->a, "a journal: FILE or FILE#BRANCH")->required();
    command->add_option("b", o->b, "another journal: FILE or FILE#BRANCH")->required();
    command->add_option("--threads", o->threads, "number of threads")
        ->check(whole_number(1, 1024))
        ->capture_default_str();
    command->add_flag("--json", o->json, "print one JSON object");
    command->callback([o, &exit_code] { exit_code = diff(*o); });
}

}  // namespace roboss
