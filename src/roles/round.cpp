// Writing, sending and ticking off the plans of a window.
#include "roles/round.h"

#include <algorithm>

namespace roboss {

namespace {

constexpr int kPatienceMost =
    4;  // doublings of the time until a plan is sent again: most are not lost, but long

/// The robots of the entry for this address, which is made if there is none.
template <class Entry>
std::vector<RobotId>& robots_of(std::vector<Entry>& entries, Address Entry::*who, const Address& address) {
    auto here =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.*who == address; });
    if (here == entries.end()) {
        here = entries.insert(entries.end(), Entry{});
        (*here).*who = address;
    }
    return here->robots;
}

}  // namespace

Round::Round(const RoundSpan& span, std::size_t robots)
    : outcome(robots),
      span_(span),
      seat_(robots, kLost),
      last_seat_(robots, kLost),
      since_(robots, span.from) {}

Plan& Round::plan_for(std::uint32_t place) {
    if (plan_of_seat_.size() <= place) plan_of_seat_.resize(place + std::size_t{1}, nullptr);
    if (plan_of_seat_[place] != nullptr) return *plan_of_seat_[place];
    Sent& sent = sent_.emplace_back();
    plan_of_seat_[place] = &sent.plan;
    sent.place = place;
    sent.plan.epoch = span_.epoch;
    sent.plan.window = span_.window;
    sent.plan.attempt = attempt_;
    sent.plan.window_from = sent.plan.from = span_.from;
    sent.plan.until = span_.until;
    sent.plan.island_offsets.push_back(0);
    return sent.plan;
}

void Round::plan(const Islands& part, std::span<const std::uint32_t> place,
                 std::span<const std::uint32_t> source, const Roster& roster) {
    if (planned_) ++attempt_, ++repeats_;
    planned_ = true;
    const std::vector<std::uint32_t> from(source.begin(),
                                          source.end());  // `source` may be seats(), which change below
    in_attempt_.assign(seat_.size(), false);
    spent_before_ns_ = spent_ns_;
    for (std::size_t i = 0; i < part.count(); ++i)
        for (const RobotId robot : part.of(i)) {
            seat_[robot.index()] = last_seat_[robot.index()] = place[i];
            since_[robot.index()] = span_.from;
            in_attempt_[robot.index()] = true;
        }
    write(part, place, from, roster);
}

void Round::write(const Islands& part, std::span<const std::uint32_t> place,
                  std::span<const std::uint32_t> source, const Roster& roster) {
    plan_of_seat_.assign(roster.size(), nullptr);
    std::vector<std::size_t> robots(roster.size(), 0);
    for (std::size_t i = 0; i < part.count(); ++i) robots[place[i]] += part.size_of(i);
    for (std::uint32_t seat = 0; seat < robots.size(); ++seat) {
        if (robots[seat] == 0) continue;
        Plan& plan = plan_for(seat);
        plan.robots.reserve(robots[seat]);
        plan.island_offsets.reserve(robots[seat] + 1);
    }
    for (std::size_t i = 0; i < part.count(); ++i) {
        Plan& plan = plan_for(place[i]);
        for (const RobotId robot : part.of(i)) {
            plan.robots.push_back(robot);
            const std::uint32_t source_place = source[robot.index()];
            if (source_place == place[i]) continue;
            const Address source_address = roster.address_of(source_place);
            robots_of(plan.hand_offs, &Holding::source, source_address).push_back(robot);
            if (source_place < roster.size())
                robots_of(plan_for(source_place).gives, &HandOver::to, roster.address_of(place[i]))
                    .push_back(robot);
        }
        plan.island_offsets.push_back(static_cast<std::uint32_t>(plan.robots.size()));
    }
}

void Round::give(const Order& order) {
    if (in_attempt_[order.robot.index()]) plan_of_seat_[seat_of(order.robot)]->orders.push_back(order);
}

void Round::give_ahead(std::uint64_t window, const std::vector<bool>& told) {
    for (Sent& sent : sent_) {
        std::sort(sent.plan.orders.begin(), sent.plan.orders.end(), comes_before);
        if (sent.place < told.size() && told[sent.place]) sent.plan.ahead = window;
    }
}

void Round::keep(std::uint32_t place, std::vector<RobotId> robots) {
    plan_for(place).keep = std::move(robots);
}

void Round::release_before(Tick tick) {
    for (Sent& sent : sent_) sent.plan.release_before = tick;
}

void Round::send_dearest_first(std::span<const float> cost) {
    const auto work = [cost](const Sent& sent) {
        double sum = 0;
        for (const RobotId robot : sent.plan.robots) sum += static_cast<double>(cost[robot.index()]);
        return sum;
    };
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < sent_.size(); ++i) order.emplace_back(-work(sent_[i]), i);
    std::sort(order.begin(), order.end());
    std::deque<Sent> sorted;
    for (const auto& [work_before, i] : order) sorted.push_back(std::move(sent_[i]));
    sent_ = std::move(sorted);
    for (Sent& sent : sent_) plan_of_seat_[sent.place] = &sent.plan;
}

