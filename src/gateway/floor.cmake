# Boost.Beast speaks HTTP and WebSocket; only .cpp files and headers named *_session.h or server parts know it.
find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)
target_link_libraries(roboss_gateway PRIVATE Boost::headers nlohmann_json::nlohmann_json PUBLIC Threads::Threads)
