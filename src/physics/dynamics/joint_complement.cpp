// See joint_complement.h. Gram and Schmidt's method with reorthogonalisation.
#include "physics/dynamics/joint_complement.h"

#include <cmath>

namespace roboss {
namespace {

double& part(Spatial& v, std::size_t i) {
    return i < 3 ? v.angular[i] : v.linear[i - 3];
}

struct Basis {
    std::array<Spatial, 6> vectors;
    std::size_t count = 0;

    /// What is left of v, a unit vector or zero.
    Spatial remainder(Spatial v) const {
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t i = 0; i < count; ++i) v = v - vectors[i] * dot(vectors[i], v);
        return v;
    }
    void add(const Spatial& v) {
        const Spatial rest = remainder(v);
        const double length = std::sqrt(dot(rest, rest));
        if (length > 0) vectors[count++] = rest * (1.0 / length);
    }
};

}  // namespace

JointComplement joint_complement(std::span<const Spatial> axes) {
    Basis basis;
    for (const Spatial& axis : axes) basis.add(axis);
    JointComplement out;
    while (basis.count < 6) {
        // The unit vector of which most is left.
        std::size_t best = 0;
        double most = -1;
        for (std::size_t i = 0; i < 6; ++i) {
            double left = 1;
            for (std::size_t k = 0; k < basis.count; ++k) {
                const double along = part(basis.vectors[k], i);
                left -= along * along;
            }
            if (left > most) most = left, best = i;
        }
        Spatial unit;
        part(unit, best) = 1;
        basis.add(unit);
        out.wrenches[out.count++] = basis.vectors[basis.count - 1];
    }
    return out;
}

}  // namespace roboss
