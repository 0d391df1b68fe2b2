// Where robots on joints go in the coming tick if nothing touches them. A joint that moves freely accelerates
// its bodies, and only the robot's forward dynamics tells how much: without it a swinging link is off by
// (turn in the tick)^2 / 2 of its length. So the tick of such a robot is computed ahead, with the method that
// moves it, but only where a pair of shapes asks for it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/course.h"
#include "physics/dynamics/integrate.h"

namespace roboss {

/// The ticks that were computed ahead, by robot of a group.
class FreeCourses {
  public:
    /// Forgets all; `keep_reactions`: robots with loops do not move freely.
    void start(std::size_t robots, bool keep_reactions);
    /// Whether the robot `number`, which is `robot`, moves freely and has joints, and its tick is known.
    bool knows(const Model& model, const RobotWork& robot, std::size_t number);
    /// The course of one of its shapes, if so.
    std::optional<Course> find(const Model& model, const RobotWork& robot, std::size_t number,
                               std::size_t shape);

  private:
    enum class Ahead : char { kUnknown, kNone, kComputed };
    struct Flight {
        Ahead ahead = Ahead::kUnknown;
        std::vector<BodyMotion> ends;  // by body, at the end of the tick
    };
    bool compute(const Model& model, const RobotWork& robot, std::vector<BodyMotion>& ends);

    std::vector<Flight> flights_;  // by robot
    std::size_t count_ = 0;
    bool keep_reactions_ = false;
    RobotWork work_;  // of a robot that is moved ahead
    RobotState state_;
    FreeBuffer buffer_;
};

/// The motion of a shape as far as it is known before solving: by the velocities before the tick, and by the
/// joints' accelerations where they are free.
Course known_course(const Model& model, const RobotWork& robot, std::size_t number, std::size_t shape,
                    FreeCourses& free_courses);

}  // namespace roboss
