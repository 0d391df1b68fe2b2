// A field of FIRA MiroSot with two teams and a golf ball as an SDF 1.9 world. Its robots are cubes of 7.5 cm
// with two wheels; they stand as for a kick-off of the blue team, which plays towards +x.
#pragma once

#include <string>

namespace roboss {

struct SoccerOptions {
    std::string league = "small";  // small: 3 robots a side, middle: 5, large: 11
};

/// Empty if there is no such league.
std::string soccer_sdf(const SoccerOptions& options);

}  // namespace roboss
