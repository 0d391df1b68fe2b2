// See foxglove_options.h.
#include "app/foxglove/foxglove_options.h"

#include "app/ros2/ros2_options.h"
#include "gateway/access.h"

namespace roboss {

void add_foxglove_options(CLI::App& command, FoxgloveServerOptions& o, const std::string& prefix) {
    command
        .add_option(prefix + "allow-origin", o.origins,
                    "web page that may connect, besides those of Foxglove and of this computer, e.g. "
                    "https://viewer.example.org (may be repeated)")
        ->type_name("ORIGIN");
    add_face_options(command, o.face, prefix);
}

std::vector<std::string> foxglove_arguments(const FoxgloveServerOptions& o) {
    std::vector<std::string> words{"roboss", "foxglove", "--listen", o.listen};
    for (const std::string& origin : o.origins) words.insert(words.end(), {"--allow-origin", origin});
    add_face_arguments(words, o.face);
    return words;
}

Result<foxglove::FoxgloveOptions> foxglove_options(const FoxgloveServerOptions& o, bool insecure) {
    const Result<ListenAddress> at = parse_listen_address(o.listen);
    if (!at) return at.error();
    foxglove::FoxgloveOptions options;
    options.address = at.value().address, options.port = at.value().port;
    options.insecure = insecure;
    options.origins = o.origins;
    return options;
}

}  // namespace roboss
