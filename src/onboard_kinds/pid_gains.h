// Gains and limits of a PID controller, as Gazebo's plugins give them.
#pragma once

#include "core/parameter.h"

namespace roboss {

/// command = offset - (p * error + integral + d * change of error per second), error = measured - wanted. The
/// unit of the command is that of the joint's effort: N m or N.
struct PidGains {
    double p = 0,           ///< per unit of error
        i = 0,              ///< per unit of error and second
        d = 0;              ///< per unit of error a second
    double i_max = -1,      ///< of the integral, which includes `i`; below i_min: no limits
        i_min = 0;          ///< of the integral
    double cmd_max = -1,    ///< of the command; below cmd_min: no limits
        cmd_min = 0;        ///< of the command
    double cmd_offset = 0;  ///< added to the command
    /// Compares all members.
    friend bool operator==(const PidGains&, const PidGains&) = default;

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"p_gain", "p_gain"}, s.p);
        visit({"i_gain", "i_gain"}, s.i);
        visit({"d_gain", "d_gain"}, s.d);
        visit({"i_max", "i_max", "", true}, s.i_max);
        visit({"i_min", "i_min", "", true}, s.i_min);
        visit({"cmd_max", "cmd_max", "", true}, s.cmd_max);
        visit({"cmd_min", "cmd_min", "", true}, s.cmd_min);
        visit({"cmd_offset", "cmd_offset"}, s.cmd_offset);
    }
};

}  // namespace roboss
