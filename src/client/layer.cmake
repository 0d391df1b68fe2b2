# Control programs are loaded with dlopen.
target_link_libraries(roboss_client PUBLIC ${CMAKE_DL_LIBS})
