# Headers that most sources include are compiled once for each kind of target instead of once for
# each source. This saves time only: every source includes what it uses, and a build with
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON gives the same programs.
set(PCL_ALS_PRECOMPILED_library
  <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional>
  <iomanip> <limits> <map> <memory> <mutex> <numeric> <optional> <random> <set> <sstream> <string>
  <thread> <unordered_map> <utility> <vector> <Eigen/Core> <Eigen/Geometry>)
set(PCL_ALS_PRECOMPILED_pcl ${PCL_ALS_PRECOMPILED_library}
  <pcl/point_cloud.h> <pcl/point_types.h> <pcl/filters/filter.h>)
set(PCL_ALS_PRECOMPILED_test ${PCL_ALS_PRECOMPILED_library} <gtest/gtest.h>)

# A precompiled header serves only targets with the options that it was made with, so programs are
# compiled as libraries are; the instrumented targets of a build with fuzzers differ among each other.
if(BUILD_SHARED_LIBS)
  add_compile_options(${CMAKE_CXX_COMPILE_OPTIONS_PIC})
endif()
if(PCL_ALS_BUILD_FUZZERS)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
# Garbage collection of the compiler costs an eighth of its time and saves memory that a machine with
# PCL has.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
# Most of the time of a test's compilation goes into assertions, whose speed does not matter.
set(PCL_ALS_TEST_OPTIONS $<$<AND:$<CXX_COMPILER_ID:GNU,Clang>,$<CONFIG:Release>>:-O1>)

# als_precompile(TARGET KIND): the target uses the precompiled headers of a kind.
#   library  the standard library and Eigen: modules and tools
#   pcl      these, with PCL's clouds, point types and filters: modules of PCL's classes
#   test     the standard library, Eigen and GoogleTest, with PCL_ALS_TEST_OPTIONS
function(als_precompile target kind)
  if(NOT TARGET pcl_als_precompiled_${kind})
    set(source ${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Only carries the precompiled headers.\n")
    add_library(pcl_als_precompiled_${kind} OBJECT ${source})
    target_link_libraries(pcl_als_precompiled_${kind} PRIVATE pcl_common Eigen3::Eigen
      Threads::Threads $<$<STREQUAL:${kind},test>:GTest::gtest>)
    target_compile_definitions(pcl_als_precompiled_${kind} PRIVATE PCL_NO_PRECOMPILE)
    target_compile_options(pcl_als_precompiled_${kind} PRIVATE
      $<$<STREQUAL:${kind},test>:${PCL_ALS_TEST_OPTIONS}>)
    target_precompile_headers(pcl_als_precompiled_${kind} PRIVATE ${PCL_ALS_PRECOMPILED_${kind}})
  endif()
  target_precompile_headers(${target} REUSE_FROM pcl_als_precompiled_${kind})
  cmake_language(EVAL CODE "cmake_language(DEFER CALL _pcl_als_skip_precompiled ${target})")
endfunction()

# GCC takes the optimisation options from the precompiled header and silently ignores those of a
# source, so a source with options of its own goes without.
function(_pcl_als_skip_precompiled target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    if(options)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()
