# Engines of rigid bodies that are built when their libraries are installed; an engine without its library says what to
# install. The set-up installs ODE and MuJoCo. DART and Simbody are larger, and are used when the user has installed
# them.
pkg_check_modules(ode QUIET IMPORTED_TARGET ode)
find_package(mujoco QUIET)
# Searched by file: DART's own configuration searches for a dozen libraries that are not linked here, and Simbody's sets
# compiler flags.
find_path(BROADSIDE_DART_INCLUDE dart/dart.hpp)
find_library(BROADSIDE_DART_LIBRARY dart)
find_path(BROADSIDE_IKFAST_INCLUDE dart/external/ikfast/ikfast.h)
find_path(BROADSIDE_SIMBODY_INCLUDE Simbody.h PATH_SUFFIXES simbody)
find_library(BROADSIDE_SIMBODY_LIBRARY SimTKsimbody)
find_library(BROADSIDE_SIMBODY_MATH_LIBRARY SimTKmath)
find_library(BROADSIDE_SIMBODY_COMMON_LIBRARY SimTKcommon)
mark_as_advanced(BROADSIDE_DART_INCLUDE BROADSIDE_DART_LIBRARY BROADSIDE_IKFAST_INCLUDE BROADSIDE_SIMBODY_INCLUDE
  BROADSIDE_SIMBODY_LIBRARY BROADSIDE_SIMBODY_MATH_LIBRARY BROADSIDE_SIMBODY_COMMON_LIBRARY)

# broadside_world_engine(FOLDER NAME FOUND LIBRARY...)
# The sources of reference get BROADSIDE_HAS_NAME. Without the library only engine.cpp of reference/FOLDER is compiled.
# Only the library itself is linked: its definitions and include folders reach no other source.
function(broadside_world_engine folder name found)
  file(GLOB_RECURSE inside CONFIGURE_DEPENDS ${folder}/*.cpp)
  if(found)
    target_compile_definitions(broadside_reference PRIVATE BROADSIDE_HAS_${name}=1)
    foreach(library ${ARGN})
      target_link_libraries(broadside_reference PRIVATE $<LINK_ONLY:${library}>)
    endforeach()
  else()
    list(FILTER inside EXCLUDE REGEX "/engine[.]cpp$")
    set_source_files_properties(${inside} PROPERTIES HEADER_FILE_ONLY ON)
  endif()
endfunction()
