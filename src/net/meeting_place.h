// How members of one computer and user find their Controller by the name of the run: it leaves its address,
// and keys for them, in a private folder.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "net/tls.h"

namespace roboss {

/// The private folder in which runs of this computer and user list themselves: $XDG_RUNTIME_DIR/roboss, else
/// roboss-UID in the folder for temporary files. Created if it is missing. An Error if others could write
/// there.
Result<std::filesystem::path> run_folder();

/// A Controller's note for members. Removed when it is destroyed.
class MeetingPlace {
  public:
    struct Note {
        std::string address;  ///< IPv4:PORT
        bool insecure = false;
        /// For all members that have none of their own; none: insecure, or every member has its own.
        std::optional<Credentials> keys{};
    };
    /// An Error [controller-exists]: a living Controller of this computer and user has this name.
    static Result<MeetingPlace> open(const std::string& simulation, const Note& note);
    static Error taken(const std::string& simulation);
    /// The note of a living Controller.
    static std::optional<Note> find(const std::string& simulation);

    MeetingPlace(MeetingPlace&& other) noexcept;
    MeetingPlace& operator=(MeetingPlace&&) = delete;
    ~MeetingPlace();

  private:
    explicit MeetingPlace(std::filesystem::path folder) : folder_(std::move(folder)) {}
    std::filesystem::path folder_;
};

/// Whether a process has this id.
bool is_alive(pid_t pid);

/// Whether a text of at most so many bytes is the name of a file anywhere: letters, digits, - _ and dots, no
/// dot at the start.
bool is_file_name(const std::string& text, std::size_t most);

/// Names of runs become names of files and parts of command lines: letters, digits, - _ and dots.
Result<> check_simulation_name(const std::string& name);

}  // namespace roboss
