// The robots and bodies at both sides of the soft solver's patches (lane_soft.h), kWidth patches side by
// side: free bodies of six coordinates, or robots with joints.
#pragma once

#include "physics/lanes/lane_six.h"
#include "physics/lanes/lane_transpose.h"
#include "physics/soft/soft_rows.h"

namespace roboss {
namespace {

[[gnu::always_inline]] inline Part at(const soft::Eight& numbers, std::size_t lane) {
    return load_part(numbers.x + lane);
}
[[gnu::always_inline]] inline void put(const Part& part, std::size_t lane, soft::Eight& numbers) {
    store_part(part, numbers.x + lane);
}

/// Six numbers of a body of each lane.
struct Columns {
    Part x[6];
};

/// The first six numbers of the chosen bodies, with `kBehind` all eight.
template <bool kBehind = false>
[[gnu::always_inline]] inline void gather(const soft::Motion* bodies, const int* chosen, Part* numbers) {
    constexpr std::size_t kCount = kBehind ? 8 : 6;
    for (std::size_t k = 0; k < kCount; k += kWidth) {
        Part block[kWidth];
        for (std::size_t i = 0; i < kWidth; ++i) block[i] = load_part(bodies[chosen[i]].x + k);
        transpose<kWidth>(block);
        for (std::size_t i = 0; i < kWidth && k + i < kCount; ++i) numbers[k + i] = block[i];
    }
}
/// The same back. Without `kBehind` the last two become 0.
template <bool kBehind = false>
[[gnu::always_inline]] inline void scatter(const Part* numbers, const int* chosen, soft::Motion* bodies) {
    constexpr std::size_t kCount = kBehind ? 8 : 6;
    for (std::size_t k = 0; k < kCount; k += kWidth) {
        Part block[kWidth];
        for (std::size_t i = 0; i < kWidth; ++i) block[i] = k + i < kCount ? numbers[k + i] : Part{};
        transpose<kWidth>(block);
        for (std::size_t i = 0; i < kWidth; ++i) store_part(block[i], bodies[chosen[i]].x + k);
    }
}
[[gnu::always_inline]] inline Part dot3(const soft::Eight* j, const Part* x, std::size_t lane) {
    return (at(j[0], lane) * x[0] + at(j[1], lane) * x[1]) + at(j[2], lane) * x[2];
}
[[gnu::always_inline]] inline void add3(Part* x, const soft::Eight* j, const Part& f, std::size_t lane) {
    for (std::size_t i = 0; i < 3; ++i) x[i] = x[i] + at(j[i], lane) * f;
}

/// Free bodies. A point's row is the patch's normal and the turning that it causes; so the relative speed
/// along the normal is kept as one number while the points of the patch are solved.
template <bool kScenery>
class BodySides {
  public:
    [[gnu::always_inline]] BodySides(soft::Problem& problem, const soft::Batch& batch,
                                     const soft::Patch& patch, std::size_t lane)
        : problem_(problem), batch_(batch), patch_(patch), lane_(lane) {
        gather(problem.velocity.data(), batch.a + lane, a_.x);
        if constexpr (!kScenery) gather(problem.velocity.data(), batch.b + lane, b_.x);
        inverse_mass_a_ = at(patch.inverse_mass_a, lane), inverse_mass_b_ = at(patch.inverse_mass_b, lane);
    }
    [[gnu::always_inline]] void finish() {
        scatter(a_.x, batch_.a + lane_, problem_.velocity.data());
        if constexpr (!kScenery) scatter(b_.x, batch_.b + lane_, problem_.velocity.data());
    }

