# `find_package(asperity COMPONENTS …)`: the exported targets and their closure.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY ASPERITY_MODULES)
set(ASPERITY_MODULE_LIST "${modules}")
install(EXPORT asperityTargets NAMESPACE asperity:: DESTINATION lib/cmake/asperity COMPONENT dev)
configure_package_config_file(cmake/asperityConfig.cmake.in
  "${CMAKE_BINARY_DIR}/asperityConfig.cmake" INSTALL_DESTINATION lib/cmake/asperity)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/asperityConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/asperityConfig.cmake" "${CMAKE_BINARY_DIR}/asperityConfigVersion.cmake"
        DESTINATION lib/cmake/asperity COMPONENT dev)
install(TARGETS asperity_app RUNTIME DESTINATION bin COMPONENT program)
include(AsperityPackage)
