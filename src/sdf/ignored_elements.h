// Elements of SDFormat that say something about bodies or joints and that nothing here reads. Each is told,
// with what to write instead, so that no user waits for an effect that cannot come.
#pragma once

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// A finding for every such element under `model`, unless it says zero, which is no effect anyhow.
void report_ignored_elements(const Element& model, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
