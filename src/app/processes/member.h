// What a Simulator process and a Client process have in common: an address of its own on the network, the
// Model from the Controller, and a time limit (--patience) for finding a Controller.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "bus/model_pull.h"
#include "net/stream_bus.h"
#include "render/visuals_of.h"

namespace roboss {

struct MemberOptions {
    NetOptions network;
    double patience_s = 0;  // without a Controller; 0: any time until there was one, then a minute
    bool stay = false;      // until the next run when one ends
    bool quiet = false;
    bool named = false;      // --simulation was given
    bool networked = false;  // a network option that leads to another computer was given
};
void add_member_options(CLI::App& command, MemberOptions& options);
/// Sets `named` and `networked`, once the command line has been read.
void note_given(const CLI::App& command, MemberOptions& options);

class Member {
  public:
    /// `what`: "simulator" or "client", for messages.
    Member(const char* what, const MemberOptions& options) : what_(what), o_(options) {}

    /// False: an option is wrong; it has been reported.
    bool open();
    StreamBus& bus() { return *bus_; }
    /// A new address, never used before.
    Address new_address(Role role) const;
    /// Waits for the Model; null if it cannot be fetched (it has been reported) or on Ctrl-C.
    std::shared_ptr<const Model> fetch_model(const Address& self);
    /// Waits for messages between two turns of the role. False: the run is over, there is no Controller for
    /// too long, or it refuses this process; it has been reported.
    bool wait();
    /// Once wait() or fetch_model() has failed: 0 if that is since the run is over, or by Ctrl-C.
    int exit_code() const { return exit_code_; }
    /// Reports that the run is over. The answer is the exit code.
    int end(const RunOver& end);
    /// The world's visuals for cameras, fetched from the Controller when the first one is read.
    render::VisualsOf visuals();
    /// Says to the Controller, and here, why this process cannot go on.
    void leave_at_once(const Error& why);
    void report(const std::string& line) const;
    void report_error(const Error& error) const;

  private:
    void report_absence(double patience_s);
    const char* what_;
    const MemberOptions& o_;
    std::unique_ptr<StreamBus> bus_;
    std::int64_t seen_ms_ = 0;  // when a Controller was there last
    bool was_there_ = false, waiting_reported_ = false;
    int exit_code_ = 0;
};

}  // namespace roboss
