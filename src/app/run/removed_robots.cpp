// See removed_robots.h.
#include "app/run/removed_robots.h"

#include <algorithm>

namespace roboss {

void RemovedRobots::keep(const Removal& removal) {
    for (std::size_t i = 0; i < removal.now.size(); ++i) {
        if (removal.now[i].valid()) continue;
        RemovedRobot robot{removal.model, RobotId(i), removal.states[i], removal.worlds};
        robot.state.contacts.clear();
        robot.state.bonds.clear();
        robot.state.rest = {};
        robots_.push_back(std::move(robot));
    }
    std::size_t models = 0;
    const Model* last = nullptr;
    std::size_t kept = 0;
    for (auto robot = robots_.rbegin(); robot != robots_.rend() && kept < kRobotsMost; ++robot, ++kept)
        if (std::exchange(last, robot->model.get()) != robot->model.get() && ++models > kRemovalsMost) break;
    robots_.erase(robots_.begin(), robots_.end() - static_cast<std::ptrdiff_t>(kept));
}

std::size_t RemovedRobots::place_of(const std::string& name) const {
    for (std::size_t i = robots_.size(); i > 0; --i)
        if (robots_[i - 1].model->robots[robots_[i - 1].robot.index()].name == name) return i - 1;
    return robots_.size();
}

Result<std::vector<RemovedRobot>> RemovedRobots::find(const std::vector<std::string>& names) const {
    std::vector<RemovedRobot> found;
    for (const std::string& name : names) {
        const std::size_t place = place_of(name);
        if (place == robots_.size())
            return Error{"no robot '" + name + "' was removed, or it was removed too long ago",
                         "a run keeps the last " + std::to_string(kRobotsMost) + " robots of the last " +
                             std::to_string(kRemovalsMost) + " removals",
                         "no-robot"};
        found.push_back(robots_[place]);
    }
    return found;
}

void RemovedRobots::forget(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (const std::size_t place = place_of(name); place < robots_.size())
            robots_.erase(robots_.begin() + static_cast<std::ptrdiff_t>(place));
}

}  // namespace roboss
