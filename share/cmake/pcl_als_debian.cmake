# cpack -G DEB: libpcl-als0 (libraries), pcl-als-tools (tools, manual pages), libpcl-als-dev (headers,
# CMake package), pcl-als-doc (manual), python3-pcl-als (where Python was found). Dependencies on libraries are found by dpkg-shlibdeps (package dpkg-dev).
set(CPACK_PACKAGE_NAME pcl-als)
set(CPACK_PACKAGE_VENDOR "the pcl_als authors")
set(CPACK_PACKAGE_CONTACT "the pcl_als authors <maintainers@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL libraries tools headers documentation)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(debian_libraries libpcl-als${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME ${debian_libraries})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Libraries of pcl_als")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME pcl-als-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
# Pictures need a font, and an X server where there is no display.
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS
  "${debian_libraries} (= ${PROJECT_VERSION}), fonts-dejavu-core, xvfb")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "Command line tools of pcl_als")
set(CPACK_DEBIAN_HEADERS_PACKAGE_NAME libpcl-als-dev)
set(CPACK_DEBIAN_HEADERS_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_HEADERS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_HEADERS_PACKAGE_DEPENDS
  "${debian_libraries} (= ${PROJECT_VERSION}), libpcl-dev, libeigen3-dev")
set(CPACK_COMPONENT_HEADERS_DESCRIPTION "Headers and CMake package of pcl_als")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME pcl-als-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "Manual of pcl_als")

set(debian_entries "libraries:${debian_libraries}" tools:pcl-als-tools headers:libpcl-als-dev
  documentation:pcl-als-doc)
if(PCL_ALS_PYTHON_FOUND)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND debian_entries python:python3-pcl-als)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pcl-als)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${debian_libraries} (= ${PROJECT_VERSION}), \
python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python package of pcl_als")
endif()
foreach(entry IN LISTS debian_entries)
  string(REPLACE ":" ";" entry ${entry})
  list(GET entry 0 component)
  list(GET entry 1 package)
  install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package}
    COMPONENT ${component})
endforeach()
include(CPack)
