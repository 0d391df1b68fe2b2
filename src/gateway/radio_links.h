// RadioLinks: who hears whom, for pages that show it. What radios heard since the last look is what their
// Clients get (sensors/radio.cpp). Where many radios hear much, they take turns, so that a look costs the
// gateway no more than kBudget.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

#include "sensors/readings.h"

namespace roboss {

/// Messages that one radio heard of another since the last look.
struct RadioLink {
    RobotId from, to;  ///< robots
    std::uint32_t antenna = 0,
                  sensor = 0;    ///< their radios: of the sender, of the receiver (RobotType::sensors)
    std::uint32_t messages = 0;  ///< how many
    double strength_dBm = 0, margin_dB = 0;  ///< of the last one: at the receiver, and above its noise floor
    Tick arrived = 0;                        ///< of the last one
};

/// A radio that has begun transmissions since the last look.
struct RadioSender {
    RobotId robot;
    std::uint32_t sensor = 0;    ///< of RobotType::sensors
    std::uint64_t messages = 0;  ///< how many
};

/// See above; all calls with the same Model.
class RadioLinks {
  public:
    static constexpr std::chrono::milliseconds kBudget{10};

    struct Look {
        std::vector<RadioLink> links;
        std::vector<RadioSender> senders;
        bool is_complete = true;  ///< all radios had their turn
    };

    /// At `tick`, with the states of `sources`. The first look, and one after a rewind, begins with the
    /// messages of the last second.
    Look look(const Model& model, SensorSources& sources, Tick tick, std::uint64_t seed);

  private:
    struct Radio {
        RobotId robot;
        std::uint32_t sensor = 0, index = 0;  // of RobotType::sensors, of RobotState::radios
        Tick heard = -1;                      // the messages that arrived until then are reported
        std::uint64_t sent = 0;               // transmissions that are reported
    };
    void begin(const Model& model);
    void hear(const Model& model, Radio& radio, SensorSources& sources, Tick tick, std::uint64_t seed,
              Look& look);

    std::vector<Radio> radios_;
    std::size_t turn_ = 0;  // of radios_
    Tick tick_ = -1;
};

}  // namespace roboss
