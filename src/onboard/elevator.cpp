// See onboard_kinds/elevator.h. The states and the tolerances are those of Gazebo.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/topics.h"
#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr double kDoorNear = 0.02,  // m
    kCabinNear = 0.15,              // m
    kSlow = 0.01;                   // m/s
constexpr std::size_t kCabin = 0;   // among its joints; then the doors

class ElevatorRun {
  public:
    ElevatorRun(const ElevatorSpec& spec, OnboardContext& c) : spec_(spec), c_(c), memory_(c.memory()) {}

    void run() {
        hear();
        const double period = spec_.update_rate > 0 ? 1 / (spec_.update_rate * c_.dt()) : 1;
        const auto ticks = std::max<Tick>(1, static_cast<Tick>(std::floor(period + 0.5)));
        if (c_.tick() % ticks != 0) return;
        memory_[ElevatorSpec::kFloor] = nearest_floor();
        act();
    }

  private:
    double& at(ElevatorSpec::Memory place) { return memory_[place]; }
    ElevatorSpec::State state() {
        return static_cast<ElevatorSpec::State>(static_cast<int>(at(ElevatorSpec::kState)));
    }
    std::size_t floors() const { return spec_.floors.size(); }
    std::size_t floor() { return static_cast<std::size_t>(at(ElevatorSpec::kFloor)); }
    /// The floors in the queue, with one place more than are used if it is not full.
    std::span<double> queue() { return memory_.subspan(ElevatorSpec::kLists, floors()); }
    std::span<double> deferred() { return memory_.subspan(ElevatorSpec::kLists + floors(), floors()); }

    /// A new command goes to the queue, or waits until the door closes.
    void hear() {
        const auto commanded = static_cast<double>(c_.commanded_at(0));
        if (commanded <= at(ElevatorSpec::kHeard)) return;
        at(ElevatorSpec::kHeard) = commanded;
        const double target = std::floor(c_.command(0)[0]);
        if (!(target >= 0) || target >= static_cast<double>(floors())) return;
        if (state() == ElevatorSpec::kIdle || state() == ElevatorSpec::kCloses) return enqueue(target);
        double& count = at(ElevatorSpec::kDeferred);
        const auto used = deferred().first(static_cast<std::size_t>(count));
        if (std::ranges::find(used, target) != used.end()) return;
        deferred()[used.size()] = target;
        count += 1;
    }

    /// A floor on the way to one that is queued comes before it.
    void enqueue(double target) {
        double& count = at(ElevatorSpec::kQueued);
        const auto size = static_cast<std::size_t>(count);
        const std::span<double> all = queue();
        if (std::ranges::find(all.first(size), target) != all.begin() + static_cast<std::ptrdiff_t>(size))
            return;
        double before = at(ElevatorSpec::kFloor);
        std::size_t place = 0;
        for (; place < size; ++place) {
            const double next = all[place];
            if (target >= std::min(before, next) && target < std::max(before, next)) break;
            before = next;
        }
        for (std::size_t i = size; i > place; --i) all[i] = all[i - 1];
        all[place] = target;
        count += 1;
    }

    void pop() {
        double& count = at(ElevatorSpec::kQueued);
        const std::span<double> all = queue();
        for (std::size_t i = 1; i < all.size(); ++i) all[i - 1] = all[i];
        all.back() = 0;
        count -= 1;
    }

    void act() {
        switch (state()) {
            case ElevatorSpec::kIdle:
                if (at(ElevatorSpec::kQueued) == 0) return;
                if (queue()[0] != at(ElevatorSpec::kFloor)) return start_moving();
                pop();
                return enter(ElevatorSpec::kOpens);
            case ElevatorSpec::kMoves:
                if (!is_there(kCabin, height(static_cast<std::size_t>(queue()[0])), kCabinNear)) return;
                pop();
                return enter(ElevatorSpec::kOpens);
            case ElevatorSpec::kOpens:
                if (is_there(1 + floor(), c_.dof(1 + floor()).upper, kDoorNear)) enter(ElevatorSpec::kWaits);
                return;
            case ElevatorSpec::kWaits:
                if (c_.time() >= at(ElevatorSpec::kOpenSince) + spec_.open_door_wait_duration)
                    enter(ElevatorSpec::kCloses);
                return;
            case ElevatorSpec::kCloses:
                if (!is_there(1 + floor(), 0, kDoorNear)) return;
                if (at(ElevatorSpec::kQueued) == 0) return enter(ElevatorSpec::kIdle);
                return start_moving();
        }
    }

    void start_moving() {
        command(kCabin, height(static_cast<std::size_t>(queue()[0])));
        enter(ElevatorSpec::kMoves);
    }

    void enter(ElevatorSpec::State next) {
        at(ElevatorSpec::kState) = static_cast<int>(next);
        if (next == ElevatorSpec::kOpens) command(1 + floor(), c_.dof(1 + floor()).upper);
        if (next == ElevatorSpec::kWaits) at(ElevatorSpec::kOpenSince) = c_.time();
        if (next != ElevatorSpec::kCloses) return;
        command(1 + floor(), 0);
        double& count = at(ElevatorSpec::kDeferred);
        for (double& target : deferred().first(static_cast<std::size_t>(count)))
            enqueue(std::exchange(target, 0));
        count = 0;
    }

    void command(std::size_t joint, double position) { c_.give_command(joint, {&position, 1}); }
    bool is_there(std::size_t joint, double target, double near) {
        return std::fabs(target - c_.position(joint)) <= near && c_.velocity(joint) <= kSlow;
    }
    /// z of the floor's link in the model.
    double height(std::size_t floor) {
        const Transform X_WR = robot_pose(c_.type(), base_pose(c_.state()));
        return (inverse(X_WR) * c_.pose(c_.link(floor))).p.z;
    }
    /// Gazebo compares whole metres; of equal ones the lowest floor counts.
    double nearest_floor() {
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < floors(); ++i) {
            const double apart = std::floor(std::fabs(height(i) - c_.position(kCabin)));
            if (apart < least) nearest = i, least = apart;
        }
        return static_cast<double>(nearest);
    }

    const ElevatorSpec& spec_;
    OnboardContext& c_;
    std::span<double> memory_;
};

}  // namespace

void run(const ElevatorSpec& spec, OnboardContext& c) {
    if (spec.fault().empty()) ElevatorRun(spec, c).run();
}

}  // namespace roboss
