# assimp reads meshes, libpng and libjpeg-turbo pictures. None of them shows in a header.
find_package(assimp REQUIRED)
find_package(PNG REQUIRED)
find_package(libjpeg-turbo CONFIG REQUIRED)
target_link_libraries(roboss_mesh PRIVATE assimp::assimp PNG::PNG libjpeg-turbo::turbojpeg)
