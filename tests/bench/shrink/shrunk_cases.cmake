# The cases that shrink writes are compiled as they are and must fail; with a sound engine in the wrong one's place they
# must not. Compiled only when these slow tests run.
set(shrunk ${CMAKE_CURRENT_BINARY_DIR}/shrunk)
file(MAKE_DIRECTORY ${shrunk})
set(shrunk_targets)
foreach(row "E1 stability" "E6 friction-energy")  # with springs, and without
  separate_arguments(row)
  list(GET row 0 form)
  list(GET row 1 validator)
  set(wrong "octree-cpu[variant=printed-${form}]")
  add_custom_command(OUTPUT ${shrunk}/${form}_test.cpp
    COMMAND broadside shrink errata:${form} --validator ${validator} --engine ${wrong} --out ${shrunk}/${form}
    DEPENDS broadside VERBATIM)
  add_custom_command(OUTPUT ${shrunk}/${form}_sound_test.cpp
    COMMAND ${CMAKE_COMMAND} -D FROM=${shrunk}/${form}_test.cpp -D TO=${shrunk}/${form}_sound_test.cpp
      -D TEXT=${wrong} -D BY=octree-cpu -P ${CMAKE_CURRENT_SOURCE_DIR}/bench/shrink/replace_text.cmake
    DEPENDS ${shrunk}/${form}_test.cpp VERBATIM)
  foreach(kind "" _sound)
    set(target shrunk_${form}${kind})
    add_executable(${target} EXCLUDE_FROM_ALL ${shrunk}/${form}${kind}_test.cpp)
    target_link_libraries(${target} PRIVATE broadside_flags GTest::gtest_main broadside_bench)
    list(APPEND shrunk_targets ${target})
    add_test(NAME bench.shrink.${target} COMMAND ${target})
    set_tests_properties(bench.shrink.${target} PROPERTIES LABELS slow FIXTURES_REQUIRED shrunk_cases)
  endforeach()
  # A crash does not count as a failing case.
  set_tests_properties(bench.shrink.shrunk_${form} PROPERTIES PASS_REGULAR_EXPRESSION "FAILED  . Shrunk[.]")
endforeach()
add_test(NAME bench.shrink.shrunk_cases_compile
  COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target ${shrunk_targets})
set_tests_properties(bench.shrink.shrunk_cases_compile PROPERTIES LABELS slow TIMEOUT 900 FIXTURES_SETUP shrunk_cases)
