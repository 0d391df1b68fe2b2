// Orders from a file, one JSON object per line (--orders).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "model/order.h"

namespace roboss {

/// Reads {"t": s, "robot": name, and one of "set_pose", "set_velocity", "wrench", "joint", "command",
/// "attach", "detach"} lines, and {"t": s, "publish": {"topic": ..., ...}}, which commands all who take that
/// topic; "robot" may be a pattern (find_robots()): one order for each, by RobotId. Empty lines and lines
/// that start with # are skipped. Every fault is a diagnostic with file and line: an error, or a warning if
/// the joint has no effort; that of several robots of a pattern is one. The orders that are right are
/// returned. The lower 32 bits of `sequence` are the line.
std::vector<Order> load_orders(const std::string& file, const Model& model, Diagnostics& diagnostics);

/// The same from text; `file` is only named in the diagnostics.
std::vector<Order> parse_orders(std::string_view content, const std::string& file, const Model& model,
                                Diagnostics& diagnostics);

/// The line from which parse_orders() makes this order (except its Client and number).
std::string order_line(const Order& order, const Model& model);

/// The tick at which something due at `time_s` happens: the nearest one.
Tick tick_at(double time_s, double dt_s);

}  // namespace roboss
