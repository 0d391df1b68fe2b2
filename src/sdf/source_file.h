// SDFormat files as the importer reads them: xml::SourceFile, with actors made models.
#pragma once

#include <memory>
#include <string>

#include "xml/source_file.h"

namespace roboss::sdf_import {

using xml::Element;
using xml::SourceFile;
using xml::trimmed;
using xml::words_of;

/// SDFormat versions as major * 100 + minor: 1.6 is 106, 1.12 is 112. 0: unknown.
int parse_version(const std::string& text);

inline constexpr int kOldestVersion = 104;
inline constexpr int kNewestVersion = 112;
inline constexpr int kAssumedVersion = 109;  // of a file that names none

/// The version that the root element names; kAssumedVersion if it names none.
int version_of(const SourceFile& file);

/// Reports a version that is missing, older than 1.4 or newer than 1.12.
void check_version(const SourceFile& file, Diagnostics& diagnostics);

/// Attribute of a <joint> of a URDF that has the name of a link: that name, which SDF gives to one of them
/// only.
inline constexpr const char* kJointName = "roboss:name";
std::string name_of_joint(pugi::xml_node joint);

/// Reads a file that a world includes; one that is malformed or missing gives an error and nullptr.
std::unique_ptr<SourceFile> read_source(const std::string& path, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
