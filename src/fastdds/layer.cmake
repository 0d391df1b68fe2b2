# Fast DDS: the package fastrtps of Debian 12 (2.9), fastdds of Debian 13 (3.1). Without it there is no such library.
find_package(fastdds QUIET)
find_package(fastrtps QUIET)
foreach(library fastdds fastrtps)
  if(TARGET ${library} AND NOT module_libraries)
    set(module_libraries ${library})
  endif()
endforeach()
