#include "ros2_types/open_transport.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "core/installation.h"

namespace roboss::ros2 {
namespace {

constexpr const char* kLibrary = "libroboss_fastdds.so";

// An empty path: it is not there.
std::filesystem::path library_path() {
    std::error_code error;
    const std::filesystem::path prefix = installation_prefix();
    for (const char* folder : {"lib/roboss", "lib"})
        if (const auto path = prefix / folder / kLibrary; std::filesystem::is_regular_file(path, error))
            return path;
    return {};
}

Error missing(const std::string& why) {
    return {"the library of Fast DDS, which carries messages of ROS 2, cannot be loaded: " + why,
            "Debian 12: apt install libfastrtps2.9, Debian 13: apt install libfastdds3.1; a RoBOSS that was "
            "built without libfastrtps-dev must be built anew",
            "no-transport"};
}

}  // namespace

Result<std::unique_ptr<Transport>> open_transport(const TransportOptions& options) {
    const std::filesystem::path path = library_path();
    if (path.empty()) return missing(std::string(kLibrary) + " is not installed with this program");
    // It stays loaded: threads of Fast DDS may outlive what they serve.
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return missing(dlerror());
    const auto open = reinterpret_cast<OpenTransport>(dlsym(library, "roboss_ros2_transport"));
    if (open == nullptr) return missing(path.string() + " is of another version");
    Error problem;
    Transport* const made = open(kTransportAbi, options, problem);
    if (made == nullptr) return problem;
    return std::unique_ptr<Transport>(made);
}

}  // namespace roboss::ros2
