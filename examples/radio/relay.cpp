// Relays: rover_0 of worlds/radio.sdf sends a beacon twice a second, the others pass each beacon on once,
// each in a time slot of its own, and rover_3 drives until it hears one. What rover_3 hears is printed, one
// line a message.
//   roboss run worlds/radio.sdf --client build/release/lib/roboss_relay.so --duration 12
#include <cstdio>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <roboss/client/control_program.h>

namespace relay {
namespace {

constexpr int kRovers = 4;
constexpr roboss::Tick kEvery = 250,  // ticks of 2 ms from beacon to beacon
    kSlot = 10;                       // ticks from the slot of a rover to that of the next one

std::string rover(int i) {
    return "rover_" + std::to_string(i);
}

/// A beacon that a rover will pass on.
struct Waiting {
    roboss::Tick due = 0;
    int rover = 0;
    std::string beacon;
};

}  // namespace

class Relay : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {0.02, -1, true}; }

    void control(roboss::Client& client) override {
        if (client.tick() % kEvery == 0)
            client.transmit(rover(0), "radio", "beacon_" + std::to_string(client.tick() / kEvery));
        for (int i = 1; i < kRovers; ++i)
            for (const roboss::RadioMessage& message : client.received(rover(i), "radio"))
                take(client, i, message);
        for (const Waiting& one : waiting_)
            if (one.due <= client.tick()) client.transmit(rover(one.rover), "radio", one.beacon);
        std::erase_if(waiting_, [&](const Waiting& one) { return one.due <= client.tick(); });
        client.command(rover(3), "cmd_vel", {found_ ? 0.0 : 1.0, 0, 0, 0, 0, 0});
    }

    std::string memory() const override {
        std::ostringstream text;
        text << found_ << ' ' << known_.size() << ' ';
        for (const std::string& beacon : known_) text << beacon << ' ';
        for (const Waiting& one : waiting_) text << one.due << ' ' << one.rover << ' ' << one.beacon << ' ';
        return text.str();
    }
    void restore(const std::string& memory) override {
        std::istringstream text(memory);
        std::size_t known = 0;
        std::string beacon;
        for (text >> found_ >> known; known > 0 && text >> beacon; --known) known_.insert(beacon);
        for (Waiting one; text >> one.due >> one.rover >> one.beacon;) waiting_.push_back(one);
    }

  private:
    void take(roboss::Client& client, int i, const roboss::RadioMessage& message) {
        const std::string beacon(message.payload.begin(), message.payload.end());
        if (i < kRovers - 1) {
            if (known_.insert(rover(i) + ":" + beacon).second)
                waiting_.push_back({client.tick() + i * kSlot, i, beacon});
            return;
        }
        found_ = true;
        const double dt = client.model().dt_s;
        std::printf("%.3f s: rover_3 hears %s from %s, %.1f dBm, sent %.0f ms before\n",
                    static_cast<double>(message.arrived) * dt, beacon.c_str(),
                    client.model().robots[message.from.index()].name.c_str(), message.strength_dBm,
                    1e3 * static_cast<double>(message.arrived - message.sent) * dt);
    }

    std::set<std::string> known_;  // "ROVER:BEACON": it has heard it
    std::vector<Waiting> waiting_;
    bool found_ = false;  // rover_3 has heard something
};

}  // namespace relay

ROBOSS_CONTROL_PROGRAM(relay::Relay)
