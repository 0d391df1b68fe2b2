// What SDFormat 1.10 to 1.12 added. libsdformat 12 knows 1.9 at most: newer files go to it as 1.9 without the
// new parts, and each part that matters is either read by the importer itself or reported. Never a silent
// default.
#pragma once

#include <string>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

inline constexpr int kOldestVersion = 104;
inline constexpr int kNewestKnownToLibsdformat = 109;
inline constexpr int kNewestKnownHere = 112;

/// The version to tell libsdformat for a file of `version`, as text.
std::string libsdformat_version(int version);

bool known_to_libsdformat(const Element& element);
bool attribute_known_to_libsdformat(const Element& element, const std::string& attribute);

/// A warning for every element and attribute under `model` that is newer than 1.9 and not honoured.
void report_newer_elements(const Element& model, Diagnostics& diagnostics);

/// What is odd about the version of a file: missing, older than 1.4, newer than 1.12.
void check_version(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
