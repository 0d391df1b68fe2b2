// Orders from a bag of ROS 2 (--orders): its messages on topics that drive robots of the world.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "model/order.h"

namespace roboss {

/// The orders that the commands of a bag stand for.
struct BagOrders {
    std::vector<Order> orders;  ///< in the order of log times; `sequence` counts them from 1
    std::string summary;        ///< "12 commands on 2 topics; 3 topics of the bag drive no robot ..."
};

/// Reads a bag (bags::is_bag()). Velocities may be Twist and TwistStamped. An order is due at the tick that
/// is nearest to the simulated time of its message (bags::SimulatedTime), those from before the start at the
/// start. What is wrong is a diagnostic with the file, the topic and the number of the message; a warning: no
/// topic drives a robot, a joint has no effort, a file is not finished.
BagOrders load_bag_orders(const std::string& path, const std::shared_ptr<const Model>& model,
                          Diagnostics& diagnostics);

}  // namespace roboss
