// Ears are clipped (Meisters, "Polygons Have Ears", 1975), then triangles merged over the diagonals that a
// convex piece does not need (Hertel and Mehlhorn, 1983): at most four times the fewest pieces.
#include "geometry/polygon_pieces.h"

#include <algorithm>
#include <array>

#include "core/fixed_math.h"

namespace roboss {
namespace {

using Loop = std::vector<std::size_t>;  // corners of the outline

double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class Cutter {
  public:
    explicit Cutter(std::vector<Vec3> corners) : p_(std::move(corners)) {
        Vec3 low = p_[0], high = p_[0];
        for (const Vec3& p : p_) {
            low = {fixed_min(low.x, p.x), fixed_min(low.y, p.y), 0};
            high = {fixed_max(high.x, p.x), fixed_max(high.y, p.y), 0};
        }
        flat_ = 1e-9 * norm_squared(high - low);
    }

    double area() const {
        double twice = 0;
        for (std::size_t i = 0; i < p_.size(); ++i) {
            const Vec3 &a = p_[i], &b = p_[(i + 1) % p_.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        return 0.5 * twice;
    }
    bool is_flat(double area) const { return !(std::fabs(area) > flat_); }

    bool crosses_itself() const {
        const std::size_t n = p_.size();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = i + 2; j < n; ++j) {
                if (i == 0 && j + 1 == n) continue;  // neighbours
                const Vec3 &a = p_[i], &b = p_[i + 1], &c = p_[j], &d = p_[(j + 1) % n];
                if (turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0 &&
                    boxes_meet(a, b, c, d))
                    return true;
            }
        }
        return false;
    }

    bool cut(std::vector<Loop>& pieces) const {
        Loop rest(p_.size());
        for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
        while (rest.size() > 3) {
            const std::size_t ear = find_ear(rest);
            if (ear == rest.size()) return false;
            const std::size_t before = rest[(ear + rest.size() - 1) % rest.size()];
            const std::size_t after = rest[(ear + 1) % rest.size()];
            if (turn(p_[before], p_[rest[ear]], p_[after]) > flat_)
                pieces.push_back({before, rest[ear], after});
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        if (turn(p_[rest[0]], p_[rest[1]], p_[rest[2]]) > flat_) pieces.push_back(rest);
        return !pieces.empty();
    }

    void merge(std::vector<Loop>& pieces) const {
        for (bool merged = true; merged;) {
            merged = false;
            for (std::size_t i = 0; i < pieces.size() && !merged; ++i)
                for (std::size_t j = i + 1; j < pieces.size() && !merged; ++j) {
                    Loop both;
                    if (!joined(pieces[i], pieces[j], both)) continue;
                    pieces[i] = both;
                    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
                    merged = true;
                }
        }
    }

  private:
    static bool boxes_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        return fixed_max(a.x, b.x) >= fixed_min(c.x, d.x) && fixed_max(c.x, d.x) >= fixed_min(a.x, b.x) &&
               fixed_max(a.y, b.y) >= fixed_min(c.y, d.y) && fixed_max(c.y, d.y) >= fixed_min(a.y, b.y);
    }

    /// Of all ears the one whose shortest side is longest against its others would be best; the first is good
    /// enough, and corners on a straight line go first.
    std::size_t find_ear(const Loop& rest) const {
        const std::size_t n = rest.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 &a = p_[rest[(i + n - 1) % n]], &b = p_[rest[i]], &c = p_[rest[(i + 1) % n]];
            if (std::fabs(turn(a, b, c)) <= flat_) return i;
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 &a = p_[rest[(i + n - 1) % n]], &b = p_[rest[i]], &c = p_[rest[(i + 1) % n]];
            if (turn(a, b, c) <= 0) continue;
            const bool clear = std::none_of(rest.begin(), rest.end(), [&](std::size_t k) {
                const Vec3& q = p_[k];
                if (q == a || q == b || q == c) return false;
                return turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0;
            });
            if (clear) return i;
        }
        return n;
    }

    /// The union of two pieces over a common side, if it is convex.
    bool joined(const Loop& a, const Loop& b, Loop& both) const {
        for (std::size_t i = 0; i < a.size(); ++i) {
            for (std::size_t j = 0; j < b.size(); ++j) {
                if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
                both.clear();
                for (std::size_t k = 1; k <= a.size(); ++k) both.push_back(a[(i + k) % a.size()]);
                for (std::size_t k = 2; k < b.size(); ++k) both.push_back(b[(j + k) % b.size()]);
                return is_convex(both);
            }
        }
        return false;
    }

    bool is_convex(const Loop& loop) const {
        const std::size_t n = loop.size();
        for (std::size_t i = 0; i < n; ++i)
            if (turn(p_[loop[i]], p_[loop[(i + 1) % n]], p_[loop[(i + 2) % n]]) < -flat_) return false;
        return true;
    }

    std::vector<Vec3> p_;
    double flat_ = 0;
};

}  // namespace

Result<std::vector<std::vector<Vec3>>> convex_pieces(std::span<const Vec3> outline) {
    std::vector<Vec3> corners;
    for (const Vec3& p : outline) {
        if (!is_finite(p)) return Error{"has a corner that is not finite", ""};
        const Vec3 flat{p.x, p.y, 0};
        if (corners.empty() || !(corners.back() == flat)) corners.push_back(flat);
    }
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) return Error{"has fewer than three corners", ""};
    double area = Cutter(corners).area();
    if (area < 0) std::reverse(corners.begin(), corners.end()), area = -area;
    const Cutter cutter(corners);
    if (cutter.is_flat(area)) return Error{"has no area", ""};
    if (cutter.crosses_itself()) return Error{"crosses itself", ""};
    std::vector<Loop> pieces;
    if (!cutter.cut(pieces)) return Error{"cannot be cut into convex parts", ""};
    cutter.merge(pieces);
    std::vector<std::vector<Vec3>> result;
    for (const Loop& loop : pieces) {
        result.emplace_back();
        for (const std::size_t i : loop) result.back().push_back(corners[i]);
    }
    return result;
}

}  // namespace roboss
