// Steps in chunks, so that the wall time can be looked at between them.
#include "accuracy/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/figures.h"

namespace roboss::bench {

Trial::Trial(const Contender& contender, World world, bool fast_bodies)
    : world_(std::move(world)), patience_s_(contender.patience_s), start_(std::chrono::steady_clock::now()) {
    world_.dt_s = contender.dt_s;
    EngineOptions options;
    options.dt_s = contender.dt_s;
    options.fast_bodies = fast_bodies;
    engine_ = contender.kind->make(world_, options);
}

int Trial::whole(double ticks) {
    return static_cast<int>(std::lround(ticks));
}

bool Trial::run(double seconds) {
    wanted_s_ += seconds;
    return advance(seconds);
}

bool Trial::advance(double seconds) {
    using Seconds = std::chrono::duration<double>;
    constexpr double kLongChunk_s = 0.1;
    for (int left = whole(seconds / world_.dt_s); left > 0;) {
        const auto before = std::chrono::steady_clock::now();
        if (Seconds(before - start_).count() > patience_s_) return false;
        const int ticks = std::min(left, chunk_);
        engine_->step(ticks);
        ticks_ += ticks;
        left -= ticks;
        const bool slow = Seconds(std::chrono::steady_clock::now() - before).count() > kLongChunk_s;
        chunk_ = std::clamp(slow ? chunk_ / 2 : chunk_ * 2, 1, 64);
    }
    return true;
}

Vec3 Trial::centre(std::size_t instance, std::size_t link) const {
    const ModelSpec& model = world_.prototypes[world_.instances[instance].prototype];
    return place(instance, link, model.links[link].p_LC);
}

template <class Visit>
void Trial::for_moving_links(Visit visit) const {
    for (std::size_t i = 0; i < world_.instances.size(); ++i) {
        const ModelSpec& model = world_.prototypes[world_.instances[i].prototype];
        if (model.is_static) continue;
        for (std::size_t l = 0; l < model.links.size(); ++l) visit(model.links[l], engine_->link({i, l}));
    }
}

double Trial::widest_gap(std::size_t instance) const {
    const Pose& X_WM = world_.instances[instance].X_WM;
    const ModelSpec& model = world_.prototypes[world_.instances[instance].prototype];
    const auto place_in = [&](const std::string& name, const Vec3& p_M) {
        for (std::size_t l = 0; l < model.links.size(); ++l)
            if (model.links[l].name == name) return place(instance, l, inverse(model.links[l].X_ML) * p_M);
        return X_WM * p_M;  // the world
    };
    double gap = 0;
    for (const JointSpec& j : model.joints)
        gap = largest(gap, norm(place_in(j.parent, j.X_MJ.p) - place_in(j.child, j.X_MJ.p)));
    return gap;
}

double Trial::energy() const {
    double sum = 0;
    for_moving_links([&](const LinkSpec& spec, const LinkState& state) {
        const Vec3 w = rotate(conjugate(state.X_WL.q), state.angular);
        sum += 0.5 * spec.mass * norm_squared(state.v_WC) + 0.5 * dot(w, spec.inertia_C * w);
        sum -= spec.mass * dot(world_.gravity, state.X_WL * spec.p_LC);
    });
    return sum;
}

Trial::Momentum Trial::momentum() const {
    Momentum sum;
    for_moving_links([&](const LinkSpec& spec, const LinkState& state) {
        const Vec3 p = state.v_WC * spec.mass;
        const Vec3 w = rotate(conjugate(state.X_WL.q), state.angular);
        sum.linear += p;
        sum.angular += cross(state.X_WL * spec.p_LC, p) + rotate(state.X_WL.q, spec.inertia_C * w);
    });
    return sum;
}

double Trial::mass() const {
    double sum = 0;
    for_moving_links([&](const LinkSpec& spec, const LinkState&) { sum += spec.mass; });
    return sum;
}

Outcome Trial::outcome(std::vector<double> figures) const {
    Outcome out{std::move(figures)};
    if (time_s() > wanted_s_ - 0.5 * world_.dt_s) return out;
    out.share = time_s() / wanted_s_;
    out.remark = fmt::format("cut short after {:.2g} of {:.3g} s", time_s(), wanted_s_);
    return out;
}

Outcome Trial::impossible(std::size_t figures) {
    Outcome out;
    out.figures.assign(figures, std::numeric_limits<double>::quiet_NaN());
    out.possible = false;
    return out;
}

double corner_distance(const Pose& a, const Pose& b, const Vec3& size) {
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1 ? 0.5 : -0.5) * size.x, (corner & 2 ? 0.5 : -0.5) * size.y,
                     (corner & 4 ? 0.5 : -0.5) * size.z};
        distance = largest(distance, norm(a * p - b * p));
    }
    return distance;
}

}  // namespace roboss::bench
