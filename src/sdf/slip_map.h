// <slip_map> of LookupWheelSlip: the picture behind it.
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Reads the picture into the map; what is wrong is reported, and the map stays empty.
void read_slip_map(const Element& plugin, const Import& import, LookupWheelSlipSpec& spec);

}  // namespace roboss::sdf_import
