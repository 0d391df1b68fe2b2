# cmake --install: the layers as roboss::NAME with their headers, the programs, and what find_package(roboss) reads.
# Included last, when every target exists.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/roboss)

# The external libraries that a static layer hands on to whoever links it: pattern of the linked name, and how to find it.
set(ROBOSS_EXTERNALS
  "^pugixml" "find_dependency(pugixml)"
  "^assimp" "find_dependency(assimp)"
  "^PNG::" "find_dependency(PNG)"
  "^libjpeg-turbo::" "find_dependency(libjpeg-turbo)"
  "^SQLite::SQLite3$" "find_dependency(SQLite3)"
  "^OpenSSL::" "find_dependency(OpenSSL 3)"
  "^Threads::Threads$" "find_dependency(Threads)"
  "^Boost::" "find_dependency(Boost)"
  "^fmt::" "find_dependency(fmt)"
  "^spdlog::" "find_dependency(spdlog)"
  "^yaml-cpp" "find_dependency(yaml-cpp)"
  "^nlohmann_json::" "find_dependency(nlohmann_json)"
  "^(dl|m|rt|atomic|zstd|lz4)$|^$" "")

# Sets `result` to the find_dependency line of one linked library; ends the configuration where none is known.
function(roboss_dependency_line layer library result)
  set(patterns ${ROBOSS_EXTERNALS})
  while(patterns)
    list(POP_FRONT patterns pattern line)
    if(library MATCHES "${pattern}")
      set(${result} "${line}" PARENT_SCOPE)
      return()
    endif()
  endwhile()
  message(FATAL_ERROR "layer ${layer} links ${library}, and cmake/install.cmake does not know how an installed RoBOSS finds it: "
    "add it to ROBOSS_EXTERNALS")
endfunction()

get_property(layers GLOBAL PROPERTY ROBOSS_LAYERS)
set(ROBOSS_FIND_DEPENDENCIES "")
foreach(layer ${layers})
  set(linked "")
  foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
    get_target_property(more roboss_${layer} ${property})
    if(more)
      list(APPEND linked ${more})
    endif()
  endforeach()
  list(FILTER linked EXCLUDE REGEX "^roboss_")
  list(FILTER linked EXCLUDE REGEX "BUILD_INTERFACE:")
  list(TRANSFORM linked REPLACE "^.<LINK_ONLY:(.*)>$" "\\1")
  list(TRANSFORM linked STRIP)
  foreach(library ${linked})
    roboss_dependency_line(${layer} "${library}" line)
    list(APPEND ROBOSS_FIND_DEPENDENCIES "${line}")
  endforeach()
  install(TARGETS roboss_${layer} EXPORT roboss ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
include(cmake/public_headers.cmake)
roboss_public_headers(public_headers)
foreach(header ${public_headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${CMAKE_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/roboss/${folder})
endforeach()
list(REMOVE_DUPLICATES ROBOSS_FIND_DEPENDENCIES)
list(JOIN ROBOSS_FIND_DEPENDENCIES "\n" ROBOSS_FIND_DEPENDENCIES)

install(EXPORT roboss NAMESPACE roboss:: FILE roboss-targets.cmake DESTINATION ${config_dir})
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/roboss-config.cmake.in ${CMAKE_BINARY_DIR}/roboss-config.cmake
  INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/roboss-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/roboss-config.cmake ${CMAKE_BINARY_DIR}/roboss-config-version.cmake DESTINATION ${config_dir})

# The programs, and the libraries that they load: the example control programs (`roboss run --client`), with what they
# share, and Fast DDS.
foreach(program roboss roboss-world)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/worlds/examples.json)
file(READ ${CMAKE_SOURCE_DIR}/worlds/examples.json example_list)
string(REGEX MATCHALL "roboss_[a-z_]+" example_programs "${example_list}")
foreach(library roboss_client_library ${example_programs} roboss_watch_robot roboss_fastdds)
  if(TARGET ${library})
    install(TARGETS ${library} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/roboss)
  endif()
endforeach()
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/roboss/web DESTINATION ${CMAKE_INSTALL_DATADIR}/roboss OPTIONAL)  # the viewer's page, if it is built
install(DIRECTORY ${CMAKE_SOURCE_DIR}/worlds DESTINATION ${CMAKE_INSTALL_DATADIR}/roboss OPTIONAL)
