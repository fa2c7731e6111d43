# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# The port builds the sources that it is a part of. A port in the registry of vcpkg has a call of
# vcpkg_from_github() with REF and SHA512 of a release in this place.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
  FEATURES
    ceres PCL_ALS_WITH_CERES
    gdal PCL_ALS_WITH_GDAL
    proj PCL_ALS_WITH_PROJ
    vtk PCL_ALS_WITH_VTK)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${FEATURE_OPTIONS}
    -DBUILD_TESTING=OFF
    -DPCL_ALS_WITH_MPI=OFF
    -DPCL_ALS_WITH_PYTHON=OFF
    -DPCL_ALS_WITH_X86_64_V3=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME pcl_als CONFIG_PATH lib/cmake/pcl_als)

set(tools accuracy apply calibrate check classify convert history icpatch info intensity lines mounting
  plan plot profile simulate trajectory view)
if("ceres" IN_LIST FEATURES)
  list(APPEND tools orient)
endif()
list(TRANSFORM tools PREPEND pcl_als_)
vcpkg_copy_tools(TOOL_NAMES ${tools} AUTO_CLEAN)

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
