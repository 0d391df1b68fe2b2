// Status of a run, and which Simulator and island each robot is in.
#include "app/run/run.h"

namespace roboss {
namespace {

MemberState state_of(const MemberReport& member) {
    if (member.alive) return member.leaving ? MemberState::kLeaving : MemberState::kActive;
    return member.leaving ? MemberState::kLeft : MemberState::kLost;
}

}  // namespace

RunStatus Run::status(bool with_robots) const {
    const Counters& c = simulation_->counters();
    RunStatus s;
    s.world = o_.world;
    s.tick = simulation_->tick(), s.time_s = simulation_->time_s();
    s.paused = pace_.paused, s.over = over_, s.speed = pace_.speed;
    s.islands = c.islands_now, s.window = simulation_->window_ticks();
    s.windows = c.windows, s.repeated = c.windows_repeated;
    s.efficiency = simulation_->balance(), s.step_cpu_s = c.step_cpu_s;
    s.losses = c.losses, s.recoveries = c.recoveries, s.migrations = c.migrations, s.cuts = c.cuts;
    s.messages = traffic_.total();
    s.model_hash = model_->hash, s.state_hash = simulation_->hash();
    if (const std::string& file = journal_->file(); !file.empty()) {
        s.branch = journal_->branch();
        s.first_s = static_cast<double>(journal_->first_tick()) * model_->dt_s;
        s.timeline = journal_->timeline_serial();
        s.journal_bytes = journal_->bytes();
        s.journal_mb_per_min = journal_->growth_mb_per_min(simulation_->bus().now_ms());
        s.replay = journal_->replay().has_value();
    }
    for (const MemberReport& m : simulation_->members())
        s.members.push_back({m.number, m.name, state_of(m), m.threads, m.robots, m.islands, m.step_us, m.load,
                             traffic_.of(m.address), m.alive && members_->owns(m.name)});
    s.robot_count = model_->robots.size();
    if (with_robots)
        for (const Robot& robot : model_->robots) s.robots.push_back(robot.name);
    return s;
}

RobotGroups Run::groups() const {
    const std::size_t seats = simulation_->members().size();
    RobotGroups groups{model_->hash, {}, std::vector<std::int32_t>(model_->robots.size(), -1)};
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const std::uint32_t seat = simulation_->seat_of(RobotId(r));
        groups.simulator.push_back(seat < seats ? static_cast<std::int32_t>(seat) : -1);
    }
    const Islands& islands = simulation_->islands();
    for (std::size_t i = 0; i < islands.count(); ++i)
        for (const RobotId robot : islands.of(i))
            groups.island[robot.index()] = static_cast<std::int32_t>(islands.of(i).front().value);
    return groups;
}

RunProfile Run::profile() {
    const RunProfile profile =
        meter_.asked(simulation_->bus().now_ms(), simulation_->tick(), model_->accuracy.friction_tolerance);
    measure();
    return profile;
}

void Run::measure() {
    simulation_->measure(o_.profile_steps || meter_.wanted(simulation_->bus().now_ms()));
}

void Run::take_profile() {
    const StepProfile more = simulation_->take_profile();
    profile_ += more;
    meter_.add(more);
}

RobotBounds Run::bounds() const {
    RobotBounds bounds{model_->hash, {}};
    for (const RobotMotion& motion : simulation_->motions()) bounds.boxes.push_back(motion.swept);
    return bounds;
}

}  // namespace roboss
