// A folder NAME.net: `address` with the process that listens, and the keys.
#include "net/meeting_place.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "net/key_folder.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

struct Read {
    pid_t pid = 0;
    MeetingPlace::Note note;
};

/// Process, address, and whether it is insecure.
std::optional<Read> read_address(const fs::path& folder) {
    const Result<std::string> text = read_text(folder / "address");
    if (!text) return std::nullopt;
    std::istringstream words(text.value());
    Read read;
    if (words >> read.pid >> read.note.address >> read.note.insecure) return read;
    return std::nullopt;
}

/// The note, if the process that left it lives.
std::optional<MeetingPlace::Note> read_note(const fs::path& folder) {
    const std::optional<Read> read = read_address(folder);
    return read && is_alive(read->pid) ? std::optional(read->note) : std::nullopt;
}

/// Controllers that were killed have left theirs behind.
void remove_dead(const fs::path& runs) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(runs, error)) {
        if (entry.path().extension() != ".net") continue;
        const std::optional<Read> read = read_address(entry.path());
        if (read && !is_alive(read->pid)) fs::remove_all(entry.path(), error);
    }
}

}  // namespace

bool is_alive(pid_t pid) {
    return pid > 0 && (::kill(pid, 0) == 0 || errno == EPERM);
}

Result<fs::path> run_folder() {
    std::error_code error;
    const char* runtime = std::getenv("XDG_RUNTIME_DIR");
    const bool has_runtime = runtime != nullptr && fs::is_directory(runtime, error);
    const fs::path folder = has_runtime
                                ? fs::path(runtime) / "roboss"
                                : fs::temp_directory_path(error) / ("roboss-" + std::to_string(getuid()));
    ::mkdir(folder.c_str(), 0700);
    struct stat found {};
    if (::lstat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != getuid() ||
        (found.st_mode & 0077) != 0)
        return Error{folder.string() +
                         " cannot be used to list the runs of this computer: it is no folder "
                         "that only you can open",
                     "remove it, or set XDG_RUNTIME_DIR to a folder of yours", "no-run-folder"};
    return folder;
}

bool is_file_name(const std::string& text, std::size_t most) {
    return !text.empty() && text.size() <= most && text.front() != '.' &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
           });
}

Result<> check_simulation_name(const std::string& name) {
    if (is_file_name(name, 100)) return Ok{};
    return Error{"'" + name + "' is not the name of a simulation",
                 "use at most 100 letters, digits, - _ and dots, and no dot at the start", "bad-name"};
}

Error MeetingPlace::taken(const std::string& simulation) {
    return {"a Controller of simulation '" + simulation + "' is already running on this computer",
            "end it, or give this run another name with --simulation", "controller-exists"};
}

Result<MeetingPlace> MeetingPlace::open(const std::string& simulation, const Note& note) {
    const Result<fs::path> runs = run_folder();
    if (!runs) return runs.error();
    const fs::path folder = runs.value() / (simulation + ".net");
    if (read_note(folder)) return taken(simulation);
    std::error_code error;
    fs::remove_all(folder, error);
    remove_dead(runs.value());
    MeetingPlace place(folder);
    if (::mkdir(folder.c_str(), 0700) != 0)
        return Error{folder.string() + " cannot be made", "see the rights of its folder", "not-writable"};
    if (note.keys)
        if (Result<> written = write_keys(folder / "keys", *note.keys); !written) return written.error();
    std::ostringstream text;  // the last: members that see it find the keys
    text << getpid() << ' ' << note.address << ' ' << note.insecure << '\n';
    if (Result<> written = write_private(folder / "address", text.str()); !written) return written.error();
    return place;
}

std::optional<MeetingPlace::Note> MeetingPlace::find(const std::string& simulation) {
    const Result<fs::path> runs = run_folder();
    if (!runs) return std::nullopt;
    const fs::path folder = runs.value() / (simulation + ".net");
    std::optional<Note> note = read_note(folder);
    if (!note) return std::nullopt;
    if (Result<Credentials> keys = read_keys(folder / "keys")) note->keys = std::move(keys).value();
    return note;
}

MeetingPlace::MeetingPlace(MeetingPlace&& other) noexcept : folder_(std::exchange(other.folder_, {})) {}

MeetingPlace::~MeetingPlace() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace roboss
