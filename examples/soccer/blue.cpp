// The blue team plays in zones. `roboss run soccer.sdf --client roboss_soccer_blue.so ...` (docs/soccer.md).
#include "team.h"

using BlueTeam = soccer::TeamProgram<soccer::Team::kBlue, soccer::play_zones>;
ROBOSS_CONTROL_PROGRAM(BlueTeam)
