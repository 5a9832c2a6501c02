# What `cmake --install` puts where, and the Debian package made of it (`cpack -G DEB` in the build folder).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS broadside RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# The program and the libraries that it needs, in one folder, for a machine without these libraries.
install(PROGRAMS gpu/bundle RENAME broadside-bundle DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

# For users' own engines: find_package(broadside), then link to broadside::engine, which is a header only.
add_library(broadside_engine INTERFACE)
set_target_properties(broadside_engine PROPERTIES EXPORT_NAME engine)
target_include_directories(broadside_engine INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS broadside_engine EXPORT broadside)
install(FILES core/plugin/broadside_engine.h core/plugin/broadside_engine_v2.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT program)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/broadside)
install(EXPORT broadside NAMESPACE broadside:: FILE broadside-config.cmake DESTINATION ${package_folder} COMPONENT program)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/broadside-config-version.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/broadside-config-version.cmake DESTINATION ${package_folder} COMPONENT program)

install(DIRECTORY core/plugin/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/broadside/examples COMPONENT program)
install(DIRECTORY core/plugin/clients/ DESTINATION ${CMAKE_INSTALL_DATADIR}/broadside/clients COMPONENT program)
install(FILES core/plugin/PROGRAMS.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME programs.md COMPONENT program)
install(FILES core/plugin/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME engines.md COMPONENT program)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

set(CPACK_PACKAGE_NAME broadside)
set(CPACK_PACKAGE_VENDOR "The Broadside authors")
set(CPACK_PACKAGE_CONTACT "The Broadside authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "runs collision engines side by side, proves what each got right, times what it proved")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The Debian packages that the program depends on are read from the program itself.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
