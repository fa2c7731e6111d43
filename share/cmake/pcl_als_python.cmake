# Python, where it is found with pybind11: PCL_ALS_PYTHON_FOUND, and als_add_python().
option(PCL_ALS_WITH_PYTHON "Build the Python package where Python and pybind11 are found" ON)
# Debian's, whose packages the libraries are built with; another one may be first in the path.
find_program(PCL_ALS_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH
  DOC "Python for which the package is built")
find_program(PCL_ALS_PYTHON NAMES python3)
set(PCL_ALS_PYTHON_FOUND FALSE)
if(PCL_ALS_WITH_PYTHON AND PCL_ALS_PYTHON)
  set(Python_EXECUTABLE ${PCL_ALS_PYTHON})
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    find_package(pybind11 2.9 CONFIG QUIET)
  endif()
  if(Python_FOUND AND pybind11_FOUND)
    set(PCL_ALS_PYTHON_FOUND TRUE)
  else()
    message(STATUS "No Python package: Python's headers or pybind11 (python3-dev, pybind11-dev) not found")
  endif()
endif()
# Below the prefix, as Debian's Python looks for packages in /usr/local and /usr.
set(PCL_ALS_PYTHON_DIR lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/dist-packages
  CACHE STRING "Folder of Python packages, relative to the installation prefix")

# als_add_python(SOURCES … FILES … MODULES … DEFINITIONS …): the package in the build folder's python/pcl_als, and
# its installation. FILES: the parts in Python. MODULES that this build lacks are left out.
function(als_add_python)
  cmake_parse_arguments(ARG "" "" "SOURCES;FILES;MODULES;DEFINITIONS" ${ARGN})
  _pcl_als_check_arguments(als_add_python "${ARG_UNPARSED_ARGUMENTS}")
  set(target pcl_als_python)
  set(folder ${CMAKE_BINARY_DIR}/python/pcl_als)
  pybind11_add_module(${target} MODULE NO_EXTRAS ${ARG_SOURCES})
  foreach(module IN LISTS ARG_MODULES)
    if(TARGET pcl_als_${module})
      target_link_libraries(${target} PRIVATE pcl_als::${module})
    endif()
  endforeach()
  target_compile_definitions(${target} PRIVATE PCL_ALS_VERSION="${PROJECT_VERSION}"
    ${ARG_DEFINITIONS})
  # GCC 12 warns of values inside pybind11's conversion of vectors.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_precompile_headers(${target} PRIVATE <pybind11/pybind11.h> <pybind11/stl.h>
    <pybind11/functional.h> <pybind11/numpy.h> <Eigen/Core> <Eigen/Geometry>)
  # The libraries are beside the package in a wheel, else in the library folder of the prefix.
  file(RELATIVE_PATH libraries /prefix/${PCL_ALS_PYTHON_DIR}/pcl_als /prefix/${CMAKE_INSTALL_LIBDIR})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME _pcl_als LIBRARY_OUTPUT_DIRECTORY ${folder}
    INSTALL_RPATH "$ORIGIN;$ORIGIN/${libraries}")
  foreach(file IN LISTS ARG_FILES)
    get_filename_component(name ${file} NAME)
    configure_file(${file} ${folder}/${name} COPYONLY)
    install(FILES ${file} DESTINATION ${PCL_ALS_PYTHON_DIR}/pcl_als COMPONENT python)
  endforeach()
  install(TARGETS ${target} LIBRARY DESTINATION ${PCL_ALS_PYTHON_DIR}/pcl_als COMPONENT python)
endfunction()
