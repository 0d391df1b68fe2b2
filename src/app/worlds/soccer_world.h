// A field of robot soccer with two teams and a golf ball as an SDF 1.9 world: of FIRA MiroSot, whose robots
// are cubes of 7.5 cm with two wheels, or of RoboCup's Small Size League (ssl_world.h). They stand as for a
// kick-off of the blue team, which plays towards +x.
#pragma once

#include <string>

namespace roboss {

struct SoccerOptions {
    std::string league = "small";  // small: 3 robots a side, middle: 5, large: 11; ssl-b: 6, ssl-a: 11
    // MiroSot: a radio on each robot, and a station of each team beside the field that sends its commands.
    bool radio = false;
    double radio_loss = 0;  // probability that a robot does not get a message
};

/// Empty if there is no such league.
std::string soccer_sdf(const SoccerOptions& options);

}  // namespace roboss
