# Queries side by side, compiled for each instruction set and chosen at run time; their results are the same bits.
set(impact_kernels ${CMAKE_CURRENT_SOURCE_DIR}/continuous/impact_kernel_avx2.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/continuous/impact_kernel_avx512.cpp)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(GET impact_kernels 0 avx2)
  list(GET impact_kernels 1 avx512)
  set_source_files_properties(${avx2} PROPERTIES COMPILE_OPTIONS "-mavx2")
  # GCC 12's own header deliberately reads an uninitialized variable where a result has no old value.
  set_source_files_properties(${avx512} PROPERTIES
    COMPILE_OPTIONS "-mavx512f;-mavx512dq;-Wno-uninitialized;-Wno-maybe-uninitialized")
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/continuous/impact_kernels.cpp ${impact_kernels}
    PROPERTIES COMPILE_DEFINITIONS BROADSIDE_HAS_IMPACT_LANES)
else()
  list(REMOVE_ITEM sources ${impact_kernels})
endif()
