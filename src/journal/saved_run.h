// SavedRun: all that is needed to go on exactly from a tick. It comes from a journal, or from a file of its
// own, which is a journal of one checkpoint. A file is written beside its name and then renamed, so there is
// always a whole one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "journal/log_entries.h"

namespace roboss {

struct SavedRun {
    std::string world_file;  // as it was given; for messages
    std::uint64_t seed = 0;
    Tick tick = 0;
    std::vector<RobotState> states;   // by RobotId
    std::vector<LoggedOrder> orders;  // that take effect at `tick` or later
    ClientMemory memory;              // what each control program remembers
    /// The run goes by `orders` alone up to here, and Clients' words that are in them already are not asked
    /// again. Equal to `tick`: nothing of the kind.
    Tick logged_until = 0;
    /// The last observation that each Client has answered in them, by its name.
    std::map<std::string, Tick> answered;
    std::vector<std::string> clients;  // names by ClientId, as far as they are known
    std::vector<std::string> left;     // of these, who took leave
};

/// Hash of the world in the file: what state_hash a run has at this tick.
std::uint64_t state_hash_of(const Model& model, Tick tick, const std::vector<RobotState>& states);
std::uint64_t state_hash_of(const Model& model, const SavedRun& run);

Result<> save_run(const std::string& path, const Model& model, const SavedRun& run);

/// The end of what the file has. Refuses, saying why: no such file, not a journal, another format version,
/// another world or step, damaged or truncated.
Result<SavedRun> load_run(const std::string& path, const Model& model);

}  // namespace roboss
