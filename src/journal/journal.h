// The checkpoint file of a run (SQLite): all that is needed to go on exactly. A file is written beside its
// name and then renamed, so there is always a whole one; a load believes nothing that it has not checked.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "model/order.h"
#include "model/robot_state.h"

namespace roboss {

struct SavedRun {
    std::string world_file;  // as it was given; for messages
    std::uint64_t seed = 0;
    Tick tick = 0;
    std::vector<RobotState> states;  // by RobotId
    std::vector<Order> orders;       // still to come, canonical order; they answer observations before `tick`
    std::map<std::string, std::string> memory;  // what each control program remembers, by Client name
};

/// Hash of the world in the file: what state_hash a run has at this tick.
std::uint64_t state_hash_of(const Model& model, const SavedRun& run);

Result<> save_run(const std::string& path, const Model& model, const SavedRun& run);

/// Refuses, saying why: no such file, not a checkpoint, another format version, another world or step,
/// damaged or truncated.
Result<SavedRun> load_run(const std::string& path, const Model& model);

}  // namespace roboss