    /// Before the points of the patch are solved, and after that.
    [[gnu::always_inline]] void start_normals() {
        gather(problem_.displacement.data(), batch_.a + lane_, da_.x);
        if constexpr (!kScenery) gather(problem_.displacement.data(), batch_.b + lane_, db_.x);
        moved_ = along(patch_.n, da_, db_);
        speed_n_ = along(patch_.n, a_, b_), sum_ = Part{};
    }
    [[gnu::always_inline]] void start_warm() { speed_n_ = sum_ = Part{}; }
    [[gnu::always_inline]] void start_bounce() { speed_n_ = along(patch_.n, a_, b_), sum_ = Part{}; }
    [[gnu::always_inline]] void finish_normals() { push(patch_.n, sum_); }
    /// `own`: of the surfaces besides.
    [[gnu::always_inline]] Part speed(int, const soft::Point& p, const Part& own) const {
        return (speed_n_ + own) + turning(p.turn_a, p.turn_b, a_, b_);
    }
    [[gnu::always_inline]] Part gap(int, const soft::Point& p, const Part& own) const {
        return (at(p.gap, lane_) + moved_) + (turning(p.turn_a, p.turn_b, da_, db_) + own);
    }
    [[gnu::always_inline]] void push_point(int, const soft::Point& p, const Part& f) {
        sum_ = sum_ + f;
        speed_n_ = speed_n_ + inverse_mass() * f;
        turn(p.turn_a, p.turn_b, f);
    }
    [[gnu::always_inline]] Part twist_speed() const {
        return turning(patch_.twist_a, patch_.twist_b, a_, b_);
    }
    [[gnu::always_inline]] void push_twist(const Part& f) { turn(patch_.twist_a, patch_.twist_b, f); }
    [[gnu::always_inline]] Part slide_speed_1() const {
        return along(patch_.t1, a_, b_) + turning(patch_.slide_1a, patch_.slide_1b, a_, b_);
    }
    [[gnu::always_inline]] Part slide_speed_2() const {
        return along(patch_.t2, a_, b_) + turning(patch_.slide_2a, patch_.slide_2b, a_, b_);
    }
    [[gnu::always_inline]] void push_slide(const Part& f1, const Part& f2) {
        push(patch_.t1, f1), push(patch_.t2, f2);
        turn(patch_.slide_1a, patch_.slide_1b, f1), turn(patch_.slide_2a, patch_.slide_2b, f2);
    }

  private:
    [[gnu::always_inline]] Part inverse_mass() const {
        return kScenery ? inverse_mass_a_ : inverse_mass_a_ + inverse_mass_b_;
    }
    [[gnu::always_inline]] Part along(const soft::Eight* direction, const Columns& a,
                                      const Columns& b) const {
        if constexpr (kScenery) return dot3(direction, a.x, lane_);
        Part difference[3];
        for (std::size_t i = 0; i < 3; ++i) difference[i] = a.x[i] - b.x[i];
        return dot3(direction, difference, lane_);
    }
    [[gnu::always_inline]] Part turning(const soft::Eight* turn_a, const soft::Eight* turn_b,
                                        const Columns& a, const Columns& b) const {
        if constexpr (kScenery) return dot3(turn_a, a.x + 3, lane_);
        return dot3(turn_a, a.x + 3, lane_) + dot3(turn_b, b.x + 3, lane_);
    }
    [[gnu::always_inline]] void push(const soft::Eight* direction, const Part& f) {
        const Part by_a = inverse_mass_a_ * f, by_b = inverse_mass_b_ * f;
        for (std::size_t i = 0; i < 3; ++i) {
            a_.x[i] = a_.x[i] + at(direction[i], lane_) * by_a;
            if constexpr (!kScenery) b_.x[i] = b_.x[i] - at(direction[i], lane_) * by_b;
        }
    }
    [[gnu::always_inline]] void turn(const soft::Eight* turn_a, const soft::Eight* turn_b, const Part& f) {
        add3(a_.x + 3, turn_a, f, lane_);
        if constexpr (!kScenery) add3(b_.x + 3, turn_b, f, lane_);
    }

    soft::Problem& problem_;
    const soft::Batch& batch_;
    const soft::Patch& patch_;
    std::size_t lane_;
    Columns a_, b_, da_, db_;
    Part inverse_mass_a_, inverse_mass_b_;
    Part moved_, speed_n_, sum_;  // along the normal; the points' impulses so far
};

/// Robots with joints and what they touch. Rows have six columns at each side and those further along the
/// path of the body that is touched. `kFurther`: of these, at both sides; 0: as many as the batch has.
template <bool kScenery, int kFurther>
class TreeSides {
  public:
    [[gnu::always_inline]] TreeSides(soft::Problem& problem, const soft::Batch& batch,
                                     const soft::Patch& patch, std::size_t lane)
        : problem_(problem), batch_(batch), lane_(lane) {
        load(problem.velocity, a_, b_);
        scale_a_ = at(patch.inverse_mass_a, lane), scale_b_ = at(patch.inverse_mass_b, lane);
    }
    [[gnu::always_inline]] void finish() {
        store(batch_.a, batch_.path_a, a_);
        if constexpr (!kScenery) store(batch_.b, batch_.path_b, b_);
    }

    [[gnu::always_inline]] void start_normals() { load(problem_.displacement, da_, db_); }
    [[gnu::always_inline]] void start_warm() {}
    [[gnu::always_inline]] void start_bounce() {}
    [[gnu::always_inline]] void finish_normals() {}
    [[gnu::always_inline]] Part speed(int k, const soft::Point&, const Part& own) const {
        return along(k, a_, b_) + own;
    }
    [[gnu::always_inline]] Part gap(int k, const soft::Point& p, const Part& own) const {
        return at(p.gap, lane_) + (along(k, da_, db_) + own);
    }
    [[gnu::always_inline]] void push_point(int k, const soft::Point&, const Part& f) { push(k, f); }
    [[gnu::always_inline]] Part slide_speed_1() const { return along(batch_.points, a_, b_); }
    [[gnu::always_inline]] Part slide_speed_2() const { return along(batch_.points + 1, a_, b_); }
    [[gnu::always_inline]] Part twist_speed() const { return along(batch_.points + 2, a_, b_); }
    [[gnu::always_inline]] void push_slide(const Part& f1, const Part& f2) {
        push(batch_.points, f1), push(batch_.points + 1, f2);
    }
    [[gnu::always_inline]] void push_twist(const Part& f) { push(batch_.points + 2, f); }

