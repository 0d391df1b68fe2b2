// The TOML file of `roboss cluster`: the processes of a run and their hosts.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

/// One process of the run.
struct ClusterProcess {
    std::string role;                    // "controller", "simulator", "client"
    std::string name;                    // unique in the file: "controller", "node2-1" ...
    std::string host;                    // "local": this computer, without any other program in between
    std::vector<std::string> arguments;  // of `roboss`
    std::vector<std::string> network;    // network options, without the keys
};

struct ClusterFile {
    std::string path;
    std::string simulation;          // name of the run
    std::string program = "roboss";  // on the hosts
    std::string folder;              // working directory; empty: that of the login
    std::string controller;          // HOST or HOST:PORT, for the others
    std::string keys;                // folder on this computer with the authority and a key for each process
    bool insecure = false;           // no keys, no encryption
    std::vector<std::string>
        reach;  // command that starts a shell on "{host}", which reads a script from its input
    std::vector<ClusterProcess> processes;  // the Controller first
};

/// An Error names file, line and remedy.
Result<ClusterFile> load_cluster_file(const std::string& path);

}  // namespace roboss
