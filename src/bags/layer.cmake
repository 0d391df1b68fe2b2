# Zstandard and LZ4 unpack the chunks of MCAP files; no other layer knows them. Not every release of Debian has CMake
# files for them, so they are linked by name.
find_path(ROBOSS_ZSTD_HEADERS zstd.h REQUIRED)
find_path(ROBOSS_LZ4_HEADERS lz4frame.h REQUIRED)
find_package(Boost REQUIRED)
target_link_libraries(roboss_bags PRIVATE Boost::headers zstd lz4)
