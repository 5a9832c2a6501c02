# Shortens a build: small files of a target are compiled together, because they read the same headers and instantiate
# the same templates, which takes most of the time of each alone. When the option is off, as in preset dev, each file is
# compiled by itself: then a change of one file compiles that file alone, and a missing include is found.
option(BROADSIDE_SHORT_COMPILATION "Compile small files of a room together" ON)

# Headers that take seconds to read and that some files of a folder include: CLI11's and nlohmann's.
set(broadside_large_headers "^#include <(CLI/CLI|nlohmann/json)[.]hpp>")

# broadside_by_large_headers(OUT SOURCE...)
# Sorts the sources so that those that read the same large headers are next to each other, and fewer units read these
# headers.
function(broadside_by_large_headers out)
  foreach(source ${ARGN})
    set(read "")
    if(EXISTS ${source})
      file(STRINGS ${source} read REGEX "${broadside_large_headers}")
    endif()
    if(read MATCHES "CLI/CLI" AND read MATCHES "nlohmann")
      list(APPEND both ${source})
    elseif(read MATCHES "CLI/CLI")
      list(APPEND command_line ${source})
    elseif(read MATCHES "nlohmann")
      list(APPEND json ${source})
    else()
      list(APPEND neither ${source})
    endif()
  endforeach()
  set(${out} ${command_line} ${both} ${json} ${neither} PARENT_SCOPE)
endfunction()

# broadside_compile_together(TARGET SIZE SOURCE...)
# Compiles these sources in units of SIZE files, in the given order except for large headers. Therefore names in the
# unnamed namespaces of a target must be distinct. Reading headers takes half the time of a unit of twelve small files,
# so units are large: some 15 to 40 files, but no unit takes so long that the others wait for it. A source with flags of
# its own stays alone.
function(broadside_compile_together target size)
  if(NOT BROADSIDE_SHORT_COMPILATION)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  broadside_by_large_headers(sources ${ARGN})
  set(place 0)
  foreach(source ${sources})
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    get_source_file_property(is_left_out ${source} HEADER_FILE_ONLY)
    if(definitions OR options OR is_left_out)
      continue()
    endif()
    math(EXPR unit "${place} / ${size}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${unit})
    math(EXPR place "${place} + 1")
  endforeach()
endfunction()
