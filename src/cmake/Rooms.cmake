# lantern_room(NAME [GUEST | NOT_INSTALLED] LINKS ...): the library lantern_NAME of all sources in src/NAME and its
# folders. Packages that only sources include are linked as $<BUILD_INTERFACE:...>: who uses the
# installed library need not have them. A guest is a part of the lab's module, and not installed. What is NOT_INSTALLED is in no program of its own,
# and built for whoever links it.
function(lantern_room name)
  cmake_parse_arguments(ROOM "GUEST;NOT_INSTALLED" "" "LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  list(TRANSFORM ROOM_LINKS REPLACE "^([a-z]+)$" "lantern_\\1")
  set(includes $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lantern>)
  if(sources)
    add_library(lantern_${name} STATIC ${sources})
    target_include_directories(lantern_${name} PUBLIC ${includes})
    target_link_libraries(lantern_${name} PUBLIC ${ROOM_LINKS})
    if(ROOM_GUEST)
      set_target_properties(lantern_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
      lantern_precompile(lantern_${name} FROM lab_headers)
    else()
      lantern_precompile(lantern_${name} FROM lantern_headers)
    endif()
  else()
    add_library(lantern_${name} INTERFACE)
    target_include_directories(lantern_${name} INTERFACE ${includes})
    target_link_libraries(lantern_${name} INTERFACE ${ROOM_LINKS})
  endif()
  if(ROOM_NOT_INSTALLED)
    set_target_properties(lantern_${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  elseif(NOT ROOM_GUEST)
    lantern_installed_library(${name})
    set_property(GLOBAL APPEND PROPERTY lantern_rooms ${name})
  endif()
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
endfunction()

lantern_embed(lantern_font font font.hpp
  ${LANTERN_FONT_DIR}/Inter-Regular.otf ${LANTERN_FONT_DIR}/Inter-SemiBold.otf
  ${LANTERN_CODE_FONT_DIR}/Inconsolata.otf)
file(GLOB shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*)
lantern_embed(lantern_shaders shader shaders.hpp ${shaders})
file(GLOB lecture_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/lecture/*.?pp)
lantern_embed(lantern_lecture_source lecture_source lecture_source.hpp ${lecture_files})
file(GLOB examples CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/language/examples/*.toml)
lantern_embed(lantern_examples examples examples.hpp ${examples})
file(GLOB words CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/language/words/*.toml)
lantern_embed(lantern_words words words.hpp ${words})
lantern_embed(lantern_output_schema output output_schema.hpp
  ${PROJECT_SOURCE_DIR}/scenarios/output.schema.json)

# lantern_version_of(NAME CONSTANT WITHOUT FILE...): the library NAME whose header embedded/NAME.hpp has
# the version and, as CONSTANT, one hash of FILEs, which are all of src/ and shaders/ but for those
# whose path is like WITHOUT.
function(lantern_version_of name constant without)
  set(dir ${PROJECT_BINARY_DIR}/embedded/${name})
  add_custom_command(
    OUTPUT ${dir}/embedded/${name}.hpp
    COMMAND ${CMAKE_COMMAND} -DVERSION=${PROJECT_VERSION} -DROOT=${PROJECT_SOURCE_DIR}
            -DHEADER=${dir}/embedded/${name}.hpp -DCONSTANT=${constant} "-DWITHOUT=${without}"
            -P ${PROJECT_SOURCE_DIR}/src/cmake/Version.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/src/cmake/Version.cmake
    VERBATIM)
  add_custom_target(lantern_${name}_header DEPENDS ${dir}/embedded/${name}.hpp)
  add_library(lantern_${name} INTERFACE)
  add_dependencies(lantern_${name} lantern_${name}_header)
  target_include_directories(lantern_${name} INTERFACE ${dir})
endfunction()

# lantern_version: the version, and a hash of everything that decides what a frame looks like.
file(GLOB_RECURSE lantern_sources CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/src/*.?pp ${PROJECT_SOURCE_DIR}/shaders/*)
set(lab_sources ${lantern_sources})
set(of_the_lab "src/(lab|measure|report|peers)/")
list(FILTER lantern_sources EXCLUDE REGEX "/${of_the_lab}")
lantern_version_of(version kSourceHash "^${of_the_lab}" ${lantern_sources})
