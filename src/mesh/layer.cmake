# assimp reads STL, OBJ and COLLADA, libpng the pictures of heightmaps. Neither shows in a header.
find_package(assimp REQUIRED)
find_package(PNG REQUIRED)
target_link_libraries(roboss_mesh PRIVATE assimp::assimp PNG::PNG)
