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
