// Comparing two journals: stored checkpoints first, then by stepping again.
#include "simulation/divergence.h"

#include <algorithm>

#include "wire/codec.h"

namespace roboss {

namespace {

using States = std::vector<RobotState>;

/// One of the two runs, in one branch.
class Side {
  public:
    static Result<Side> open(const Journal& journal, const Branch& branch, const ReplayOptions& options) {
        Result<std::shared_ptr<const Model>> model = journal.model(branch);
        if (!model) return model.error();
        return Side(journal, branch, std::move(model).value(), options);
    }
    const Model& model() const { return *model_; }
    const Branch& branch() const { return branch_; }
    const Journal& journal() const { return *journal_; }

    const CheckpointEntry* entry(Tick tick) const {
        const CheckpointEntry* before = journal_->checkpoint_before(branch_, tick);
        return before != nullptr && before->tick == tick ? before : nullptr;
    }
    std::vector<CheckpointEntry> entries() const { return journal_->checkpoints(branch_); }
    /// The states at a tick: kept ones if there are any, else stepped again.
    Result<States> states(Tick tick) const {
        if (const CheckpointEntry* kept = entry(tick)) {
            Result<StoredCheckpoint> stored = journal_->checkpoint(*kept, *model_);
            if (!stored) return stored.error();
            return std::move(stored.value().states);
        }
        auto simulation = at(tick, tick);
        if (!simulation) return simulation.error();
        return simulation.value()->states();
    }
    /// A simulation at `tick` that can go on to `until`.
    Result<std::unique_ptr<Simulation>> at(Tick tick, Tick until) const {
        return replay_at(*journal_, branch_, model_, tick, until, options_);
    }

  private:
    Side(const Journal& journal, Branch branch, std::shared_ptr<const Model> model,
         const ReplayOptions& options)
        : journal_(&journal), branch_(std::move(branch)), options_(options), model_(std::move(model)) {}

