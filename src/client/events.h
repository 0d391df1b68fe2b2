// Events: messages that something sent when it happened (a touch, a robot in a region), or that a user or a
// trigger published. They are kept on the message board of the world, in its state.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

/// A message on a message board.
struct RobotEvent {
    Tick tick = 0;                     ///< at which it was published
    RobotId robot;                     ///< that it is about; not valid: scenery, or nobody
    std::string model;                 ///< name of the model that it is about; empty: nobody
    std::string topic;                 ///< of Gazebo, e.g. "/trigger/touched"
    const Channel* message = nullptr;  ///< names, units and words of the values; part of the Model
    std::vector<double> values;        ///< in that order
};

/// The last message of each topic of the board, of those published in [from, to); by topic, in the board's
/// order.
std::vector<RobotEvent> events_on_board(const Model& model, RobotId board, const RobotState& state, Tick from,
                                        Tick to);

/// "/trigger/touched data=1": for logs.
std::string to_text(const RobotEvent& event);

}  // namespace roboss
