// SdfOracle: what libsdformat makes of a file, beside our own reader. Only tests link libsdformat, and only
// where the distribution has it.
#pragma once

#include <string>
#include <vector>

namespace roboss::corpus {

struct Verdict {
    std::string refusal;                   // libsdformat's first error; empty: it accepts the file
    std::vector<std::string> differences;  // between the two readings, of a file that libsdformat accepts
    std::size_t models = 0, links = 0, joints = 0;  // that were compared
};

/// Has libsdformat read a file with these resource folders, and compares links, joints, poses (1e-12),
/// inertias and sensors with what load_world() reads. Not compared, as they differ by intent: a robot of URDF
/// (here its fixed joints stay joints, and its massless links stay links); masses of models that stand still.
Verdict ask_libsdformat(const std::string& file, const std::vector<std::string>& folders);

}  // namespace roboss::corpus
