// Starts, polls and signals the processes of a run on their hosts. Every host gets one shell at a time, since
// an sshd refuses many simultaneous connections.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_file.h"
#include "net/tls.h"

namespace roboss {

/// A process that was started.
struct Started {
    std::string name, role, host, log;
    long pid = 0;
};

/// A key for each process, from the folder of the file's keys, where those that are missing are made. None if
/// the file says `insecure`.
Result<std::vector<Credentials>> keys_of(const ClusterFile& file);

/// The processes that run, and an error for each of the others.
struct StartOutcome {
    std::vector<Started> started;
    std::vector<Error> errors;
};
StartOutcome start_processes(const ClusterFile& file, const std::vector<Credentials>& keys);

/// Which processes run, and the error of each host that does not answer.
struct Presence {
    std::vector<std::optional<bool>> runs;  // in the order of `all`; nullopt: its host does not answer
    std::map<std::string, std::string> silent;
};
Presence ask_hosts(const ClusterFile& file, const std::vector<Started>& all);

/// Signals the processes that still run. Hosts that do not answer are skipped.
void send_signal(const ClusterFile& file, const std::vector<Started>& to, const char* name);

/// Runs a script on a host, in the folder of the file.
Result<std::string> run_on_host(const ClusterFile& file, const std::string& host, const std::string& script);

/// `roboss` with these arguments and the network options of `process`, quoted for a shell.
std::string command_line(const ClusterFile& file, const ClusterProcess& process,
                         const std::vector<std::string>& arguments);

}  // namespace roboss
