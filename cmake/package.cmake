# What is installed beside the program, and the Debian package that cpack makes of it: manual pages, completion for shells,
# copyright and changes. Included behind the rooms.
if(NOT TARGET hysteron)
  return()
endif()
include(GNUInstallDirs)

# Manual pages and completion, by the program itself; packed as man(1) and Debian want them.
set(share ${PROJECT_BINARY_DIR}/share)
set(copyright ${PROJECT_SOURCE_DIR}/cmake/debian/copyright)
if(NOT CMAKE_CROSSCOMPILING)
  add_custom_command(OUTPUT ${share}/written
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${share}
    COMMAND sh -c "\"$<TARGET_FILE:hysteron>\" manual -o \"${share}\" > /dev/null"
    COMMAND find ${share}/man -name "*.1" -exec gzip -9n {} +
    COMMAND ${CMAKE_COMMAND} -E touch ${share}/written
    DEPENDS hysteron COMMENT "Manual pages and shell completion" VERBATIM)
  add_custom_target(manual_pages ALL DEPENDS ${share}/written)
  # Where only the program was built there are none.
  install(DIRECTORY ${share}/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program OPTIONAL PATTERN written EXCLUDE)
  # Where Debian's zsh looks; its own folder is that of /usr/local.
  install(FILES ${share}/zsh/site-functions/_hysteron DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
          COMPONENT debian OPTIONAL EXCLUDE_FROM_ALL)
  install(CODE "if(NOT EXISTS ${share}/written)
    message(STATUS \"without manual pages and completion: the target manual_pages was not built\")
  endif()" COMPONENT program)
endif()

# A line of changes in Debian's form, which points at ours.
set(doc ${PROJECT_BINARY_DIR}/doc)
set(HYSTERON_MAINTAINER "hysteron maintainers <maintainers@hysteron.invalid>" CACHE STRING
    "Who answers for a Debian package that is made here")
configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/changelog.in ${doc}/changelog.Debian @ONLY)
file(COPY ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${doc})
execute_process(COMMAND gzip -9nfk ${doc}/changelog.Debian)
execute_process(COMMAND gzip -9nfc ${doc}/CHANGELOG.md OUTPUT_FILE ${doc}/changelog.gz)
install(FILES ${doc}/changelog.gz ${copyright} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES ${doc}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
        RENAME hysteron COMPONENT debian EXCLUDE_FROM_ALL)

# Libraries that are loaded when the first file of their format is read: the package that owns them.
set(loaded)
foreach(library ${HDF5} ${MATIO})
  get_filename_component(file ${library} REALPATH)
  execute_process(COMMAND dpkg-query -S ${file} OUTPUT_VARIABLE owner ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    string(REGEX REPLACE ":.*" "" owner "${owner}")
    list(APPEND loaded ${owner})
  endif()
endforeach()
list(JOIN loaded ", " loaded)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hysteron)
set(CPACK_PACKAGE_CONTACT "${HYSTERON_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "find out what a model of a machine lacks, from recordings")
set(CPACK_PACKAGE_DESCRIPTION
"Simulates block diagrams of actuators and other motion systems, compares
them with recordings, names the physical effect that a model lacks, puts it
into the diagram, fits it, and shows the error falling on recordings that
were not used for the fit.
.
Diagrams are text (JSON) or drawn in a browser; recordings are read as
oscilloscopes, loggers, spreadsheets, LabVIEW and MATLAB write them.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${loaded}")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS graphviz)  # of "hysteron draw" and the studio
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# The program alone: libhysteron.so would be a package of its own.
set(CPACK_COMPONENTS_ALL program debian)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
include(CPack)
