# Run by CPack (CPACK_PRE_BUILD_SCRIPTS) over the folder of each package before it is packed: what Debian
# requires of packages and an installation from the sources does not have. The licence and a changelog
# of the package are added, manual pages are compressed, and the Python package goes into the folder
# that Debian's packages use for all versions of Python.
find_program(gzip gzip REQUIRED)
function(compress file)
  execute_process(COMMAND ${gzip} -9n ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  set(folder ${root}/usr/share/doc/${name})
  file(MAKE_DIRECTORY ${folder})
  file(COPY_FILE ${CPACK_RESOURCE_FILE_LICENSE} ${folder}/copyright)
  # The permissions of the sources are those of the umask with which they were checked out.
  file(CHMOD ${folder}/copyright PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(WRITE ${folder}/changelog.Debian
"${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) UNRELEASED; urgency=medium

  * Packages of version ${CPACK_PACKAGE_VERSION}, made with cpack from a build of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  compress(${folder}/changelog.Debian)
  file(GLOB pages ${root}/usr/share/man/man*/*)
  foreach(page IN LISTS pages)
    compress(${page})
  endforeach()
endforeach()

file(GLOB versions ${CPACK_TEMPORARY_DIRECTORY}/python/usr/lib/python3.*)
foreach(version IN LISTS versions)
  file(RENAME ${version} ${CPACK_TEMPORARY_DIRECTORY}/python/usr/lib/python3)
endforeach()

file(WRITE ${CPACK_TEMPORARY_DIRECTORY}/libraries/usr/share/lintian/overrides/${CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME}
"# One package holds the libraries of all modules, which have the same version.
package-name-doesnt-match-sonames
# CPack writes scripts that call ldconfig for every package with libraries, besides the trigger.
maintscript-calls-ldconfig
")
