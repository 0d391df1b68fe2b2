// LooksOf: what a world looks like, for Python: the Worlds that its Model was made of.
#pragma once

#include "roboss/local_view/local_view.h"

namespace roboss_python {

struct LooksOf {
    roboss::Looks worlds;
};

}  // namespace roboss_python
