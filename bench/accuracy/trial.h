// One World on one engine, with what cases ask of it. Energy and momentum are summed from the links' masses
// and what the engine says of their motion, alike for all engines.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/case.h"

namespace roboss::bench {

class Trial {
  public:
    /// `fast_bodies`: EngineOptions::fast_bodies.
    Trial(const Contender& contender, World world, bool fast_bodies = false);

    /// False: the engine cannot express the world; then nothing else may be asked.
    bool possible() const { return engine_ != nullptr; }
    Engine& engine() { return *engine_; }
    const World& world() const { return world_; }
    double dt_s() const { return world_.dt_s; }
    double time_s() const { return static_cast<double>(ticks_) * world_.dt_s; }

    /// Once the start is set and before it is asked for: some engines take it over with their first step
    /// only.
    void begin() { engine_->step(0); }
    /// Steps on by `seconds`; false if the wall time granted ran out before.
    bool run(double seconds);
    /// The same, with `visit()` after every `every_s`.
    template <class Visit>
    bool run(double seconds, double every_s, Visit&& visit) {
        const int parts = whole(seconds / every_s);
        wanted_s_ += seconds;
        for (int part = 0; part < parts; ++part) {
            if (!advance(every_s)) return false;
            visit();
        }
        return true;
    }

    LinkState link(std::size_t instance, std::size_t link = 0) const {
        return engine_->link({instance, link});
    }
    Vec3 centre(std::size_t instance, std::size_t link = 0) const;
    /// Where a point of the link frame is in the world.
    Vec3 place(std::size_t instance, std::size_t link, const Vec3& p_L) const {
        return engine_->link({instance, link}).X_WL * p_L;
    }

    /// Widest distance between the places of a joint in its two links, m, over all joints of the instance.
    double widest_gap(std::size_t instance) const;

    double energy() const;  // J, kinetic and of gravity; not of scenery
    struct Momentum {
        Vec3 linear, angular;  // angular: about the world's origin
    };
    Momentum momentum() const;
    double mass() const;

    /// The figures, with a remark if the run was cut short.
    Outcome outcome(std::vector<double> figures) const;
    static Outcome impossible(std::size_t figures);

  private:
    bool advance(double seconds);
    static int whole(double ticks);
    template <class Visit>
    void for_moving_links(Visit visit) const;

    World world_;
    std::unique_ptr<Engine> engine_;
    double patience_s_;
    std::chrono::steady_clock::time_point start_;
    int chunk_ = 1;  // ticks between two looks at the clock
    long ticks_ = 0;
    double wanted_s_ = 0;  // what all runs asked for
};

/// Largest distance that a corner of a box of `size` moved between two poses.
double corner_distance(const Pose& a, const Pose& b, const Vec3& size);

}  // namespace roboss::bench