void Round::send(Bus& bus, const Roster& roster, std::int64_t resend_ms,
                 const std::function<void(Plan&)>& complete) {
    const std::int64_t now = bus.now_ms();
    for (Sent& sent : sent_) {
        if (sent.sent_ms && now - *sent.sent_ms < (resend_ms << std::min(sent.times, kPatienceMost)))
            continue;
        if (sent.sent_ms) ++sent.times, complete(sent.plan);
        sent.sent_ms = now;
        sent.plan.simulator = roster.id_of(sent.place);
        bus.send(kControllerAddress, roster.address_of(sent.place), sent.plan);
    }
}

std::optional<Round::Answered> Round::answered_by(std::uint32_t place, const Frame& frame, bool& fits) {
    fits = true;
    if (frame.epoch != span_.epoch || frame.window != span_.window) return std::nullopt;
    const auto sent = std::find_if(sent_.begin(), sent_.end(), [&](const Sent& s) {
        return s.place == place && s.plan.attempt == frame.attempt;
    });
    if (sent == sent_.end()) return std::nullopt;
    fits = (frame.left == 0 || sent->cut) && suits(sent->plan, frame);
    if (!fits) return std::nullopt;
    std::optional<Answered> answered({sent->place, std::move(sent->plan), std::move(sent->helpers)});
    sent_.erase(sent);
    return answered;
}

bool Round::suits(const Plan& plan, const Frame& frame) const {
    const auto known = [this](RobotId robot) { return robot.index() < seat_.size(); };
    const bool told =
        frame.left > 0
            ? frame.left < static_cast<std::uint64_t>(plan.until - plan.from)
            : std::equal(plan.robots.begin(), plan.robots.end(), frame.robots.begin(), frame.robots.end(),
                         [](RobotId robot, const RobotFrame& f) { return robot == f.robot; });
    return told && frame.islands.size() + 1 == plan.island_offsets.size() &&
           std::all_of(frame.earlier.begin(), frame.earlier.end(),
                       [&](const EarlierBox& e) { return known(e.robot); }) &&
           std::all_of(frame.islands.begin(), frame.islands.end(), [&](const IslandFrame& i) {
               return !i.failed.valid() ||
                      (known(i.failed) && plan.from <= i.failed_at && i.failed_at < plan.until);
           });
}

void Round::spend(std::uint32_t place, std::uint64_t cost_ns) {
    if (spent_ns_.size() <= place) spent_ns_.resize(place + std::size_t{1}, 0);
    spent_ns_[place] += static_cast<double>(cost_ns);
}

double Round::busiest_ns() const {
    double busiest = 0;
    for (std::size_t place = 0; place < spent_ns_.size(); ++place) {
        const double before = place < spent_before_ns_.size() ? spent_before_ns_[place] : 0;
        busiest = std::max(busiest, spent_ns_[place] - before);
    }
    return busiest;
}

void Round::expect(std::uint64_t due_ns) {
    for (Sent& sent : sent_) sent.plan.due_ns = due_ns;
}

void Round::take_late(std::uint32_t place, const Late& late) {
    if (late.epoch != span_.epoch || late.window != span_.window) return;
    for (Sent& sent : sent_)
        if (sent.place == place && sent.plan.attempt == late.attempt) sent.needs_ns = late.needs_ns;
}

std::vector<Round::LateSeat> Round::late() const {
    std::vector<const Sent*> late;
    for (const Sent& sent : sent_)
        if (sent.needs_ns > 0 && !sent.cut && sent.plan.island_offsets.size() > 2) late.push_back(&sent);
    std::stable_sort(late.begin(), late.end(),
                     [](const Sent* a, const Sent* b) { return a->needs_ns > b->needs_ns; });
    std::vector<LateSeat> seats;
    for (const Sent* sent : late) seats.push_back({sent->place, sent->plan.island_offsets.size() - 1});
    return seats;
}

std::vector<std::uint32_t> Round::idle(const Roster& roster) const {
    std::vector<std::uint32_t> idle = roster.workers();
    std::erase_if(idle, [this](std::uint32_t place) {
        return std::any_of(sent_.begin(), sent_.end(), [place](const Sent& sent) {
            return sent.place == place ||
                   std::find(sent.helpers.begin(), sent.helpers.end(), place) != sent.helpers.end();
        });
    });
    return idle;
}

void Round::cut(Bus& bus, const Roster& roster, std::uint32_t place, std::vector<std::uint32_t> helpers) {
    for (Sent& sent : sent_) {
        if (sent.place != place) continue;
        sent.cut = true;
        sent.helpers = std::move(helpers);
        return bus.send(kControllerAddress, roster.address_of(place),
                        Cut{span_.epoch, span_.window, sent.plan.attempt, roster.id_of(place)});
    }
}

void Round::plan_rest(const Answered& cut_short, Tick at, std::span<const std::uint32_t> place,
                      std::uint64_t due_ns, const Roster& roster,
                      const std::function<void(Plan&)>& complete) {
    ++attempt_;
    const Islands part{cut_short.plan.island_offsets, cut_short.plan.robots};
    write(part, place, last_seat_, roster);
    for (std::size_t i = 0; i < part.count(); ++i)
        for (const RobotId robot : part.of(i)) {
            if (last_seat_[robot.index()] != place[i]) since_[robot.index()] = at;
            last_seat_[robot.index()] = place[i];
        }
    for (Plan* plan : plan_of_seat_) {
        if (plan == nullptr) continue;
        plan->from = at;
        plan->due_ns = due_ns;
        complete(*plan);
    }
}

}  // namespace roboss
