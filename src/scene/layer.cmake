# nlohmann-json writes the scene; it shows in no header.
find_package(nlohmann_json REQUIRED)
target_link_libraries(roboss_scene PRIVATE nlohmann_json::nlohmann_json)
