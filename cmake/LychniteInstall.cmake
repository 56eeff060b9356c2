# What `cmake --install` gives beside the program and its shaders: headers, libraries, and what
# find_package(lychnite) reads.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lychnite)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/lychnite DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(EXPORT lychnite NAMESPACE lychnite:: FILE lychnite-targets.cmake DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lychnite-config.cmake.in
  ${PROJECT_BINARY_DIR}/lychnite-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lychnite-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lychnite-config.cmake ${PROJECT_BINARY_DIR}/lychnite-config-version.cmake
  DESTINATION ${package_dir})
