# libsdformat knows SDFormat's versions and frame semantics; pugixml does the fast pass. Neither shows in a header of load_world.
find_package(pugixml REQUIRED)
find_package(sdformat12 REQUIRED)
target_link_libraries(roboss_sdf PRIVATE pugixml::pugixml sdformat12::sdformat12)
