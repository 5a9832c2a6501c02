# Kernels compiled for each instruction set and chosen at run time; all give the same bits.
set(avx2_kernel ${CMAKE_CURRENT_SOURCE_DIR}/scene_octree/tree_join_avx2.cpp)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(${avx2_kernel} PROPERTIES COMPILE_OPTIONS "-mavx2;-mpopcnt")
  set_source_files_properties(
    ${CMAKE_CURRENT_SOURCE_DIR}/scene_octree/size_tree.cpp
    ${CMAKE_CURRENT_SOURCE_DIR}/scene_octree/curve_keys.cpp
    ${CMAKE_CURRENT_SOURCE_DIR}/octree_cpu/leaf_boxes.cpp
    PROPERTIES COMPILE_DEFINITIONS BROADSIDE_HAS_AVX2_KERNEL)
else()
  list(REMOVE_ITEM sources ${avx2_kernel})
endif()
