# Packages that the public headers need; shared by the build, where a missing one is fatal, and by
# the installed package config, where it makes pcl_als not found.
if(CMAKE_FIND_PACKAGE_NAME STREQUAL "pcl_als")
  include(CMakeFindDependencyMacro)
  macro(_pcl_als_need)
    find_dependency(${ARGN})
  endmacro()
else()
  macro(_pcl_als_need)
    find_package(${ARGN} REQUIRED)
  endmacro()
endif()

_pcl_als_need(Threads)
_pcl_als_need(Eigen3 3.3 NO_MODULE)
# PCL's package gives FLANN's place in a variable FLANN_ROOT, about which CMake 3.27 and newer warn.
set(_pcl_als_policy ${CMAKE_POLICY_DEFAULT_CMP0144})
set(CMAKE_POLICY_DEFAULT_CMP0144 NEW)
_pcl_als_need(PCL 1.12 COMPONENTS common io kdtree search filters features registration segmentation)
set(CMAKE_POLICY_DEFAULT_CMP0144 ${_pcl_als_policy})
unset(_pcl_als_policy)
