// What stands in an MJCF file and has no effect: told by name, with what follows from it.
#pragma once

#include "mjcf/document.h"

namespace roboss::mjcf {

/// A finding for every element and attribute that is not read: a note where it is about MuJoCo's solver or
/// its viewer, a warning where motion depends on it or its name is not known.
void report_unread(const Document& document, Diagnostics& diagnostics);

}  // namespace roboss::mjcf
