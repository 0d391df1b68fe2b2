// The first leg takes its states from the checkpoint; each next one stays with the Simulators of the one
// before.
#include "roles/controller/recovery.h"

#include <algorithm>

#include "core/check.h"
#include "roles/controller/order_feed.h"

namespace roboss {

void Recovery::begin() {
    robots_ = checkpoints_.closure(directory_.lost(roster_));
    ROBOSS_CHECK(!robots_.empty(), "a recovery begins with nothing lost");
    directory_.begin_recovery(robots_, checkpoints_.tick());
}

Islands Recovery::islands() {
    Islands islands;
    collect_islands(checkpoints_.touched(), robots_, islands);
    return islands;
}

Round Recovery::first_leg(std::uint32_t epoch, std::uint64_t window) {
    const Tick from = checkpoints_.tick();
    const Islands islands = this->islands();
    const std::vector<SeatId> at_controller(directory_.holders().size(), kAtController);
    return leg({epoch, window, from, directory_.next_needed(from), true}, islands,
               costs_.assign_recovered(islands, roster_), at_controller);
}

Round Recovery::next_leg(const Round& before, std::uint64_t window) {
    const Tick from = before.span().until;
    const Islands islands = this->islands();
    std::vector<SeatId> seat_of_island;
    for (std::size_t i = 0; i < islands.count(); ++i)
        seat_of_island.push_back(before.seat_of(islands.of(i).front()));
    Round round = leg({before.span().epoch, window, from, directory_.next_needed(from), true}, islands,
                      seat_of_island, before.seats());
    std::vector<std::vector<RobotId>> kept(roster_.size());
    for (const RobotId robot : robots_) kept[before.seat_of(robot)].push_back(robot);
    for (SeatId seat = 0; seat < kept.size(); ++seat)
        if (!kept[seat].empty()) round.keep(seat, std::move(kept[seat]));
    return round;
}

Round Recovery::leg(const RoundSpan& span, const Islands& islands, std::span<const SeatId> seat_of_island,
                    std::span<const SeatId> source) {
    ROBOSS_CHECK(span.from < span.until && span.until <= directory_.tick(),
                 "a leg of a recovery to tick " + std::to_string(directory_.tick()) + " from tick " +
                     std::to_string(span.from) + " to " + std::to_string(span.until));
    Round round(span, directory_.holders().size());
    round.assign(islands, seat_of_island, source, roster_);
    give_all(order_log_, round);
    round.release_before(std::min(checkpoints_.tick(), directory_.oldest_wanted(checkpoints_.tick())));
    round.islands = islands;
    return round;
}

std::optional<RobotId> Recovery::first_difference(std::span<const std::uint64_t> hashes,
                                                  std::span<const std::uint64_t> committed) const {
    const auto differs = std::find_if(robots_.begin(), robots_.end(), [&](RobotId robot) {
        return hashes[robot.index()] != committed[robot.index()];
    });
    return differs == robots_.end() ? std::nullopt : std::optional(*differs);
}

bool Recovery::finish_leg(const Round& leg) {
    directory_.recovered(robots_, leg.span().until, leg.seats(), roster_);
    return leg.span().until == directory_.tick();
}

}  // namespace roboss
