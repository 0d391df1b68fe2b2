// Loads the library that carries messages of ROS 2.
#pragma once

#include <memory>

#include "ros2_types/transport.h"

namespace roboss::ros2 {

/// A Transport by Fast DDS. Its library, libroboss_fastdds.so, lies with this program: lib/roboss of an
/// installation, lib of a build. An Error, "no-transport", if it or a library that it needs is missing;
/// "no-domain" if the domain cannot be joined; "no-host" if a host has no address.
Result<std::unique_ptr<Transport>> open_transport(const TransportOptions& options);

}  // namespace roboss::ros2
