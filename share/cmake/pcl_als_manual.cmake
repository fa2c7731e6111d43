# The manual (share/doc): cmake --build build --target manual makes it, with the reference of all
# public headers, as HTML in manual/html of the build folder, where Doxygen is found.
find_program(PCL_ALS_DOXYGEN doxygen DOC "Makes the manual; with Graphviz's dot it has diagrams")
find_program(PCL_ALS_DOT dot DOC "Draws the diagrams of the manual")
if(PCL_ALS_DOXYGEN)
  set(dot)
  if(PCL_ALS_DOT)
    set(dot ${PCL_ALS_DOT})
  endif()
  add_custom_target(manual VERBATIM COMMENT "Making the manual"
    COMMAND ${PROJECT_SOURCE_DIR}/share/doc/doxygen/build.sh ${PROJECT_SOURCE_DIR}
      ${CMAKE_BINARY_DIR}/manual ${PROJECT_VERSION} ${PCL_ALS_DOXYGEN} ${dot})
else()
  add_custom_target(manual VERBATIM
    COMMAND ${CMAKE_COMMAND} -E echo "The manual is made by Doxygen, which is not installed; its pages are in share/doc"
    COMMAND ${CMAKE_COMMAND} -E false)
endif()

# The pages and what they link, in the folders of the sources, so that links between them hold; the
# HTML where it was made before the installation.
set(PCL_ALS_MANUAL_DIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/pcl_als)
file(GLOB_RECURSE pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  modules/*.md share/*.md share/*.png share/*.svg tests/*.md)
foreach(page IN LISTS pages ITEMS README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md HOWTORELEASE.md
    LICENSE SECURITY.md)
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${PCL_ALS_MANUAL_DIR}/${folder} COMPONENT documentation)
endforeach()
install(DIRECTORY share/examples share/benchmark share/schema DESTINATION ${PCL_ALS_MANUAL_DIR}/share
  COMPONENT documentation
  USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
install(DIRECTORY ${CMAKE_BINARY_DIR}/manual/html DESTINATION ${PCL_ALS_MANUAL_DIR}
  COMPONENT documentation OPTIONAL)
