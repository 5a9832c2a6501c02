# What `cmake --install` puts where, and the two Debian packages made of it: one with the program, one with what users
# need to build engines of their own. ./broadside package makes these packages and the portable archive (cmake/package).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
# Only the program is installed, so installing does not wait until the tests are built.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

install(TARGETS broadside RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# This script puts the program and the libraries that it needs into one folder, for a machine without these libraries.
install(PROGRAMS gpu/bundle RENAME broadside-bundle DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# The gate of a repository with an engine, for any forge (.github/actions/gate/README.md).
install(PROGRAMS .github/actions/gate/gate RENAME broadside-gate DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(FILES .github/actions/gate/annotate.py DESTINATION ${CMAKE_INSTALL_DATADIR}/broadside COMPONENT program)
install(FILES .github/actions/gate/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME gate.md COMPONENT program)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)

# For users' own engines: find_package(broadside), then link to broadside::engine, which is a header only.
add_library(broadside_engine INTERFACE)
set_target_properties(broadside_engine PROPERTIES EXPORT_NAME engine)
target_include_directories(broadside_engine INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS broadside_engine EXPORT broadside COMPONENT development)
install(FILES core/plugin/broadside_engine.h core/plugin/broadside_engine_v2.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/broadside)
install(EXPORT broadside NAMESPACE broadside:: FILE broadside-config.cmake DESTINATION ${package_folder} COMPONENT development)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/broadside-config-version.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/broadside-config-version.cmake DESTINATION ${package_folder} COMPONENT development)
install(DIRECTORY core/plugin/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/broadside/examples COMPONENT development)
install(DIRECTORY core/plugin/clients/ DESTINATION ${CMAKE_INSTALL_DATADIR}/broadside/clients COMPONENT development)
set(development_docs ${CMAKE_INSTALL_DATADIR}/doc/broadside-dev)
install(FILES core/plugin/PROGRAMS.md DESTINATION ${development_docs} RENAME programs.md COMPONENT development)
install(FILES core/plugin/README.md DESTINATION ${development_docs} RENAME engines.md COMPONENT development)
install(FILES LICENSE DESTINATION ${development_docs} RENAME copyright COMPONENT development)

set(CPACK_PACKAGE_NAME broadside)
set(CPACK_PACKAGE_VENDOR "The Broadside authors")
set(CPACK_PACKAGE_CONTACT "The Broadside authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "runs collision engines side by side, proves what each got right, times what it proved")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME broadside)
# The Debian packages that the program depends on are read from the program itself.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Engines fetched from npm run under Node; broadside-gate calls git and python3.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "nodejs, npm, git, python3")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME broadside-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "broadside (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake")
include(CPack)
cpack_add_component(program DESCRIPTION "The program broadside.")
cpack_add_component(development
  DESCRIPTION "Headers, clients and examples for engines that are shared libraries or programs.")
