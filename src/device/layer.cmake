# Boost.Asio speaks to serial lines and sockets; only line.cpp knows it. JSON is the payload of the protocol `joints`.
find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)
target_link_libraries(roboss_device PRIVATE Boost::headers nlohmann_json::nlohmann_json PUBLIC Threads::Threads)
