// SavedRun: all that is needed to continue exactly from a tick. It comes from a journal, or from a file of
// its own, which is a journal of one checkpoint. A file is written under a temporary name and then renamed,
// so there is always a complete one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "journal/log_entries.h"

namespace roboss {

/// A run at the beginning of `tick`: states, orders that have not taken effect yet, and the memory of its
/// control programs.
struct SavedRun {
    std::string world_file;  // as it was given; for messages
    /// Hash of the Model of this file, if robots were added to the run, or it was changed in another way; 0:
    /// the states are of that Model.
    std::uint64_t world_hash = 0;
    std::uint64_t seed = 0;           // of the run: for sensor noise and control programs
    Tick tick = 0;                    // at which the run continues
    std::vector<RobotState> states;   // by RobotId
    std::vector<LoggedOrder> orders;  // that take effect at `tick` or later
    ClientMemory memory;              // memory of each control program
    /// The run follows `orders` alone up to here, and Clients' replies that are in them are not requested
    /// again. Equal to `tick`: there are none.
    Tick logged_until = 0;
    /// The last observation that each Client has answered in them, by its name.
    std::map<std::string, Tick> answered;
    std::vector<std::string> clients;  // names by ClientId, as far as they are known
    std::vector<std::string> left;     // of these, those that left
};

/// Hash of the world in the file: what state_hash a run has at this tick.
std::uint64_t state_hash_of(const Model& model, Tick tick, const std::vector<RobotState>& states);
/// The same, of a saved run.
std::uint64_t state_hash_of(const Model& model, const SavedRun& run);

/// An Error, "not-a-saved-run", if there is a file that a saved run must not replace: anything but another
/// one. A journal is none, either.
Result<> may_save_to(const std::string& path);

/// Writes the run as a journal of one checkpoint. An Error if the file cannot be written, or as
/// may_save_to(); a file that was at `path` before then stays as it is.
Result<> save_run(const std::string& path, const Model& model, const SavedRun& run);

/// Loads the end of the file. Errors: no such file, not a journal, another format version,
/// another world or step, damaged or truncated.
Result<SavedRun> load_run(const std::string& path, const Model& model);

}  // namespace roboss
