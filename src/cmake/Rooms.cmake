# lantern_room(NAME LINKS ... [SOURCES ...]): the library lantern_NAME of all sources in src/NAME and
# its folders, or of these. Packages that only sources include are linked as $<BUILD_INTERFACE:...>: who uses the
# installed library need not have them.
function(lantern_room name)
  cmake_parse_arguments(ROOM "" "" "LINKS;SOURCES" ${ARGN})
  set(sources ${ROOM_SOURCES})
  if(NOT sources)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  endif()
  list(TRANSFORM ROOM_LINKS REPLACE "^([a-z]+)$" "lantern_\\1")
  set(includes $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lantern>)
  if(sources)
    add_library(lantern_${name} STATIC ${sources})
    target_include_directories(lantern_${name} PUBLIC ${includes})
    target_link_libraries(lantern_${name} PUBLIC ${ROOM_LINKS})
    lantern_precompile(lantern_${name} FROM lantern_headers)
  else()
    add_library(lantern_${name} INTERFACE)
    target_include_directories(lantern_${name} INTERFACE ${includes})
    target_link_libraries(lantern_${name} INTERFACE ${ROOM_LINKS})
  endif()
  lantern_installed_library(${name})
endfunction()

# lantern_embed(TARGET NAMESPACE HEADER file...): a library whose header HEADER declares, for each
# file, a std::string_view in lantern::NAMESPACE named after it, holding its bytes.
function(lantern_embed target namespace header)
  set(dir ${PROJECT_BINARY_DIR}/embedded/${target})
  list(JOIN ARGN "|" files)
  add_custom_command(
    OUTPUT ${dir}/embedded/${header} ${dir}/${target}.cpp
    COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" -DNAMESPACE=${namespace}
            -DHEADER=${dir}/embedded/${header} -DSOURCE=${dir}/${target}.cpp
            -P ${PROJECT_SOURCE_DIR}/src/cmake/Embed.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/src/cmake/Embed.cmake
    VERBATIM)
  add_library(${target} STATIC ${dir}/${target}.cpp ${dir}/embedded/${header})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${dir}>)
  string(REPLACE "lantern_" "" name ${target})
  lantern_installed_library(${name})
endfunction()

lantern_embed(lantern_font font font.hpp
  ${LANTERN_FONT_DIR}/Inter-Regular.otf ${LANTERN_FONT_DIR}/Inter-SemiBold.otf)
file(GLOB shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*)
lantern_embed(lantern_shaders shader shaders.hpp ${shaders})
file(GLOB lecture_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/lecture/*.?pp)
lantern_embed(lantern_lecture_source lecture_source lecture_source.hpp ${lecture_files})
if(LANTERN_LAB)
  file(GLOB problems CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scenarios/problems/*.toml
    ${PROJECT_SOURCE_DIR}/scenarios/problems/crowds/*.toml)  # these take minutes to run
  lantern_embed(lantern_problems problem problems.hpp ${problems})
endif()

lantern_embed(lantern_output_schema output output_schema.hpp
  ${PROJECT_SOURCE_DIR}/scenarios/output.schema.json)

# lantern_version: the version, and a hash of everything that decides what a frame looks like.
file(GLOB_RECURSE lantern_sources CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/src/*.?pp ${PROJECT_SOURCE_DIR}/shaders/*)
set(version_dir ${PROJECT_BINARY_DIR}/embedded/version)
add_custom_command(
  OUTPUT ${version_dir}/embedded/version.hpp
  COMMAND ${CMAKE_COMMAND} -DVERSION=${PROJECT_VERSION} -DROOT=${PROJECT_SOURCE_DIR}
          -DHEADER=${version_dir}/embedded/version.hpp
          -P ${PROJECT_SOURCE_DIR}/src/cmake/Version.cmake
  DEPENDS ${lantern_sources} ${PROJECT_SOURCE_DIR}/src/cmake/Version.cmake
  VERBATIM)
add_custom_target(lantern_version_header DEPENDS ${version_dir}/embedded/version.hpp)
add_library(lantern_version INTERFACE)
add_dependencies(lantern_version lantern_version_header)
target_include_directories(lantern_version INTERFACE ${version_dir})
