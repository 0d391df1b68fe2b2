// Writes, sends and checks off the assignments of a window.
#include "roles/controller/round.h"

#include <algorithm>

namespace roboss {

namespace {

constexpr int kPatienceMost =
    4;  // doublings of the time until an assignment is sent again: most late answers are just long steps

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

Assignment& Round::assignment_for(SeatId seat_id) {
    if (assignment_of_seat_.size() <= seat_id) assignment_of_seat_.resize(seat_id + std::size_t{1}, nullptr);
    if (assignment_of_seat_[seat_id] != nullptr) return *assignment_of_seat_[seat_id];
    Sent& sent = sent_.emplace_back();
    assignment_of_seat_[seat_id] = &sent.assignment;
    sent.seat_id = seat_id;
    sent.assignment.epoch = span_.epoch;
    sent.assignment.window = span_.window;
    sent.assignment.attempt = attempt_;
    sent.assignment.window_from = sent.assignment.from = span_.from;
    sent.assignment.until = span_.until;
    sent.assignment.island_offsets.push_back(0);
    return sent.assignment;
}

void Round::assign(const Islands& part, std::span<const SeatId> seat_of_island,
                   std::span<const SeatId> source, const Roster& roster) {
    if (assigned_) ++attempt_, ++repeats_;
    assigned_ = true;
    const std::vector<std::uint32_t> from(source.begin(),
                                          source.end());  // `source` may be seats(), which change below
    in_attempt_.assign(seat_.size(), false);
    spent_before_ns_ = spent_ns_;
    for (std::size_t i = 0; i < part.count(); ++i)
        for (const RobotId robot : part.of(i)) {
            seat_[robot.index()] = last_seat_[robot.index()] = seat_of_island[i];
            since_[robot.index()] = span_.from;
            in_attempt_[robot.index()] = true;
        }
    write(part, seat_of_island, from, roster);
}

void Round::write(const Islands& part, std::span<const SeatId> seat_of_island, std::span<const SeatId> source,
                  const Roster& roster) {
    assignment_of_seat_.assign(roster.size(), nullptr);
    std::vector<std::size_t> robots(roster.size(), 0);
    for (std::size_t i = 0; i < part.count(); ++i) robots[seat_of_island[i]] += part.size_of(i);
    for (SeatId seat = 0; seat < robots.size(); ++seat) {
        if (robots[seat] == 0) continue;
        Assignment& assignment = assignment_for(seat);
        assignment.robots.reserve(robots[seat]);
        assignment.island_offsets.reserve(robots[seat] + 1);
    }
    for (std::size_t i = 0; i < part.count(); ++i) {
        Assignment& assignment = assignment_for(seat_of_island[i]);
        for (const RobotId robot : part.of(i)) {
            assignment.robots.push_back(robot);
            const SeatId source_seat = source[robot.index()];
            if (source_seat == seat_of_island[i]) continue;
            const Address source_address = roster.address_of(source_seat);
            robots_of(assignment.hand_offs, &Holding::source, source_address).push_back(robot);
            if (source_seat < roster.size())
                robots_of(assignment_for(source_seat).transfers, &HandOver::to,
                          roster.address_of(seat_of_island[i]))
                    .push_back(robot);
        }
        assignment.island_offsets.push_back(static_cast<std::uint32_t>(assignment.robots.size()));
    }
}

void Round::give(const Order& order) {
    if (in_attempt_[order.robot.index()]) assignment_of_seat_[seat_of(order.robot)]->orders.push_back(order);
}

void Round::give_ahead(std::uint64_t window, const std::vector<bool>& sent_ahead) {
    for (Sent& sent : sent_) {
        std::sort(sent.assignment.orders.begin(), sent.assignment.orders.end(), comes_before);
        if (sent.seat_id < sent_ahead.size() && sent_ahead[sent.seat_id]) sent.assignment.ahead = window;
    }
}

void Round::keep(SeatId seat_id, std::vector<RobotId> robots) {
    assignment_for(seat_id).keep = std::move(robots);
}

void Round::release_before(Tick tick) {
    for (Sent& sent : sent_) sent.assignment.release_before = tick;
}

void Round::send_dearest_first(std::span<const float> cost) {
    const auto work = [cost](const Sent& sent) {
        double sum = 0;
        for (const RobotId robot : sent.assignment.robots) sum += static_cast<double>(cost[robot.index()]);
        return sum;
    };
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < sent_.size(); ++i) order.emplace_back(-work(sent_[i]), i);
    std::sort(order.begin(), order.end());
    std::deque<Sent> sorted;
    for (const auto& [work_before, i] : order) sorted.push_back(std::move(sent_[i]));
    sent_ = std::move(sorted);
    for (Sent& sent : sent_) assignment_of_seat_[sent.seat_id] = &sent.assignment;
}

void Round::send(Bus& bus, const Roster& roster, std::int64_t resend_ms,
                 const std::function<void(Assignment&)>& complete) {
    const std::int64_t now = bus.now_ms();
    for (Sent& sent : sent_) {
        if (sent.sent_ms && now - *sent.sent_ms < (resend_ms << std::min(sent.times, kPatienceMost)))
            continue;
        if (sent.sent_ms) ++sent.times, complete(sent.assignment);
        sent.sent_ms = now;
        sent.assignment.simulator = roster.id_of(sent.seat_id);
        sent.assignment.measured = measured;
        bus.send(kControllerAddress, roster.address_of(sent.seat_id), sent.assignment);
    }
}

std::vector<SeatId> Round::unanswered() const {
    std::vector<SeatId> seats;
    for (const Sent& sent : sent_)
        if (std::ranges::find(seats, sent.seat_id) == seats.end()) seats.push_back(sent.seat_id);
    return seats;
}

std::optional<Round::Answered> Round::answered_by(SeatId seat_id, const WindowResult& result, bool& fits) {
    fits = true;
    if (result.epoch != span_.epoch || result.window != span_.window) return std::nullopt;
    const auto sent = std::find_if(sent_.begin(), sent_.end(), [&](const Sent& s) {
        return s.seat_id == seat_id && s.assignment.attempt == result.attempt;
    });
    if (sent == sent_.end()) return std::nullopt;
    fits = (result.left == 0 || sent->cut) && suits(sent->assignment, result);
    if (!fits) return std::nullopt;
    std::optional<Answered> answered({sent->seat_id, std::move(sent->assignment), std::move(sent->helpers)});
    sent_.erase(sent);
    return answered;
}

bool Round::suits(const Assignment& assignment, const WindowResult& result) const {
    const auto known = [this](RobotId robot) { return robot.index() < seat_.size(); };
    const bool complete =
        result.left > 0 ? result.left < static_cast<std::uint64_t>(assignment.until - assignment.from)
                        : std::equal(assignment.robots.begin(), assignment.robots.end(),
                                     result.robots.begin(), result.robots.end(),
                                     [](RobotId robot, const RobotResult& f) { return robot == f.robot; });
    return complete && result.islands.size() + 1 == assignment.island_offsets.size() &&
           std::all_of(result.earlier.begin(), result.earlier.end(),
                       [&](const EarlierBox& e) { return known(e.robot); }) &&
           std::all_of(result.islands.begin(), result.islands.end(), [&](const IslandResult& i) {
               return !i.failed.valid() ||
                      (known(i.failed) && assignment.from <= i.failed_at && i.failed_at < assignment.until);
           });
}

void Round::spend(SeatId seat_id, std::uint64_t cost_ns) {
    if (spent_ns_.size() <= seat_id) spent_ns_.resize(seat_id + std::size_t{1}, 0);
    spent_ns_[seat_id] += static_cast<double>(cost_ns);
}

double Round::busiest_ns() const {
    double busiest = 0;
    for (std::size_t seat_id = 0; seat_id < spent_ns_.size(); ++seat_id) {
        const double before = seat_id < spent_before_ns_.size() ? spent_before_ns_[seat_id] : 0;
        busiest = std::max(busiest, spent_ns_[seat_id] - before);
    }
    return busiest;
}

double Round::window_busiest_ns() const {
    return spent_ns_.empty() ? 0 : *std::max_element(spent_ns_.begin(), spent_ns_.end());
}

void Round::expect(std::uint64_t due_ns) {
    for (Sent& sent : sent_) sent.assignment.due_ns = due_ns;
}

void Round::take_late(SeatId seat_id, const Late& late) {
    if (late.epoch != span_.epoch || late.window != span_.window) return;
    for (Sent& sent : sent_)
        if (sent.seat_id == seat_id && sent.assignment.attempt == late.attempt) sent.needs_ns = late.needs_ns;
}

std::vector<Round::LateSeat> Round::late() const {
    std::vector<const Sent*> late;
    for (const Sent& sent : sent_)
        if (sent.needs_ns > 0 && !sent.cut && sent.assignment.island_offsets.size() > 2)
            late.push_back(&sent);
    std::stable_sort(late.begin(), late.end(),
                     [](const Sent* a, const Sent* b) { return a->needs_ns > b->needs_ns; });
    std::vector<LateSeat> seats;
    for (const Sent* sent : late)
        seats.push_back({sent->seat_id, sent->assignment.island_offsets.size() - 1});
    return seats;
}

std::vector<std::uint32_t> Round::idle(const Roster& roster) const {
    std::vector<SeatId> idle = roster.workers();
    std::erase_if(idle, [this](SeatId seat_id) {
        return std::any_of(sent_.begin(), sent_.end(), [seat_id](const Sent& sent) {
            return sent.seat_id == seat_id ||
                   std::find(sent.helpers.begin(), sent.helpers.end(), seat_id) != sent.helpers.end();
        });
    });
    return idle;
}

void Round::cut(Bus& bus, const Roster& roster, SeatId seat_id, std::vector<SeatId> helpers) {
    for (Sent& sent : sent_) {
        if (sent.seat_id != seat_id) continue;
        sent.cut = true;
        sent.helpers = std::move(helpers);
        return bus.send(kControllerAddress, roster.address_of(seat_id),
                        Cut{span_.epoch, span_.window, sent.assignment.attempt, roster.id_of(seat_id)});
    }
}

void Round::assign_rest(const Answered& cut_short, Tick at, std::span<const SeatId> seat_of_island,
                        std::uint64_t due_ns, const Roster& roster,
                        const std::function<void(Assignment&)>& complete) {
    ++attempt_;
    const Islands part{cut_short.assignment.island_offsets, cut_short.assignment.robots};
    write(part, seat_of_island, last_seat_, roster);
    for (std::size_t i = 0; i < part.count(); ++i)
        for (const RobotId robot : part.of(i)) {
            if (last_seat_[robot.index()] != seat_of_island[i]) since_[robot.index()] = at;
            last_seat_[robot.index()] = seat_of_island[i];
        }
    for (Assignment* assignment : assignment_of_seat_) {
        if (assignment == nullptr) continue;
        assignment->from = at;
        assignment->due_ns = due_ns;
        complete(*assignment);
    }
}

}  // namespace roboss
