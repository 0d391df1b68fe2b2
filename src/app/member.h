// What a Simulator process and a Client process have in common: an address of their own on the network, the
// Model from the Controller, and an end to their patience when no Controller is there.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "bus/model_pull.h"
#include "dds/dds_bus.h"

namespace roboss {

struct MemberOptions {
    DdsOptions network;
    double patience_s = 0;  // without a Controller; 0: any time
    bool quiet = false;
};
void add_member_options(CLI::App& command, MemberOptions& options);

class Member {
  public:
    /// `what`: "simulator" or "client", for messages.
    Member(const char* what, const MemberOptions& options) : what_(what), o_(options) {}

    /// False: an option is wrong, and it has been said.
    bool open();
    DdsBus& bus() { return *bus_; }
    /// A new address, never used before.
    Address new_address(Role role) const;
    /// Waits for the Model; nothing if it cannot be had (it has been said why) or someone interrupted.
    std::shared_ptr<const Model> fetch_model(const Address& self);
    /// Between two turns of the role: waits for messages. False: there was no Controller for too long.
    bool wait();
    void say(const std::string& line) const;
    void complain(const Error& error) const;

  private:
    /// Joins the network afresh when it has heard nothing of a Controller for long, less and less often.
    void mend_silence(std::int64_t now_ms);
    std::int64_t first_silence_ms() const;

    const char* what_;
    const MemberOptions& o_;
    std::unique_ptr<DdsBus> bus_;
    std::int64_t seen_ms_ = 0;  // when a Controller was there last
    std::int64_t connected_ms_ = 0, silence_ms_max_ = 0;
    bool told_waiting_ = false;
    std::string told_trouble_;
};

}  // namespace roboss
