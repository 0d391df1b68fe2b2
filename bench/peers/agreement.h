// Do the adapters mean the same? Small mechanisms, moved for a tenth of a second by every engine, must end
// where RoBOSS ends: a turned sign of an axis, an angle or a frame would show.
#pragma once

namespace roboss::bench {

/// Prints a line an engine and mechanism; true if all agree (what an engine cannot express is said, not
/// judged).
bool engines_agree();

}  // namespace roboss::bench
