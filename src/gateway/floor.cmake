# Boost.Beast speaks HTTP and WebSocket; of the headers only those named *_session.h know it, and they are not installed.
find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)
target_link_libraries(roboss_gateway PRIVATE Boost::headers nlohmann_json::nlohmann_json PUBLIC Threads::Threads)
