// A process that joins a run as a Client and shows it as nodes, by one Transport or another.
#pragma once

#include <functional>
#include <memory>

#include "app/processes/member.h"
#include "core/result.h"
#include "ros2/face.h"
#include "ros2_types/transport.h"

namespace roboss {

struct FaceProcessOptions {
    MemberOptions member;
    bool list = false;  // print the topics, and end
};

/// Opens the Transport; called once, and not for a list.
using TransportOpener = std::function<Result<std::unique_ptr<ros2::Transport>>()>;

/// Declares --list, --name, --path and the options of a member.
void add_face_process_options(CLI::App& command, FaceProcessOptions& options, ros2::FaceOptions& face);

/// Shows a run until it is over or Ctrl-C. `what`: "ros2", for messages. The answer is the exit code.
int show_run(const char* what, const FaceProcessOptions& options, const ros2::FaceOptions& face,
             const TransportOpener& open);

}  // namespace roboss
