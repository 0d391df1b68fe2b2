# Boost.Beast speaks HTTP and WebSocket, OpenSSL encrypts; of the headers only those named *_session.h know them, and they
# are not installed.
find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL 3 REQUIRED)
target_link_libraries(roboss_gateway PRIVATE Boost::headers OpenSSL::SSL OpenSSL::Crypto nlohmann_json::nlohmann_json
  PUBLIC Threads::Threads)
# Asio's fences are nothing that g++'s thread sanitizer knows; the io_context has one thread.
if(ROBOSS_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(roboss_gateway PRIVATE -Wno-tsan)
endif()
