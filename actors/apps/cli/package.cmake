# The files of an installed Luxodus, and its Debian package:
#   cmake --build build/release --target luxodus luxodus_python package_files
#   cmake --install build/release --prefix /opt/luxodus       or
#   cd build/release && cpack -G DEB
# The target package_files generates man pages (if help2man is installed), scripts of shells, and
# the documents as a site (if MkDocs is). tests/tools/package_test.sh does all of it.
include(GNUInstallDirs)
set(made ${PROJECT_BINARY_DIR}/package)
set(site ${made}/html)

find_program(HELP2MAN help2man)
find_program(MKDOCS mkdocs)
set(make_site)
if(MKDOCS)
  set(make_site COMMAND ${CMAKE_COMMAND} -E env LUXODUS=$<TARGET_FILE:luxodus>
    PYTHONDONTWRITEBYTECODE=1 ${MKDOCS} --quiet build --strict --site-dir ${site})
endif()
add_custom_target(package_files
  COMMAND ${PROJECT_SOURCE_DIR}/actors/apps/cli/package_files.sh $<TARGET_FILE:luxodus> ${made}
  ${make_site}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM
  COMMENT "Making man pages, shell completion and the site of the documents")
add_dependencies(package_files luxodus)

install(TARGETS luxodus RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(LUX_HAS_VDB)  # apart, so that a package does not depend on OpenVDB: --component vdb
  install(TARGETS luxodus_vdb RUNTIME DESTINATION lib/luxodus COMPONENT vdb EXCLUDE_FROM_ALL)
endif()
if(LUX_HAS_PYTHON)
  # The folder in which Debian's Python looks for modules of packages, below the prefix /usr.
  install(TARGETS luxodus_python LIBRARY DESTINATION lib/python3/dist-packages OPTIONAL)
endif()
# The folder in which the program looks for scenes: actors/apps/cli/library.cpp.
set(shared ${CMAKE_INSTALL_DATADIR}/luxodus)
install(DIRECTORY scenes/library DESTINATION ${shared}/scenes
  PATTERN "*.expected.toml" EXCLUDE)
# The script for shapes of IFC models, with its package if setup.sh has fetched it.
install(DIRECTORY actors/import/shapes/ DESTINATION ${shared}/ifc PATTERN ".gitignore" EXCLUDE
  PATTERN ".package-lock.json" EXCLUDE)
file(GLOB examples CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/actors/apps/cli/examples/*)
foreach(example ${examples})
  get_filename_component(name ${example} NAME)
  file(READ ${example} text)
  string(REPLACE "../../../../scenes/" "../scenes/" text "${text}")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/examples/${name} CONTENT "${text}" @ONLY)
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${examples})
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/examples DESTINATION ${shared})
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
if(MKDOCS)
  install(DIRECTORY ${site} DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
else()
  install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "tools" EXCLUDE)
endif()
install(DIRECTORY ${made}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} OPTIONAL)
install(FILES ${made}/luxodus.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME luxodus OPTIONAL)
install(FILES ${made}/_luxodus DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions OPTIONAL)

set(CPACK_PACKAGE_NAME luxodus)
set(CPACK_PACKAGE_CONTACT "The Luxodus developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Light in smoke-filled buildings by Monte Carlo tracing")
set(CPACK_PACKAGE_DESCRIPTION "Luxodus simulates the light in a smoke-filled building by Monte Carlo
particle tracing: illuminance on the escape routes, and what an eye receives from the exit signs. It
assesses signs and routes by EN 1838 and NFPA 101, and shows the building live in a browser.")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)  # letters of signs
if(LUX_HAS_PYTHON)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy")  # the module luxodus
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "chromium, nodejs (>= 18)")  # print report.pdf; import ifc
include(CPack)
