# Fast DDS carries the messages between processes and machines; no other layer knows it, and no header of this one shows it.
find_package(fastcdr 1 REQUIRED)
find_package(fastrtps 2.9 REQUIRED)
target_link_libraries(roboss_dds PRIVATE fastrtps fastcdr)
