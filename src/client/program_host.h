// ProgramHost: runs a control program as a Client. It catches the program's exceptions and sends them as the
// Client's last reply.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/bus_client.h"
#include "client/control_program.h"

namespace roboss {

class ProgramHost {
  public:
    ProgramHost(const std::shared_ptr<const Model>& model, const Address& self, std::string name,
                std::unique_ptr<ControlProgram> program);

    /// Restores the program's memory of a saved run; before the first advance().
    void restore(std::string memory) { restored_ = std::move(memory); }
    /// Calls the program's control() for each observation. Never waits.
    void advance(Bus& bus);

    const std::string& name() const { return name_; }
    const BusClient& client() const { return client_; }
    BusClient& client() { return client_; }
    const std::string& failure() const { return failure_; }
    /// What the program and its sensors remembered when it had answered every observation before `tick`, and
    /// none since.
    std::string memory_at(Tick tick) const;
    /// memory_at(), once every observation before `tick` is answered; nothing before. To be asked between any
    /// two advance()s until it answers, while the world waits for this Client.
    std::optional<std::string> settled_memory(Tick tick) const;
    /// Returns the program, for another world.
    std::unique_ptr<ControlProgram> take_program() { return std::move(program_); }

  private:
    bool restore_all(Bus& bus);
    template <class Call>
    bool guarded(Bus& bus, const char* what, Call&& call);

    std::string name_;
    std::unique_ptr<ControlProgram> program_;
    BusClient client_;
    std::optional<std::string> restored_;
    bool started_ = false;
    std::string failure_;
    Tick controlled_ = -1;       // tick of the last control()
    std::string memory_before_;  // as that call found it
};

/// memory_at() without what sensors held: after robots were removed they measure afresh.
std::string without_samples(const std::string& memory);

/// The times of a control program in ticks of this world. Errors, with `name` in the message: options()
/// throws, or a time that cannot be.
Result<BusClientOptions> client_options(const ControlProgram& program, const Model& model,
                                        const std::string& name);

}  // namespace roboss
