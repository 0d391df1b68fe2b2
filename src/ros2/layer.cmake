# Not compiled as one with others: they have members of private types.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/ros2/trajectory_action.cpp ${CMAKE_SOURCE_DIR}/src/ros2/simulation_services.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# yaml-cpp reads the files of ros_gz_bridge and ros2_control (yaml_file.h). Its target has a namespace since 0.8 (Debian 13).
find_package(yaml-cpp REQUIRED)
if(TARGET yaml-cpp::yaml-cpp)
  target_link_libraries(roboss_ros2 PRIVATE yaml-cpp::yaml-cpp)
else()
  target_link_libraries(roboss_ros2 PRIVATE yaml-cpp)
endif()
