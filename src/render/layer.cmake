# The tracer is built once for AVX2 and once for any processor (see src/physics/layer.cmake). g++ says that vectors of 32 bytes are
# passed otherwise without AVX; they are never passed between files.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/render/trace_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2")
endif()
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/render/trace_any.cpp PROPERTIES COMPILE_OPTIONS "-Wno-psabi")
