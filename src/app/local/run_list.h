// The runs of this computer and user: each run lists itself in a private folder, with a socket at which
// `roboss control` reaches it. A run that has died is removed from the list by the next reader.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "net/meeting_place.h"

namespace roboss {

/// A run as it is listed.
struct ListedRun {
    std::string name;     ///< unique among the runs of this computer, unless two were started at once
    std::string command;  ///< "run", "controller" or "replay"
    std::string world;    ///< path of the world file or the journal, as it was given
    std::string viewer;   ///< URL of its page, with the token if it needs one; empty: headless
    std::string started;  ///< UTC, ISO 8601
    pid_t pid = 0;
    std::filesystem::path socket;
};

/// The living runs, by the time of their start.
Result<std::vector<ListedRun>> listed_runs();

/// The run of this name or process id; of an empty name: the only one. An Error lists what there is.
Result<ListedRun> find_run(const std::string& name);

/// Lists a run until it is destroyed.
class RunListing {
  public:
    /// The socket must listen already. If the name is taken, a number is added to it; if it must be `exact`,
    /// that is an Error [run-exists].
    static Result<RunListing> add(ListedRun run, bool exact = false);
    RunListing(RunListing&& other) noexcept;
    RunListing& operator=(RunListing&&) = delete;
    ~RunListing();
    const ListedRun& run() const { return run_; }

  private:
    explicit RunListing(ListedRun run, std::filesystem::path file)
        : run_(std::move(run)), file_(std::move(file)) {}
    ListedRun run_;
    std::filesystem::path file_;
};

}  // namespace roboss
