// The file of `roboss cluster`: which processes of a run go where (TOML).
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

/// One process of the run, wherever it is to be.
struct ClusterProcess {
    std::string role;                    // "controller", "simulator", "client"
    std::string name;                    // unique in the file: "controller", "node2-1" ...
    std::string host;                    // "local": this computer, without any other program in between
    std::vector<std::string> arguments;  // of `roboss`
    std::vector<std::string> network;    // network options: what the file says for it, else for all
};

struct ClusterFile {
    std::string path;
    std::string simulation;          // name of the run
    std::string program = "roboss";  // on the hosts
    std::string folder;              // in which it is started there; empty: where the login leaves us
    std::vector<std::string> reach;  // how a shell on "{host}" is had; it reads a script from its input
    std::vector<ClusterProcess> processes;  // the Controller first
};

/// An Error names file, line and remedy.
Result<ClusterFile> load_cluster_file(const std::string& path);

}  // namespace roboss
