# The shared libraries that tests load, into one folder.
set(plugin_folder ${CMAKE_CURRENT_BINARY_DIR}/plugins)
function(add_plugin name source)
  add_library(${name} MODULE ${source})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/core/plugin)
  target_compile_definitions(${name} PRIVATE ${ARGN})
  set_target_properties(${name} PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF LIBRARY_OUTPUT_DIRECTORY ${plugin_folder})
endfunction()
add_plugin(sweep ${PROJECT_SOURCE_DIR}/core/plugin/examples/sweep.c)
add_plugin(wrong_engine bench/plugins/wrong_engine.c)
add_plugin(empty_plugin bench/plugins/refused_engine.c EMPTY)
add_plugin(later_plugin bench/plugins/refused_engine.c LATER)
add_plugin(half_plugin bench/plugins/refused_engine.c HALF)
foreach(area bench_plugins reference)
  add_dependencies(tests_${area} sweep wrong_engine empty_plugin later_plugin half_plugin)
  target_compile_definitions(tests_${area} PRIVATE BROADSIDE_PLUGIN_DIR="${plugin_folder}")
endforeach()

# The examples, built as the project of a user who installed Broadside.
add_test(NAME bench.plugins.examples_build_against_an_installed_tree
  COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR} -D FOLDER=${CMAKE_CURRENT_BINARY_DIR}/installed
    -P ${CMAKE_CURRENT_SOURCE_DIR}/bench/plugins/installed_examples.cmake)
set_tests_properties(bench.plugins.examples_build_against_an_installed_tree PROPERTIES TIMEOUT 300)
