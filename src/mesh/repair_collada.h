// COLLADA as some exporters write it and assimp refuses it, made into what assimp reads.
#pragma once

#include <string>

namespace roboss {

/// The text without comments, white space before the first number of an element, and references to pictures:
/// what is drawn over such a mesh is lost, its triangles are not.
std::string repaired_collada(const std::string& text);

/// The same file with the meshes of its skins and morphs as plain geometry, and without their weights and
/// without animations; empty: it has none of them. assimp 5.2 ends the program over weights that are not
/// there.
std::string collada_at_rest(const std::string& text);

}  // namespace roboss
