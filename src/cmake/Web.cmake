# build/web/lantern.wasm: the rooms that a page needs, without OpenGL, files, threads, films, lab and
# command line. CMakeLists.txt reads this in place of all else when the toolchain is wasm.cmake.
find_path(LANTERN_FMT_DIR fmt/format.h REQUIRED)
# The packages' headers alone: beside them stand the machine's own, which are not for WebAssembly.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(package fmt glm toml++ nlohmann hwy)
  file(CREATE_LINK ${LANTERN_FMT_DIR}/${package} ${headers}/${package} SYMBOLIC)
endforeach()
find_path(LANTERN_STB_DIR stb_truetype.h PATH_SUFFIXES stb REQUIRED)
file(CREATE_LINK ${LANTERN_STB_DIR} ${headers}/stb SYMBOLIC)
find_path(LANTERN_FONT_DIR Inter-Regular.otf PATHS /usr/share/fonts/opentype/inter REQUIRED)
find_path(LANTERN_CODE_FONT_DIR Inconsolata.otf PATHS /usr/share/fonts/truetype/inconsolata REQUIRED)
# What letters lead to, without alternates, rules of shaping and hints. Whole typefaces serve as
# well, where the tool is missing (libharfbuzz-bin).
find_program(LANTERN_HB_SUBSET hb-subset)
if(LANTERN_HB_SUBSET)
  set(fonts ${PROJECT_BINARY_DIR}/fonts)
  file(MAKE_DIRECTORY ${fonts})
  foreach(font ${LANTERN_FONT_DIR}/Inter-Regular.otf ${LANTERN_FONT_DIR}/Inter-SemiBold.otf
      ${LANTERN_CODE_FONT_DIR}/Inconsolata.otf)
    cmake_path(GET font FILENAME name)
    add_custom_command(OUTPUT ${fonts}/${name} DEPENDS ${font} VERBATIM
      COMMAND ${LANTERN_HB_SUBSET} ${font} --unicodes=* --layout-features=kern --no-hinting
      --notdef-outline --drop-tables+=GSUB,GDEF,OS/2,post -o ${fonts}/${name})
  endforeach()
  set(LANTERN_FONT_DIR ${fonts})
  set(LANTERN_CODE_FONT_DIR ${fonts})
endif()
include(Precompiled)
include(Rooms)

set(src ${PROJECT_SOURCE_DIR}/src)
# world.cpp instantiates its class again, which clang refuses within one source.
set_source_files_properties(${src}/physics/world.cpp ${src}/spatial/near_pairs.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
set_source_files_properties(${src}/language/text/problems.cpp PROPERTIES
  COMPILE_OPTIONS "-I${src}/web/config;-O2" SKIP_UNITY_BUILD_INCLUSION ON
  SKIP_PRECOMPILE_HEADERS ON)
# They include themselves; Highway's vectors for WebAssembly have no doubles, of which one is made.
set_source_files_properties(${src}/spatial/box_vectors.cpp ${src}/physics/contact/quick_vectors.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
set_source_files_properties(${src}/spatial/box_vectors.cpp PROPERTIES COMPILE_OPTIONS -msimd128)
add_library(lantern_web_options INTERFACE)
target_include_directories(lantern_web_options INTERFACE ${src})
target_include_directories(lantern_web_options SYSTEM INTERFACE ${headers} ${headers}/stb)
foreach(library font lecture_source examples)
  target_link_libraries(lantern_web_options INTERFACE lantern_${library})
endforeach()
target_link_libraries(lantern_web_options INTERFACE lantern_version)
# Numbers are read and written without a locale: libc++'s would be a thirtieth.
target_compile_definitions(lantern_web_options INTERFACE FMT_HEADER_ONLY TOML_HEADER_ONLY=1
  TOML_FLOAT_CHARCONV=1 FMT_STATIC_THOUSANDS_SEPARATOR=',')
# What is to be warned of is told by the other builds.
target_compile_options(lantern_web_options INTERFACE -w -include ${src}/web/one_thread.hpp)

set(quick -O2)
set(even -Os)
set(small -Oz)
foreach(kind quick even small)
  lantern_headers(web_${kind}_headers LINKS lantern_web_options OPTIONS ${${kind}}
    HEADERS ${common_headers})
endforeach()

add_executable(lantern_wasm)
set_target_properties(lantern_wasm PROPERTIES OUTPUT_NAME lantern SUFFIX .wasm)
foreach(room base geometry lecture spatial atlas physics language frame run draw render publish live web)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${src}/${room}/*.cpp)
  if(room STREQUAL base)
    list(FILTER sources EXCLUDE REGEX "/(attempt|child|file|machine_memory|streams)\\.cpp$")
  elseif(room STREQUAL spatial)
    list(FILTER sources EXCLUDE REGEX "/structure_trial\\.cpp$")
  elseif(room STREQUAL language)
    list(FILTER sources EXCLUDE REGEX "/(load|shipped_words)\\.cpp$")
  elseif(room STREQUAL render)
    list(FILTER sources INCLUDE REGEX "/svg\\.cpp$")
  elseif(room STREQUAL publish)
    list(FILTER sources INCLUDE REGEX "/lesson_(facts|frames)\\.cpp$")
  endif()
  add_library(lantern_web_${room} OBJECT ${sources})
  # Those where a drag's time goes are quick; of the others a small one is opened sooner. Of the
  # structures there are many, and the smallest would take twice the time.
  if(room MATCHES "^(language|run|render|live|web)$")
    set(kind small)
  elseif(room STREQUAL spatial)
    set(kind even)
  else()
    set(kind quick)
  endif()
  target_compile_options(lantern_web_${room} PRIVATE ${${kind}})
  lantern_precompile(lantern_web_${room} FROM web_${kind}_headers)
  target_link_libraries(lantern_web_${room} PRIVATE lantern_web_options)
  target_link_libraries(lantern_wasm PRIVATE lantern_web_${room})
endforeach()
target_link_libraries(lantern_wasm PRIVATE lantern_web_options)
