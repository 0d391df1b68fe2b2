// The <keyframe> of an MJCF file: states from which a world may start. MuJoCo starts where the bodies stand
// and loads a keyframe only where a program asks for it (mj_resetDataKeyframe); so it is here.
#pragma once

#include <string>

#include "mjcf/robots.h"

namespace roboss::mjcf {

/// Lets the robots start at the <key> of this name, or of this number, as MuJoCo counts them from 0; empty:
/// they start where the bodies stand, and a note names the keys. Takes qpos, qvel, mpos and mquat; `ctrl` and
/// `act` are for programs that control. An error says what exists if there is no such key, or that its
/// numbers do not fit the joints.
void start_at_keyframe(const std::string& wanted, const Document& document, Robots& robots,
                       Diagnostics& diagnostics);

}  // namespace roboss::mjcf
