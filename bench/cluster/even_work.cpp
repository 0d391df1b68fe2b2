// The same window again and again, by turns with stores and scratch of each Simulator's own.
#include "cluster/even_work.h"

#include <algorithm>
#include <memory>

#include "core/thread_cpu.h"
#include "roles/simulator/state_store.h"
#include "roles/simulator/window_stepper.h"

namespace roboss::bench {
namespace {

constexpr Tick kWindow = 128;
constexpr std::size_t kRounds = 60, kRoundsLeast = 6, kFewRobots = 50;

SteppingOptions timed(std::size_t lanes) {
    SteppingOptions options;
    options.clock = thread_cpu_ns;
    options.lanes = lanes;
    return options;
}

struct Seat {
    Seat(const Work& work, std::size_t lanes) : store(*work.model), stepper(work.model, pool, timed(lanes)) {}
    ThreadPool pool{1};
    StateStore store;
    WindowStepper stepper;
};

Assignment assignment_of(const Work& work, std::size_t robots) {
    Assignment assignment;
    assignment.window_from = assignment.from = work.before;
    assignment.until = assignment.from + kWindow;
    for (std::size_t r = 0; r < robots; ++r) assignment.robots.push_back(RobotId(r));
    assignment.island_offsets = {0, static_cast<std::uint32_t>(robots)};  // whether they meet or not
    for (const LoggedOrder& logged : work.orders)
        if (logged.order.robot.index() < robots && logged.order.apply_at >= assignment.from &&
            logged.order.apply_at < assignment.until)
            assignment.orders.push_back(logged.order);
    return assignment;
}

double stepping_ns(const Work& work, const Assignment& assignment, Seat& seat) {
    for (const RobotId robot : assignment.robots) {
        seat.store.put(robot, assignment.from, RobotState(work.states[robot.index()]));
        seat.store.start(robot, assignment.from);
    }
    const WindowResult result = *seat.stepper.step(
        assignment, seat.store, [](const StepProgress&) { return WindowStepper::Next::kContinue; });
    return static_cast<double>(result.islands[0].cost_ns);
}

}  // namespace

double even_efficiency(const Work& work, std::size_t simulators, std::size_t lanes) {
    const Assignment assignment =
        assignment_of(work, std::max<std::size_t>(work.model->robots.size() / simulators, 1));
    std::vector<std::unique_ptr<Seat>> seats;
    for (std::size_t i = 0; i < simulators; ++i) seats.push_back(std::make_unique<Seat>(work, lanes));
    double all_ns = 0, largest_ns = 0;
    const std::size_t rounds = std::max(kRounds * kFewRobots / work.model->robots.size(), kRoundsLeast);
    for (std::size_t round = 0; round <= rounds; ++round) {
        double largest = 0, sum = 0;
        for (const std::unique_ptr<Seat>& seat : seats) {
            const double ns = stepping_ns(work, assignment, *seat);
            largest = std::max(largest, ns);
            sum += ns;
        }
        if (round == 0) continue;  // memory comes to be there
        all_ns += sum;
        largest_ns += largest;
    }
    return all_ns / (static_cast<double>(simulators) * largest_ns);
}

}  // namespace roboss::bench
