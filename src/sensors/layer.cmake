# Embree finds which shapes a ray may meet; no other layer knows it.
find_package(embree 3 REQUIRED)
target_link_libraries(roboss_sensors PRIVATE embree)