  private:
    /// Coordinates of each lane: eight of which the last two are only kept, then those further along.
    static constexpr std::size_t kNumbers = kFurther > 0 ? 8 + kFurther : 2 + soft::kMostColumns;

    [[gnu::always_inline]] static int further(const soft::Path& path) {
        return kFurther > 0 ? kFurther : path.further;
    }
    [[gnu::always_inline]] std::size_t columns_a() const {
        return 6 + static_cast<std::size_t>(further(batch_.path_a));
    }
    [[gnu::always_inline]] std::size_t columns_b() const {
        return kScenery ? 0 : 6 + static_cast<std::size_t>(further(batch_.path_b));
    }
    [[gnu::always_inline]] const soft::Eight* row(int k) const {
        return problem_.columns.data() + batch_.first_column +
               static_cast<std::size_t>(k) * (columns_a() + columns_b());
    }
    [[gnu::always_inline]] const int* place(const soft::Path& path, int k) const {
        return problem_.places.data() + path.first + static_cast<std::size_t>(k) * 8 + lane_;
    }
    [[gnu::always_inline]] void load(const std::vector<soft::Motion>& from, Part* a, Part* b) const {
        load(from, batch_.a, batch_.path_a, a);
        if constexpr (!kScenery) load(from, batch_.b, batch_.path_b, b);
    }
    [[gnu::always_inline]] void load(const std::vector<soft::Motion>& from, const int* chosen,
                                     const soft::Path& path, Part* to) const {
        gather<true>(from.data(), chosen + lane_, to);
        const double* numbers = from.data()->x;
        for (int k = 0; k < further(path); ++k) {
            const int* places = place(path, k);
            Part column{};
            for (std::size_t i = 0; i < kWidth; ++i) column[i] = numbers[places[i]];
            to[8 + k] = column;
        }
    }
    [[gnu::always_inline]] void store(const int* chosen, const soft::Path& path, const Part* from) {
        scatter<true>(from, chosen + lane_, problem_.velocity.data());
        double* numbers = problem_.velocity.data()->x;
        for (int k = 0; k < further(path); ++k) {
            const int* places = place(path, k);
            for (std::size_t i = 0; i < kWidth; ++i) numbers[places[i]] = from[8 + k][i];
        }
    }
    [[gnu::always_inline]] Part dot(const soft::Eight* j, std::size_t columns, const Part* x) const {
        Part sum = (at(j[0], lane_) * x[0] + at(j[1], lane_) * x[1]) + at(j[2], lane_) * x[2],
             more = (at(j[3], lane_) * x[3] + at(j[4], lane_) * x[4]) + at(j[5], lane_) * x[5];
        for (std::size_t c = 6; c < columns; ++c) more = more + at(j[c], lane_) * x[c + 2];
        return sum + more;
    }
    [[gnu::always_inline]] Part along(int k, const Part* a, const Part* b) const {
        const soft::Eight* j = row(k);
        if constexpr (kScenery) return dot(j, columns_a(), a);
        return dot(j, columns_a(), a) + dot(j + columns_a(), columns_b(), b);
    }
    [[gnu::always_inline]] void push(const soft::Eight* j, std::size_t columns, const Part& scale,
                                     const Part& f, Part* x) const {
        const Part scaled = scale * f;
        for (std::size_t c = 0; c < 3; ++c) x[c] = x[c] + at(j[c], lane_) * scaled;
        for (std::size_t c = 3; c < 6; ++c) x[c] = x[c] + at(j[c], lane_) * f;
        for (std::size_t c = 6; c < columns; ++c) x[c + 2] = x[c + 2] + at(j[c], lane_) * f;
    }
    [[gnu::always_inline]] void push(int k, const Part& f) {
        const soft::Eight* j = row(k);
        push(j, columns_a(), scale_a_, f, a_);
        if constexpr (!kScenery) push(j + columns_a(), columns_b(), scale_b_, f, b_);
    }

    soft::Problem& problem_;
    const soft::Batch& batch_;
    std::size_t lane_;
    Part a_[kNumbers], b_[kNumbers], da_[kNumbers], db_[kNumbers];
    Part scale_a_, scale_b_;  // of the first three columns
};

}  // namespace
}  // namespace roboss