    const Journal* journal_;
    Branch branch_;
    ReplayOptions options_;
    std::shared_ptr<const Model> model_;
};

/// Fills in the robots and fields that differ; false if there are none.
bool describe(const Model& model, const States& a, const States& b, Divergence& result) {
    result.robots = 0;
    for (std::size_t r = 0; r < a.size(); ++r) {
        const auto difference = first_difference(model.type_of(RobotId(r)), a[r], b[r]);
        if (!difference) continue;
        if (result.robots++ > 0) continue;
        result.robot = model.robots[r].name;
        result.field = *difference;
    }
    return result.robots > 0;
}

std::string describe(const Model& model, const Order& order) {
    static constexpr const char* kKinds[] = {
        "set pose",         "set velocity",    "wrench",      "joint",       "command",
        "attach",           "detach",          "pull",        "joint state", "message",
        "joint parameters", "link parameters", "surroundings"};
    static_assert(std::size(kKinds) == std::variant_size_v<Action>);
    std::string text = std::string(kKinds[order.action.index()]) + " of robot '" +
                       model.robots[order.robot.index()].name + "'";
    if (const auto* joint = std::get_if<SetJoint>(&order.action))
        text += ", joint '" + model.type_of(order.robot).joints[joint->joint.index()].name + "', target " +
                std::to_string(joint->target);
    if (const auto* joint = std::get_if<SetJointState>(&order.action))
        text += ", joint '" + model.type_of(order.robot).joints[joint->joint.index()].name + "'";
    if (const auto* own = std::get_if<SetJointParameters>(&order.action)) {
        text += ", joint '" + model.type_of(order.robot).joints[own->joint.index()].name + "'";
        for (const JointParameterValue& one : own->values)
            text += std::string(", ") + info_of(one.parameter).name + " " + std::to_string(one.value);
    }
    if (const auto* own = std::get_if<SetLinkParameters>(&order.action)) {
        text += ", link '" + model.type_of(order.robot).links[own->link.index()].name + "'";
        for (const LinkParameterValue& one : own->values)
            text += std::string(", ") + info_of(one.parameter).name + " " + std::to_string(one.value);
    }
    if (const auto* own = std::get_if<SetSurroundings>(&order.action)) {
        if (own->reset) text += ", those of the file";
        for (const SurroundingInfo& row : surroundings())
            if (const std::optional<Vec3>& value = own->values.*row.own)
                text += std::string(", ") + row.name + " " + std::to_string(value->x) + " " +
                        std::to_string(value->y) + " " + std::to_string(value->z);
    }
    if (const auto* message = std::get_if<Transmit>(&order.action))
        text += ", of " + std::to_string(message->payload.size()) + " bytes";
    if (const auto* command = std::get_if<Command>(&order.action))
        text += ", command '" + model.type_of(order.robot).channels[command->channel].channel.name + "'";
    return order.client.valid() ? text + ", from Client " + std::to_string(order.client.value) : text;
}

/// Orders that apply at `tick` in one run and not in the other.
Result<> describe_orders(const Side& a, const Side& b, Tick tick, Divergence& result) {
    std::vector<std::pair<std::vector<std::uint8_t>, std::string>> orders[2];
    const Side* sides[] = {&a, &b};
    for (std::size_t i = 0; i < 2; ++i) {
        Result<LogBatch> log = sides[i]->journal().log(sides[i]->branch(), tick, tick + 1);
        if (!log) return log.error();
        for (const LoggedOrder& o : log.value().orders) {
            if (o.order.apply_at != tick) continue;
            if (Result<> checked = check_order(sides[i]->model(), o.order); !checked) return checked;
            orders[i].emplace_back(encode_orders({o.order}), describe(sides[i]->model(), o.order));
        }
    }
    const auto only = [](const auto& mine, const auto& others) {
        std::vector<std::string> texts;
        for (const auto& one : mine)  // its bytes and its text
            if (std::none_of(others.begin(), others.end(),
                             [&](const auto& other) { return other.first == one.first; }))
                texts.push_back(one.second);
        return texts;
    };
    result.orders_a_only = only(orders[0], orders[1]);
    result.orders_b_only = only(orders[1], orders[0]);
    return Ok{};
}

/// Both runs from `from`, where they are equal, to the first tick at which they differ; nothing if they are
/// still equal at `until`.
Result<std::optional<Divergence>> step_apart(const Side& a, const Side& b, Tick from, Tick until) {
    auto run_a = a.at(from, until), run_b = b.at(from, until);
    if (!run_a) return run_a.error();
    if (!run_b) return run_b.error();
    for (Tick tick = from; tick <= until; ++tick) {
        for (auto* run : {&run_a, &run_b})
            if (Result<> done = run->value()->run_until(tick); !done) return done.error();
        Divergence found;
        if (!describe(a.model(), run_a.value()->states(), run_b.value()->states(), found)) continue;
        found.tick = tick;
        if (tick > from)
            if (Result<> told = describe_orders(a, b, tick - 1, found); !told) return told.error();
        return std::optional(std::move(found));
    }
    return std::optional<Divergence>{};
}

/// Ticks to be compared, ascending: checkpoints that both have; else those of one; and the last.
std::vector<Tick> ticks_to_compare(const Side& a, const Side& b, Tick from, Tick until) {
    std::vector<Tick> common{from, until}, all{from, until};
    for (const CheckpointEntry& entry : a.entries()) {
        if (entry.tick <= from || entry.tick >= until) continue;
        all.push_back(entry.tick);
        if (b.entry(entry.tick) != nullptr) common.push_back(entry.tick);
    }
    std::vector<Tick>& chosen = common.size() > 2 ? common : all;
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

Result<bool> equal_at(const Side& a, const Side& b, Tick tick, Divergence& found) {
    const CheckpointEntry *kept_a = a.entry(tick), *kept_b = b.entry(tick);
    if (kept_a != nullptr && kept_b != nullptr && a.model().hash == b.model().hash &&
        kept_a->hash == kept_b->hash)
        return true;
    Result<States> states_a = a.states(tick), states_b = b.states(tick);
    if (!states_a) return states_a.error();
    if (!states_b) return states_b.error();
    found.tick = tick;
    return !describe(a.model(), states_a.value(), states_b.value(), found);
}

/// The index of the first tick whose kept hashes differ; the last index if there is none. Costs nothing.
std::size_t first_kept_apart(const Side& a, const Side& b, const std::vector<Tick>& ticks) {
    for (std::size_t i = 0; i < ticks.size() && a.model().hash == b.model().hash; ++i) {
        const CheckpointEntry *kept_a = a.entry(ticks[i]), *kept_b = b.entry(ticks[i]);
        if (kept_a != nullptr && kept_b != nullptr && kept_a->hash != kept_b->hash) return i;
    }
    return ticks.size() - 1;
}

/// The first tick of `ticks` that differs, by bisection; ticks.size() if none does.
Result<std::size_t> first_that_differs(const Side& a, const Side& b, const std::vector<Tick>& ticks,
                                       Divergence& found) {
    std::size_t low = 0, high = first_kept_apart(a, b, ticks);  // equal before low; different from high on
    Result<bool> equal = equal_at(a, b, ticks[high], found);
    if (!equal) return equal.error();
    if (equal.value()) return ticks.size();
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        Divergence here;
        equal = equal_at(a, b, ticks[middle], here);
        if (!equal) return equal.error();
        if (equal.value()) {
            low = middle + 1;
        } else {
            high = middle;
            found = std::move(here);
        }
    }
    return high;
}

/// Names in the order of robots.
std::vector<std::string> robot_names(const Model& model) {
    std::vector<std::string> names;
    for (const Robot& robot : model.robots) names.push_back(robot.name);
    return names;
}

/// The runs where each is in one branch: what differs between `from` and `until`.
Result<std::optional<Divergence>> compare_stretch(const Side& a, const Side& b, Tick from, Tick until) {
    const std::vector<Tick> ticks = ticks_to_compare(a, b, from, until);
    Divergence kept;
    Result<std::size_t> at = first_that_differs(a, b, ticks, kept);
    if (!at) return at.error();
    if (at.value() == ticks.size()) return std::optional<Divergence>{};
    if (at.value() == 0) {
        kept.remark = "they differ from the first tick that both have";
        return std::optional(std::move(kept));
    }
    Result<std::optional<Divergence>> found = step_apart(a, b, ticks[at.value() - 1], ticks[at.value()]);
    if (!found || found.value()) return found;
    kept.remark =
        "stepped again from the checkpoint before, both runs are equal here: one of them was "
        "computed with other "
        "bits (`roboss journal verify` says which)";
    return std::optional(std::move(kept));
}

/// The ticks at which one of the runs continues in another branch, from `from` to `until`.
std::vector<Tick> turns(const Lineage& a, const Lineage& b, Tick from, Tick until) {
    std::vector<Tick> ticks{from, until};
    for (const Lineage* lineage : {&a, &b})
        for (const Lineage::Part& part : lineage->parts())
            if (part.from > from && part.from < until) ticks.push_back(part.from);
    std::ranges::sort(ticks);
    ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
    return ticks;
}

/// One of the two journals, and the lineage that is compared.
struct RunOfJournal {
    const Journal& journal;
    Lineage lineage;
    Result<Side> side(Tick tick, const ReplayOptions& options) const {
        Result<Branch> branch = journal.branch(lineage.at(tick)->branch);
        if (!branch) return branch.error();
        return Side::open(journal, branch.value(), options);
    }
};

/// Between two turns. `begins`: at the first tick that both have.
Result<> compare_between(const RunOfJournal& whole_a, const RunOfJournal& whole_b, Tick from, Tick until,
                         bool begins, const ReplayOptions& options, Comparison& result) {
    const Result<Side> a = whole_a.side(from, options), b = whole_b.side(from, options);
    if (!a) return a.error();
    if (!b) return b.error();
    const Model &x = a.value().model(), &y = b.value().model();
    result.model_a = x.hash, result.model_b = y.hash;
    const bool same = robot_names(x) == robot_names(y);
    if (x.dt_s != y.dt_s || (!same && begins))
        return Error{whole_a.journal.path() + " and " + whole_b.journal.path() +
                         " are of worlds with other robots or steps",
                     "compare runs of one world", "other-robots"};
    const bool same_rows =
        whole_a.journal.path() == whole_b.journal.path() && a.value().branch().id == b.value().branch().id;
    if (!same) {
        result.divergence.emplace();
        result.divergence->tick = from;
        result.divergence->remark = "from here on, the two runs have other robots";
    } else if (!same_rows) {
        Result<std::optional<Divergence>> found = compare_stretch(a.value(), b.value(), from, until);
        if (!found) return found.error();
        result.divergence = std::move(found).value();
    }
    if (result.divergence) result.divergence->time_s = static_cast<double>(result.divergence->tick) * x.dt_s;
    return Ok{};
}

}  // namespace

Result<Comparison> compare(const Journal& journal_a, const Branch& branch_a, const Journal& journal_b,
                           const Branch& branch_b, const ReplayOptions& options) {
    const RunOfJournal a{journal_a, journal_a.lineage(branch_a)}, b{journal_b, journal_b.lineage(branch_b)};
    Comparison result;
    result.from = std::max(a.lineage.first(), b.lineage.first());
    result.until = std::min(a.lineage.last(), b.lineage.last());
    if (result.from > result.until)
        return Error{journal_a.path() + " and " + journal_b.path() + " have no time in common",
                     "compare runs of the same time", "no-common-time"};
    const std::vector<Tick> ticks = turns(a.lineage, b.lineage, result.from, result.until);
    for (std::size_t i = 0; !result.divergence && (i == 0 || i + 1 < ticks.size()); ++i) {
        const Tick until = ticks[std::min(i + 1, ticks.size() - 1)];
        if (Result<> done = compare_between(a, b, ticks[i], until, i == 0, options, result); !done)
            return done.error();
    }
    return result;
}

}  // namespace roboss
