# Build options and third-party packages, in one place.
option(BUILD_SHARED_LIBS "Build shared libraries" ON)
option(PCL_ALS_BUILD_BENCHMARKS "Build tests/benchmarks (needs google-benchmark)" OFF)
option(PCL_ALS_BUILD_FUZZERS "Build tests/fuzz with libFuzzer (needs clang)" OFF)
option(PCL_ALS_WITH_PROJ "Read SBET trajectories and reproject with PROJ" ON)
option(PCL_ALS_WITH_VTK "Build module visualization: windows of pcl_als_view with VTK" ON)
option(PCL_ALS_WITH_GDAL "Write GeoTIFF and PNG with GDAL" ON)
option(PCL_ALS_WITH_CERES "Build the bundle adjustment and pcl_als_orient with Ceres Solver" ON)
option(PCL_ALS_WITH_MPI "Distribute jobs over processes with Boost.MPI" OFF)
option(PCL_ALS_UNITY_BUILD "Compile six sources of a module together: less time for a complete build" ON)
set(PCL_ALS_SANITIZE "" CACHE STRING "Sanitizers for every target, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)

find_program(PCL_ALS_CCACHE ccache)
if(PCL_ALS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache caches what uses precompiled headers only with this sloppiness. With paths relative to the
  # sources, build folders beside each other share their objects.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} ${PCL_ALS_CCACHE})
endif()

# The loader of glibc takes a library from the folder glibc-hwcaps/x86-64-v3 where the processor has
# AVX2 and FMA.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=x86-64-v3 PCL_ALS_HAS_X86_64_V3)
set(hwcaps OFF)
if(PCL_ALS_HAS_X86_64_V3 AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND BUILD_SHARED_LIBS
    AND NOT PCL_ALS_SANITIZE)
  set(hwcaps ON)
endif()
option(PCL_ALS_WITH_X86_64_V3
  "Build the kernels of linear algebra a second time, for processors with AVX2 and FMA" ${hwcaps})

add_compile_options(-Wall -Wextra)
if(UNIX AND NOT APPLE)
  add_link_options(LINKER:--as-needed)  # a tool loads at its start only what it uses
endif()
if(PCL_ALS_SANITIZE)
  add_compile_options(-fsanitize=${PCL_ALS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${PCL_ALS_SANITIZE})
endif()

include(${CMAKE_CURRENT_LIST_DIR}/pcl_als_packages.cmake)

# Since 1.14, PCL's targets make users of its filters compile with OpenMP. Libraries with and without it
# could share neither precompiled headers nor Eigen's inline functions, and Eigen would divide products
# among threads of its own. None needs it: jobs have their own threads.
if(TARGET OpenMP::OpenMP_CXX)
  set_target_properties(OpenMP::OpenMP_CXX PROPERTIES INTERFACE_COMPILE_OPTIONS "")
endif()
