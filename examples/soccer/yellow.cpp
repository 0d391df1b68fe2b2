// The yellow team plays as a pack. `roboss run soccer.sdf --client roboss_soccer_yellow.so ...`
// (docs/soccer.md).
#include "team.h"

using YellowTeam = soccer::TeamProgram<soccer::Team::kYellow, soccer::play_pack>;
ROBOSS_CONTROL_PROGRAM(YellowTeam)
