# The thread pool.
find_package(Threads REQUIRED)
target_link_libraries(roboss_core PUBLIC Threads::Threads)
