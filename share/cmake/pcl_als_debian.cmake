# cpack -G DEB: libpcl-als0 (libraries), pcl-als-tools (tools, manual pages), libpcl-als-dev (headers,
# CMake package), pcl-als-doc (manual), python3-pcl-als (where Python was found). Dependencies on
# libraries are found by dpkg-shlibdeps (package dpkg-dev) and file; what only packages contain is
# added by pcl_als_debian_files.cmake.
set(maintainer "pcl_als authors <pcl-als@example.org>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(PCL_ALS_MAINTAINER "${maintainer}" CACHE STRING
  "Who answers for the Debian packages: name and address (default: DEBFULLNAME and DEBEMAIL)")
set(PCL_ALS_HOMEPAGE "https://pointclouds.org" CACHE STRING
  "Page that the Debian packages refer to (default: that of the library that they extend)")
set(CPACK_PACKAGE_HOMEPAGE_URL "${PCL_ALS_HOMEPAGE}")
set(CPACK_PACKAGE_NAME pcl-als)
set(CPACK_PACKAGE_VENDOR "the pcl_als authors")
set(CPACK_PACKAGE_CONTACT "${PCL_ALS_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # it would precede each package's own
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/share/cmake/pcl_als_debian_files.cmake)
set(CPACK_COMPONENTS_ALL libraries tools headers documentation)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0local1)
set(CPACK_DEBIAN_PACKAGE_SOURCE pcl-als)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(debian_libraries libpcl-als${PROJECT_VERSION_MAJOR})
set(debian_same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(debian_about "pcl_als calibrates airborne laser scanners from overlapping strips,
corrects and registers the strips, checks deliveries, and derives
corrected intensities and land cover.")

# als_debian_package(COMPONENT NAME SECTION SUMMARY DESCRIPTION [DEPENDS …]): what is installed as COMPONENT.
macro(als_debian_package component name section summary description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  string(REPLACE ";" ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${ARGN}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${debian_about}\n\n${description}")
endmacro()

als_debian_package(libraries ${debian_libraries} libs
  "airborne LiDAR calibration for the Point Cloud Library (libraries)"
  "This package contains the shared libraries.")
# Programs that use the libraries depend on this package; the loader learns of new libraries.
set(shlibs)
foreach(module IN LISTS PCL_ALS_EXPORTED_MODULES)
  string(APPEND shlibs
    "libpcl_als_${module} ${PROJECT_VERSION_MAJOR} ${debian_libraries} ${debian_same}\n")
endforeach()
file(WRITE ${CMAKE_BINARY_DIR}/debian/shlibs "${shlibs}")
file(WRITE ${CMAKE_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA
  ${CMAKE_BINARY_DIR}/debian/shlibs ${CMAKE_BINARY_DIR}/debian/triggers)
# Pictures need a font and the index of fonts.
als_debian_package(tools pcl-als-tools science
  "airborne LiDAR calibration and quality control (tools)"
  "This package contains the command line tools, each with a manual page."
  "${debian_libraries} ${debian_same}" fonts-dejavu-core fontconfig)
als_debian_package(headers libpcl-als-dev libdevel
  "airborne LiDAR calibration for the Point Cloud Library (headers)"
  "This package contains the headers and the CMake package for programs
that use the libraries."
  "${debian_libraries} ${debian_same}" libpcl-dev libeigen3-dev)
set(CPACK_DEBIAN_HEADERS_PACKAGE_SHLIBDEPS OFF)
als_debian_package(documentation pcl-als-doc doc
  "airborne LiDAR calibration and quality control (manual)"
  "This package contains the manual, the pages of the modules and examples.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
if(PCL_ALS_PYTHON_FOUND)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  als_debian_package(python python3-pcl-als python
    "airborne LiDAR calibration and quality control (Python 3)"
    "This package contains the Python package, with points as numpy arrays."
    "${debian_libraries} ${debian_same}"
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})"
    "python3 (<< ${Python_VERSION_MAJOR}.${next_minor})" python3-numpy)
endif()
include(CPack)
