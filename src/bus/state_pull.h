// StatePull: fetches the exact states of some robots at one tick from their holders, and repeats requests
// until all have arrived. Simulators use it for hand-offs, Clients for observations, the Controller for
// checkpoints.
#pragma once

#include <optional>
#include <span>

#include "bus/bus.h"
#include "model/robot_state.h"

namespace roboss {

class StatePull {
  public:
    /// Starts to fetch `holders`' robots at `tick`; accept() receives each state. `unasked_ms`: holders send
    /// them without a request; one that has not done so by then (Bus::now_ms()) gets a request. `window`: see
    /// StateRequest.
    void begin(const Model& model, Tick tick, std::vector<Holding> holders,
               std::optional<std::int64_t> unasked_ms = {}, std::uint64_t window = 0);
    /// Starts to fetch every robot; redirect() names the holders.
    void begin_all(const Model& model, Tick tick);
    /// Sets the current holders; states received so far stay. If they changed, the next advance() sends
    /// requests at once.
    void redirect(std::vector<Holding> holders);
    void cancel();

    bool active() const { return active_; }
    bool complete() const { return active_ && missing_ == 0; }
    Tick tick() const { return tick_; }
    bool is_for(const StateReply& reply) const {
        return active_ && reply.states.tick == tick_ && reply.window == window_;
    }

    /// Sends requests for what is missing, at once and then every resend_ms.
    void advance(Bus& bus, const Address& self, std::int64_t resend_ms);

    /// Calls put(robot, RobotState&&) for every missing robot of the reply. Damaged states count as missing.
    template <class Put>
    void accept(const Model& model, const StateReply& reply, Put&& put) {
        if (!is_for(reply)) return;
        std::size_t offset = 0;
        for (std::size_t i = 0; i < reply.states.robots.size(); ++i) {
            if (std::optional<RobotState> state = take(model, reply.states, i, offset))
                put(reply.states.robots[i], std::move(*state));
            offset += reply.states.sizes[i];
        }
    }

  private:
    std::optional<RobotState> take(const Model& model, const StateBlock& block, std::size_t i,
                                   std::size_t offset);

    bool active_ = false;
    Tick tick_ = 0;
    std::uint64_t window_ = 0;
    std::vector<Holding> holders_;
    std::vector<bool> wanted_;  // by RobotId
    std::size_t missing_ = 0;
    bool ask_now_ = false;
    std::int64_t asked_ms_ = 0;
};

}  // namespace roboss
