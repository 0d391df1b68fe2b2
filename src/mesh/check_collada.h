// What assimp 5.2 does not check in COLLADA, and what it then breaks on: reading beyond arrays, asserts that
// end the program, loops without end. Checked before assimp sees the file.
#pragma once

#include <memory>
#include <string>

#include "core/result.h"
#include "xml/source_file.h"

namespace roboss {

/// The elements of a file, at rest (collada_edit.h). An Error names the line; `path` is for its remedy.
Result<std::unique_ptr<xml::SourceFile>> checked_collada(const std::string& path, const std::string& text);

/// As text in UTF-8: what was checked, and no more.
std::string collada_text(const xml::SourceFile& file);

}  // namespace roboss
