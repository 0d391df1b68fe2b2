// LooksOf: what a world looks like, for Python: the Worlds that its Model was made of.
#pragma once

#include "roboss/local_view/local_view.h"
#include "roboss/visuals/visual_source.h"

namespace roboss_python {

struct LooksOf {
    roboss::Looks worlds;
    roboss::render::VisualsOf visuals;  // made when the first run asks; shared by all runs

    const roboss::render::VisualsOf& seen() {
        if (!visuals) visuals = roboss::visuals_of(worlds);
        return visuals;
    }
};

}  // namespace roboss_python
