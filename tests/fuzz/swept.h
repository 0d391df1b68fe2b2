// Brute-force swept distance: how near shapes of different robots, and scenery, come to each other on a path
// that is given by samples close together. The oracle for contacts of what is fast: it bisects time and knows
// nothing of contact margins, normals or advancement.
#pragma once

#include <vector>

#include "physics/dynamics/robot_work.h"

namespace roboss::fuzz {

class SweptDistance {
  public:
    /// `stand_ins`: for scenery made of triangles, a convex shape equal to it outside; by index of
    /// Model::statics.
    SweptDistance(const Model& model, std::vector<Shape> stand_ins);

    /// Forgets the path.
    void clear() { samples_.clear(); }
    /// The next sample of the path: coordinates of all robots, by RobotId.
    void add(const std::vector<RobotState>& states);
    /// Samples from one state to the next, coordinates interpolated.
    void add_between(const std::vector<RobotState>& from, const std::vector<RobotState>& to, int samples);

    /// Least signed distance on the path, m, exact to `resolution`. Once it is below `enough` the search
    /// ends.
    double least_gap(double enough, double resolution);
    /// Of the pair that least_gap found: the smaller of the two shapes' least widths.
    double least_width() const { return width_; }

    /// Twice the radius of the largest ball that fits in, or less.
    static double width(const Shape& shape);

  private:
    struct Placed {
        Shape shape;
        std::uint32_t family = 0;  // shapes of one family never meet
        double radius = 0;
    };
    using Sample = std::vector<Transform>;

    void search(const Placed& a, const Placed& b, const Transform from[2], const Transform to[2]);

    const Model& model_;
    std::vector<Placed> shapes_;    // of robots by RobotId, then statics
    std::vector<Transform> fixed_;  // of the statics
    std::vector<Sample> samples_;
    RobotWork work_;
    double least_ = 0, width_ = 0, enough_ = 0, resolution_ = 0;
};

}  // namespace roboss::fuzz
