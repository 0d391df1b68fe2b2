# Boost.Beast speaks WebSocket; of the headers only those named *_session.h know it.
find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
target_link_libraries(roboss_foxglove PRIVATE Boost::headers nlohmann_json::nlohmann_json PUBLIC Threads::Threads)
# Asio's fences are nothing that g++'s thread sanitizer knows; the io_context has one thread.
if(ROBOSS_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(roboss_foxglove PRIVATE -Wno-tsan)
endif()
