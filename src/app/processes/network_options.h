// The network options of every process of a run, the same for all subcommands.
#pragma once

#include <CLI/CLI.hpp>
#include <array>

#include "dds/dds_options.h"

namespace roboss {

/// Each option can also come from the environment: ROBOSS_SIMULATION, ROBOSS_DOMAIN ...
void add_network_options(CLI::App& command, DdsOptions& options);

/// All of them but --simulation.
inline constexpr std::array kNetworkOptions{
    "--interface",   "--domain",           "--peer",          "--port",
    "--peer-range",  "--discovery-server", "--liveliness-ms", "--through-controller",
    "--no-multicast"};

/// How messages and errors name this network: "simulation 'default' (interface 127.0.0.1, domain 0)".
std::string describe(const DdsOptions& options);

}  // namespace roboss
