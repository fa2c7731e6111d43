# The installed package: find_package(pcl_als [COMPONENTS io …]) gives pcl_als::common, pcl_als::io, …
include(CMakePackageConfigHelpers)
set(PCL_ALS_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_als)

# Everything a user runs, without the tests: ninja pcl_als_tools
get_property(PCL_ALS_TOOLS GLOBAL PROPERTY PCL_ALS_TOOLS)
add_custom_target(pcl_als_tools DEPENDS ${PCL_ALS_TOOLS})

# Headers that those of users include, found when the headers are installed.
get_property(folders GLOBAL PROPERTY PCL_ALS_HEADER_FOLDERS)
install(CODE "set(PCL_ALS_HEADER_FOLDERS \"${folders}\")
set(PCL_ALS_INTERNAL_INCLUDEDIR \"${PCL_ALS_INTERNAL_INCLUDEDIR}\")" COMPONENT headers)
install(SCRIPT share/cmake/pcl_als_internal_headers.cmake COMPONENT headers)

get_property(PCL_ALS_EXPORTED_MODULES GLOBAL PROPERTY PCL_ALS_EXPORTED_MODULES)
# The libraries alone: ninja pcl_als_libraries
add_custom_target(pcl_als_libraries)
foreach(module IN LISTS PCL_ALS_EXPORTED_MODULES)
  add_dependencies(pcl_als_libraries pcl_als_${module})
endforeach()
install(EXPORT pcl_als-targets NAMESPACE pcl_als:: DESTINATION ${PCL_ALS_CONFIG_DIR}
  COMPONENT headers)
configure_package_config_file(share/cmake/pcl_als-config.cmake.in
  ${CMAKE_BINARY_DIR}/pcl_als-config.cmake INSTALL_DESTINATION ${PCL_ALS_CONFIG_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/pcl_als-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_BINARY_DIR}/pcl_als-config.cmake
  ${CMAKE_BINARY_DIR}/pcl_als-config-version.cmake
  share/cmake/pcl_als_packages.cmake
  DESTINATION ${PCL_ALS_CONFIG_DIR} COMPONENT headers)
