# One call per module, tool and test. Unknown arguments are fatal, sources are listed by hand.
include(GNUInstallDirs)
include(${CMAKE_CURRENT_LIST_DIR}/pcl_als_precompiled.cmake)

function(_pcl_als_check_arguments caller unparsed)
  if(unparsed)
    message(FATAL_ERROR "${caller}: unknown arguments: ${unparsed}")
  endif()
endfunction()

# Headers of a module: include/ holds those that users include, internal/ those that other modules, the
# tools and the tests include besides. Of the latter only those are installed that the headers of users
# include in turn, in a folder of their own.
set(PCL_ALS_INTERNAL_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR}/pcl_als/internal)
function(_pcl_als_install_headers)
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT headers)
  endif()
  set_property(GLOBAL APPEND PROPERTY PCL_ALS_HEADER_FOLDERS ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()

# Six sources of a target are compiled together, those in a list on their own.
function(_pcl_als_unity_build target separate)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PCL_ALS_UNITY_BUILD}
    UNITY_BUILD_BATCH_SIZE 6)
  if(PCL_ALS_UNITY_BUILD)  # sources are then headers to the compiler, which expects other names there
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  set_source_files_properties(${separate} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# als_add_module(NAME io SOURCES src/a.cpp … [MODULES common …] [PUBLIC …] [PRIVATE …] [DEFINITIONS …]
#   [SEPARATE src/a.cpp …])
#   MODULES  modules this one may include (checked by tests/architecture)
#   PUBLIC   third-party targets seen in headers; PRIVATE: used in sources only
#   SEPARATE  of the sources those that are compiled on their own, because they have names of others
#   PRECOMPILED  kind of precompiled headers, see als_precompile (default: library)
#   LINEAR_ALGEBRA  it is built a second time for processors with AVX2, see PCL_ALS_WITH_X86_64_V3; no
#   object of Eigen is allocated on one side of its functions and freed on the other
function(als_add_module)
  cmake_parse_arguments(ARG "LINEAR_ALGEBRA" "NAME;PRECOMPILED"
    "SOURCES;SEPARATE;MODULES;PUBLIC;PRIVATE;DEFINITIONS" ${ARGN})
  _pcl_als_check_arguments(als_add_module "${ARG_UNPARSED_ARGUMENTS}")
  set(target pcl_als_${ARG_NAME})
  add_library(${target} ${ARG_SOURCES})
  add_library(pcl_als::${ARG_NAME} ALIAS ${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/internal>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${PCL_ALS_INTERNAL_INCLUDEDIR}>)
  list(TRANSFORM ARG_MODULES PREPEND pcl_als::)
  target_link_libraries(${target} PUBLIC ${ARG_MODULES} ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  target_compile_definitions(${target} PRIVATE ${ARG_DEFINITIONS})
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED library)
  endif()
  als_precompile(${target} ${ARG_PRECOMPILED})
  _pcl_als_unity_build(${target} "${ARG_SEPARATE}")
  # Installed libraries find each other wherever the prefix is moved to.
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${ARG_NAME} INSTALL_RPATH "$ORIGIN"
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  set_property(GLOBAL APPEND PROPERTY PCL_ALS_EXPORTED_MODULES ${ARG_NAME})
  install(TARGETS ${target} EXPORT pcl_als-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT headers
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT headers)
  _pcl_als_install_headers()
  if(ARG_LINEAR_ALGEBRA AND PCL_ALS_WITH_X86_64_V3)
    _pcl_als_add_x86_64_v3(${target} "${ARG_SOURCES}" "${ARG_MODULES};${ARG_PUBLIC};${ARG_PRIVATE}")
  endif()
endfunction()

# The same library for processors with AVX2 and FMA, in the folder where the loader prefers it.
function(_pcl_als_add_x86_64_v3 target sources libraries)
  set(fast ${target}_x86_64_v3)
  set(folder glibc-hwcaps/x86-64-v3)
  add_library(${fast} SHARED ${sources})
  target_include_directories(${fast} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/include
    ${CMAKE_CURRENT_SOURCE_DIR}/internal)
  target_link_libraries(${fast} PRIVATE ${libraries})
  target_compile_options(${fast} PRIVATE -march=x86-64-v3
    -fvisibility-inlines-hidden)  # functions of headers are not exchanged with other libraries
  set_target_properties(${fast} PROPERTIES OUTPUT_NAME ${target} INSTALL_RPATH "$ORIGIN/../.."
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${folder}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  add_dependencies(${target} ${fast})
  install(TARGETS ${fast} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${folder}
    COMPONENT libraries NAMELINK_SKIP)
endfunction()

# The manual page of a tool, from what it prints with -h, with the page of the manual about its use,
# and its completion in bash, from -list_options.
function(_pcl_als_man_page target tool manual)
  set(script ${PROJECT_SOURCE_DIR}/share/cmake/man_page.awk)
  set(page ${CMAKE_BINARY_DIR}/man/${tool}.1)
  add_custom_command(OUTPUT ${page} DEPENDS ${target} ${script} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/man
    COMMAND $<TARGET_FILE:${target}> -h > ${page}.txt
    COMMAND awk -v tool=${tool} -v version=${PROJECT_VERSION}
      -v manual=${manual} -f ${script} ${page}.txt > ${page})
  set(completion_script ${PROJECT_SOURCE_DIR}/share/cmake/completion.awk)
  set(completion ${CMAKE_BINARY_DIR}/completions/${tool})
  add_custom_command(OUTPUT ${completion} DEPENDS ${target} ${completion_script} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/completions
    COMMAND $<TARGET_FILE:${target}> -list_options > ${completion}.txt
    COMMAND awk -v tool=${tool} -f ${completion_script} ${completion}.txt > ${completion}
    COMMAND ${CMAKE_COMMAND} -E rm ${completion}.txt)
  add_custom_target(${target}_man ALL DEPENDS ${page} ${completion})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
  install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions
    COMPONENT tools)
endfunction()

# als_add_app(VERB calibrate MANUAL questions.md#… SOURCES … MODULES …): the tool pcl_als_VERB
#   MANUAL  page of share/doc, with the anchor of the heading, that shows its use
function(als_add_app)
  cmake_parse_arguments(ARG "" "VERB;MANUAL" "SOURCES;MODULES;PRIVATE" ${ARGN})
  _pcl_als_check_arguments(als_add_app "${ARG_UNPARSED_ARGUMENTS}")
  set(target pcl_als_app_${ARG_VERB})
  add_executable(${target} ${ARG_SOURCES})
  list(TRANSFORM ARG_MODULES PREPEND pcl_als::)
  target_link_libraries(${target} PRIVATE pcl_als_app_support ${ARG_MODULES} ${ARG_PRIVATE})
  target_compile_definitions(${target} PRIVATE PCL_ALS_VERSION="${PROJECT_VERSION}")
  als_precompile(${target} library)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME pcl_als_${ARG_VERB}
    INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
  set_property(GLOBAL APPEND PROPERTY PCL_ALS_TOOLS ${target})
  if(NOT ARG_MANUAL)
    set(ARG_MANUAL README.md)
  endif()
  _pcl_als_man_page(${target} pcl_als_${ARG_VERB} share/doc/${ARG_MANUAL})
endfunction()

# als_add_tests(NAME io_tests SOURCES test_a.cpp … [MODULES …] [PRIVATE …] [INCLUDES …] [DEFINITIONS …]
#   [SEPARATE test_a.cpp …]): a GoogleTest program
# For each source test_a.cpp, ctest has a test test_a, which runs the tests of this source; further
# sources are compiled with them.
#   INCLUDES  folders of the project besides tests/support
#   SEPARATE  of the sources those that are compiled on their own, because they have names of others
function(als_add_tests)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;SEPARATE;MODULES;PRIVATE;INCLUDES;DEFINITIONS" ${ARGN})
  _pcl_als_check_arguments(als_add_tests "${ARG_UNPARSED_ARGUMENTS}")
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  list(TRANSFORM ARG_MODULES PREPEND pcl_als::)
  list(TRANSFORM ARG_INCLUDES PREPEND ${PROJECT_SOURCE_DIR}/)
  target_link_libraries(${ARG_NAME} PRIVATE ${ARG_MODULES} ${ARG_PRIVATE} pcl_als_test_main)
  target_include_directories(${ARG_NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support ${ARG_INCLUDES})
  target_compile_options(${ARG_NAME} PRIVATE ${PCL_ALS_TEST_OPTIONS})
  als_precompile(${ARG_NAME} test)
  _pcl_als_unity_build(${ARG_NAME} "${ARG_SEPARATE}")
  target_compile_definitions(${ARG_NAME} PRIVATE ${ARG_DEFINITIONS}
    PCL_ALS_TEST_SCRATCH="${CMAKE_CURRENT_BINARY_DIR}/scratch"
    PCL_ALS_TEST_DATA_DEFAULT="${PCL_ALS_TEST_DATA}")
  foreach(source IN LISTS ARG_SOURCES)
    cmake_path(GET source STEM test)
    if(NOT test MATCHES "^test_")
      continue()
    endif()
    add_test(NAME ${test} COMMAND ${ARG_NAME} ${test})
    if(NOT test IN_LIST PCL_ALS_LONG_TESTS)
      set_tests_properties(${test} PROPERTIES LABELS fast)
    endif()
  endforeach()
  cmake_language(DEFER CALL als_set_test_costs)
endfunction()
