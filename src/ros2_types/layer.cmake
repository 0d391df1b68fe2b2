# OpenSSL hashes the definitions of types.
find_package(OpenSSL 3 REQUIRED)
target_link_libraries(roboss_ros2_types PRIVATE OpenSSL::Crypto)
