// COLLADA as exporters write it, made into what assimp 5.2 reads: changes to the elements of a file.
#pragma once

#include "xml/source_file.h"

namespace roboss {

/// The meshes of skins and morphs become plain geometry, animations and pictures inside the file go (assimp
/// ends the program over weights that are not there, and reads such pictures beyond their end), and a text
/// that comments split becomes one, as assimp takes the first part only.
void put_collada_at_rest(pugi::xml_node collada);

/// Takes out all that refers to pictures: what is drawn over such a mesh is lost, its triangles are not.
void drop_collada_pictures(pugi::xml_node collada);

}  // namespace roboss
