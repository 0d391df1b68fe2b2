# Not compiled as one with others: they have members of private types.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/ros2/trajectory_action.cpp ${CMAKE_SOURCE_DIR}/src/ros2/simulation_services.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
