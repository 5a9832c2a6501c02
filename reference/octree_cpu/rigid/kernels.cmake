# Eight patches at a time, compiled for each instruction set and chosen at run time; the results are the same bits.
set(avx2_kernel ${CMAKE_CURRENT_SOURCE_DIR}/octree_cpu/rigid/patch_kernel_avx2.cpp)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(${avx2_kernel} PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
  set_source_files_properties(${avx2_kernel} ${CMAKE_CURRENT_SOURCE_DIR}/octree_cpu/rigid/patch_kernels.cpp
    PROPERTIES COMPILE_DEFINITIONS BROADSIDE_HAS_AVX2_KERNEL)
else()
  list(REMOVE_ITEM sources ${avx2_kernel})
endif()
