// The options by which a run is shown to Foxglove and Lichtblick, of `roboss foxglove` and of `roboss run`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/result.h"
#include "foxglove/foxglove_transport.h"
#include "ros2/face.h"

namespace roboss {

struct FoxgloveServerOptions {
    ros2::FaceOptions face;
    std::string listen;  // [ADDRESS:]PORT; of a run empty: there is no server
    std::vector<std::string> origins;

    FoxgloveServerOptions() { face.name = "foxglove"; }
    bool wanted() const { return !listen.empty(); }
};

/// Where the server of `roboss foxglove` listens if nothing else is said.
inline constexpr const char* kFoxglovePort = "8765";

/// `prefix`: "--" or "--foxglove-"; without the option that says where it listens.
void add_foxglove_options(CLI::App& command, FoxgloveServerOptions& options, const std::string& prefix);
/// `roboss foxglove` with the same options.
std::vector<std::string> foxglove_arguments(const FoxgloveServerOptions& options);
/// For the transport. An Error: the address is none.
Result<foxglove::FoxgloveOptions> foxglove_options(const FoxgloveServerOptions& options, bool insecure);

}  // namespace roboss
