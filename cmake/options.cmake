# Everything that is chosen at configure time, and the flags that our own targets share.

option(BROADSIDE_TESTS "Build the tests" ON)
set(BROADSIDE_CUDA ON CACHE STRING "ON: build the CUDA pipeline when nvcc is there; REQUIRED: fail without nvcc; OFF: never")
option(BROADSIDE_CGAL "Build what needs CGAL: mesh decimation for 'broadside fetch', engine cgal-boxes" ON)
set(BROADSIDE_REPORT_HTML ON CACHE STRING
  "ON: the report's HTML page, with charts and the 3-D view where npm is there; REQUIRED: fail without npm; OFF: no page")
option(BROADSIDE_BENCHMARKS "Build the Google Benchmark suites" OFF)
option(BROADSIDE_MPI "Build broadside_mpi_pairs: pairs of boxes that are spread over processes" OFF)
option(BROADSIDE_WARNINGS_AS_ERRORS "Treat warnings in our own targets as errors" ON)
set(BROADSIDE_SANITIZE "" CACHE STRING "Sanitizers for our own targets, e.g. address,undefined or thread")

option(BROADSIDE_FUZZ "Build the fuzzers of tests/fuzz, which need clang's libFuzzer" OFF)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(BROADSIDE_CCACHE ccache)
if(BROADSIDE_CCACHE)
  foreach(language CXX CUDA)
    if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER ${BROADSIDE_CCACHE} CACHE STRING "Compiler cache" FORCE)
    endif()
  endforeach()
endif()

# Same stamp, same bits: no contraction into fused multiply-add, on the host or on the device.
add_library(broadside_flags INTERFACE)
# -Wno-restrict: g++ 12 sees an overlap in std::string's operator+ that is not there (GCC bug 105651).
# -Wno-missing-field-initializers: a designated initializer names what differs and leaves the rest at their defaults.
target_compile_options(broadside_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off -fno-fast-math -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-restrict
  -Wno-missing-field-initializers>
  $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${BROADSIDE_WARNINGS_AS_ERRORS}>>:-Werror>
  $<$<COMPILE_LANGUAGE:CUDA>:--fmad=false -prec-div=true -prec-sqrt=true -ftz=false --expt-relaxed-constexpr -Xcompiler=-ffp-contract=off>)
target_include_directories(broadside_flags INTERFACE ${PROJECT_SOURCE_DIR})
if(BROADSIDE_SANITIZE)
  target_compile_options(broadside_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${BROADSIDE_SANITIZE} -fno-omit-frame-pointer>)
  target_link_options(broadside_flags INTERFACE -fsanitize=${BROADSIDE_SANITIZE})
endif()
if(BROADSIDE_FUZZ)
  target_compile_options(broadside_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=fuzzer-no-link>)
endif()
