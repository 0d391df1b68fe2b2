// Processes of a run on their hosts: starting them, asking whether they run, signalling them. Every host has
// one shell at a time for all that is to be done there, since an sshd turns away who comes with many at once.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster_file.h"

namespace roboss {

/// A process that was started.
struct Started {
    std::string name, role, host, log;
    long pid = 0;
};

/// What came of starting: those that run, and what is to be said of the others.
struct StartOutcome {
    std::vector<Started> started;
    std::vector<Error> errors;
};
StartOutcome start_processes(const ClusterFile& file);

/// What the hosts say: of `all`, who runs; and of hosts that do not answer, why.
struct Presence {
    std::vector<std::optional<bool>> runs;  // as `all`; nothing: its host does not answer
    std::map<std::string, std::string> silent;
};
Presence ask_hosts(const ClusterFile& file, const std::vector<Started>& all);

/// To those that still run. Hosts that do not answer are passed over.
void send_signal(const ClusterFile& file, const std::vector<Started>& to, const char* name);

/// Runs a script on a host, in the folder of the file.
Result<std::string> run_on_host(const ClusterFile& file, const std::string& host, const std::string& script);

/// `roboss` with these arguments as this process would be started, as words of a shell.
std::string command_line(const ClusterFile& file, const ClusterProcess& process,
                         const std::vector<std::string>& arguments);

}  // namespace roboss
