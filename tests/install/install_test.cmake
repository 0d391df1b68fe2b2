# Installs into an empty folder, moves that folder (an installed RoBOSS must not know where it was made), builds the
# program against it, and runs it.
cmake_policy(SET CMP0057 NEW)  # IN_LIST
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR}/first ${WORK_DIR}/moved ${WORK_DIR}/build)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/first)
file(RENAME ${WORK_DIR}/first ${WORK_DIR}/moved)
file(GLOB_RECURSE headers RELATIVE ${WORK_DIR}/moved/include/roboss ${WORK_DIR}/moved/include/roboss/*.h)
foreach(wanted simulation/simulation.h client/control_program.h wire/control.h world/world.h)
  if(NOT wanted IN_LIST headers)
    message(FATAL_ERROR "the public header ${wanted} is not installed")
  endif()
endforeach()
foreach(internal physics/solver/newton.h gateway/exchange.h gateway/http_session.h sensors/test_model.h sdf/test_files.h)
  if(internal IN_LIST headers)
    message(FATAL_ERROR "the internal header ${internal} is installed")
  endif()
endforeach()
# The control programs that come with it share one copy of RoBOSS: with one each, the package was twice as large.
file(GLOB programs ${WORK_DIR}/moved/lib*/roboss/roboss_*.so)
foreach(program ${programs})
  get_filename_component(folder ${program} DIRECTORY)
  file(SIZE ${program} bytes)
  file(SIZE ${folder}/libroboss_client.so shared_bytes)
  math(EXPR most "${shared_bytes} / 4")
  if(bytes GREATER most)
    message(FATAL_ERROR "${program} has ${bytes} bytes: it carries a copy of RoBOSS beside libroboss_client.so (${shared_bytes})")
  endif()
endforeach()
set(flags "")
if(SANITIZE)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${PROGRAM_DIR} -B ${WORK_DIR}/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
  -DCMAKE_PREFIX_PATH=${WORK_DIR}/moved ${flags})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/outside ${PROGRAM_DIR}/ball.sdf)

# A control program that comes with it finds that library where the folder is now.
if(EXISTS ${WORK_DIR}/moved/bin/roboss AND programs)
  run(${WORK_DIR}/moved/bin/roboss run example:city --headless --speed max --duration 0.2 --quiet)
endif()

# The project that `roboss new-client` of the installed program writes builds against it and runs.
if(EXISTS ${WORK_DIR}/moved/bin/roboss)
  file(REMOVE_RECURSE ${WORK_DIR}/new)
  run(${WORK_DIR}/moved/bin/roboss new-client my_driver --folder ${WORK_DIR}/new)
  run(${CMAKE_COMMAND} -S ${WORK_DIR}/new/my_driver -B ${WORK_DIR}/new/my_driver/build -G Ninja -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_PREFIX_PATH=${WORK_DIR}/moved ${flags})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/new/my_driver/build)
  run(${WORK_DIR}/moved/bin/roboss check ${WORK_DIR}/new/my_driver/world.sdf)
  run(${WORK_DIR}/moved/bin/roboss run ${WORK_DIR}/new/my_driver/world.sdf --client ${WORK_DIR}/new/my_driver/build/my_driver.so
    --duration 20 --headless --trace ${WORK_DIR}/new/trace.csv --trace-every 20 --strict)
  execute_process(COMMAND ${WORK_DIR}/moved/bin/roboss new-client my_driver --folder ${WORK_DIR}/new RESULT_VARIABLE status ERROR_QUIET)
  if(NOT status EQUAL 1)
    message(FATAL_ERROR "a folder that exists was not refused (${status})")
  endif()
endif()
