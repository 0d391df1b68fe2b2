// What each kind of on-board controller does in a tick: one function and one file a kind. A kind may also
// have `rests`: whether it would change nothing while its robot is at rest (without it, it does not).
#pragma once

#include "onboard/onboard_context.h"

namespace roboss {

void run(const VelocityControlSpec& spec, OnboardContext& c);
/// Nothing: a control program reacts to the messages (onboard_kinds/message_board.h).
inline void run(const MessageBoardSpec&, OnboardContext&) {}

}  // namespace roboss
