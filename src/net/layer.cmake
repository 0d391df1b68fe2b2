# Boost.Asio waits for the sockets, OpenSSL encrypts what goes through them; no header that others include shows either.
find_package(Boost REQUIRED)
find_package(OpenSSL 3 REQUIRED)
target_link_libraries(roboss_net PRIVATE Boost::headers OpenSSL::SSL OpenSSL::Crypto PUBLIC Threads::Threads)
# Asio's fences are nothing that g++'s thread sanitizer knows; the io_context has one thread.
if(ROBOSS_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(roboss_net PRIVATE -Wno-tsan)
endif()
