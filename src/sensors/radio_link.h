// The formulas of a radio link, with the same bits on every machine.
#pragma once

#include "core/types.h"
#include "sensor_kinds/radio.h"

namespace roboss {

/// Whether they hear each other, if near enough.
bool share_a_channel(const RadioSpec& a, const RadioSpec& b);

/// log10, of a positive normal number.
double radio_log10(double x);
/// Power in mW.
double radio_power(double dBm);
/// erfc, of x >= 0: to 1e-10 of its value.
double radio_erfc(double x);
/// The probability that all bytes of a message come through: (1 - erfc(sqrt(signal_to_noise)))^bytes, as in
/// RFComms of gz-sim.
double radio_success(double signal_to_noise, double bytes);
/// The first tick that does not begin before `time_s`.
Tick radio_arrival(double time_s, double dt_s);

}  // namespace roboss
