# `cpack -G DEB` in the build folder: the packages lantern (the program), lantern-lab (what measures,
# and the engines beside it), lantern-dev (libraries) and lantern-doc (README and examples).
set(CPACK_PACKAGE_NAME lantern)
set(CPACK_PACKAGE_CONTACT "Lantern maintainers <maintainers@users.noreply.h-seed-c57911ac.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "lecture figures of trees, pairs and contacts from text files")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL runtime lab development documentation)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME lantern)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Loaded while it runs, so that the linker does not know of it: to draw, for PDF, for films; and the
# other backend.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS libosmesa6)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libcairo2, ffmpeg")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "libegl1, libgl1-mesa-dri, lantern-lab, lantern-dev, lantern-doc, fonts-ipaexfont-gothic")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"Lantern turns scripted scenarios about broad phase and narrow phase into
pictures, films, documents and lesson pages. It needs no display. A real engine
runs what a text file says, and every node, pair and count on a picture is the
engine's own. The scenarios of the lecture come along: lantern list")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME lantern-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libfmt-dev, libglm-dev, libdeflate-dev, libtomlplusplus-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Static libraries, headers and CMake's files for find_package(Lantern): the
targets Lantern::spatial, Lantern::physics, Lantern::render, and
Lantern::program for a Lantern with structures of your own.")

set(CPACK_DEBIAN_LAB_PACKAGE_NAME lantern-lab)
set(CPACK_DEBIAN_LAB_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LAB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LAB_PACKAGE_DEPENDS "lantern (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_LAB_DESCRIPTION
"Error against run time, stress tests and benches: the commands measure, stress
and bench of Lantern, and the other engines and libraries that they run beside
it, as far as they were there when this was built.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME lantern-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SUGGESTS "lantern")
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION
"The README of Lantern, and examples to begin from: a project with a structure
of one's own, programs for its libraries, a workflow that compares golden
pictures, and a hook for commits.")
include(CPack)

# `cmake --build build --target api`: the page of the API in build/api/html, where Doxygen is.
find_program(LANTERN_DOXYGEN doxygen)
mark_as_advanced(LANTERN_DOXYGEN)
if(LANTERN_DOXYGEN)
  # As they are installed, so that the page says what to include.
  list(TRANSFORM lantern_public_rooms PREPEND ${PROJECT_BINARY_DIR}/include/lantern/
    OUTPUT_VARIABLE api_input)
  list(APPEND api_input ${PROJECT_BINARY_DIR}/include/lantern/version.hpp
    ${PROJECT_BINARY_DIR}/include/lantern/app/program.hpp ${PROJECT_SOURCE_DIR}/src/cmake/api.md)
  list(JOIN api_input " " api_input)
  configure_file(src/cmake/Doxyfile.in Doxyfile @ONLY)
  add_custom_target(api COMMAND ${CMAKE_COMMAND} -E make_directory api
    COMMAND ${LANTERN_DOXYGEN} Doxyfile VERBATIM)
endif()
