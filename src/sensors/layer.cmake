# Embree finds which shapes a ray may meet; no other layer knows it.
find_package(embree 3 REQUIRED)
target_link_libraries(roboss_sensors PRIVATE embree)
# Not compiled as one with others: its Impl has members of private types.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/sensors/ray_scene.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
