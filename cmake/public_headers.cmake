# The public headers: those of the API reference (INPUT of docs/Doxyfile), and what they include. All others are internal
# and not installed.

# Adds a header of src/ and all that it includes to the list `found` of the caller.
function(roboss_add_with_includes header found)
  set(list ${${found}})
  if(NOT header IN_LIST list)
    list(APPEND list ${header})
    file(STRINGS ${CMAKE_SOURCE_DIR}/src/${header} lines REGEX "^#include \"")
    foreach(line ${lines})
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
      roboss_add_with_includes(${included} list)
    endforeach()
  endif()
  set(${found} ${list} PARENT_SCOPE)
endfunction()

# The public headers, relative to src/.
function(roboss_public_headers result)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/Doxyfile)
  file(READ ${CMAKE_SOURCE_DIR}/docs/Doxyfile settings)
  string(REGEX MATCHALL "src/[a-z0-9_/]+\\.h" headers "${settings}")
  set(list "")
  foreach(header ${headers})
    string(REGEX REPLACE "^src/" "" header ${header})
    roboss_add_with_includes(${header} list)
  endforeach()
  set(${result} ${list} PARENT_SCOPE)
endfunction()
