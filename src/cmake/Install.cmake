# What `cmake --install` puts where, and what other projects link. Four components: `runtime` is the
# program and what it brings along, `lab` what measures and the engines beside it, `development` the
# libraries, their headers and CMake's files, `documentation` what one reads and begins from.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(lantern_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Lantern)
# The rooms whose headers others may include.
set(lantern_public_rooms base geometry lecture spatial atlas physics language frame run draw render)

# lantern_installed_library(NAME): lantern_NAME goes along, whoever links it finds it.
function(lantern_installed_library name)
  set_target_properties(lantern_${name} PROPERTIES EXPORT_NAME room_${name})
  install(TARGETS lantern_${name} EXPORT LanternTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endfunction()

# lantern_public(NAME ROOM...): Lantern::NAME, here and after find_package(Lantern), is these rooms and
# those that they see, with <lantern/ROOM/....hpp> and <lantern/version.hpp>.
function(lantern_public name)
  list(TRANSFORM ARGN PREPEND lantern_ OUTPUT_VARIABLE rooms)
  add_library(lantern_public_${name} INTERFACE)
  add_library(Lantern::${name} ALIAS lantern_public_${name})
  set_target_properties(lantern_public_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(lantern_public_${name} INTERFACE ${rooms})
  target_compile_features(lantern_public_${name} INTERFACE cxx_std_20)
  # Headers hold arithmetic, too: it is rounded as in the libraries, on whatever machine.
  target_compile_options(lantern_public_${name} INTERFACE -ffp-contract=off)
  target_include_directories(lantern_public_${name} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS lantern_public_${name} EXPORT LanternTargets COMPONENT development)
endfunction()

# lantern_exports(NAME): programs with Lantern::NAME hold all of every room, and whatever they load, the
# lab that is, sees it. LanternConfig.cmake says the same of those that are installed.
function(lantern_exports name)
  get_property(rooms GLOBAL PROPERTY lantern_rooms)
  list(TRANSFORM rooms REPLACE "(.+)" "$<TARGET_FILE:lantern_\\1>" OUTPUT_VARIABLE archives)
  list(JOIN archives "," archives)
  target_link_options(lantern_public_${name} INTERFACE
    $<BUILD_INTERFACE:LINKER:--dynamic-list=${PROJECT_SOURCE_DIR}/src/cmake/exports>
    "$<BUILD_INTERFACE:LINKER:--whole-archive,${archives},--no-whole-archive>")
endfunction()

# build/include/lantern looks as include/lantern will.
function(lantern_link_headers)
  set(dir ${PROJECT_BINARY_DIR}/include/lantern)
  configure_file(${PROJECT_SOURCE_DIR}/src/cmake/version.hpp.in ${dir}/version.hpp @ONLY)
  foreach(name ${lantern_public_rooms} app rooms.hpp)
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${name} ${dir}/${name} SYMBOLIC)
  endforeach()
endfunction()

function(lantern_install_development)
  get_property(lantern_rooms GLOBAL PROPERTY lantern_rooms)
  set(here DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lantern COMPONENT development)
  list(TRANSFORM lantern_public_rooms PREPEND ${PROJECT_SOURCE_DIR}/src/ OUTPUT_VARIABLE folders)
  # These are not for others: they would ask them for the headers of OpenGL and Highway.
  install(DIRECTORY ${folders} ${here} FILES_MATCHING PATTERN *.hpp
    PATTERN gl.hpp EXCLUDE PATTERN vector_targets.hpp EXCLUDE)
  install(FILES ${PROJECT_SOURCE_DIR}/src/rooms.hpp ${PROJECT_BINARY_DIR}/include/lantern/version.hpp
    ${here})
  install(FILES ${PROJECT_SOURCE_DIR}/src/app/program.hpp
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lantern/app COMPONENT development)
  install(EXPORT LanternTargets NAMESPACE Lantern:: DESTINATION ${lantern_cmake_dir}
    COMPONENT development)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/src/cmake/LanternConfig.cmake.in
    ${PROJECT_BINARY_DIR}/LanternConfig.cmake INSTALL_DESTINATION ${lantern_cmake_dir})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/LanternConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)  # until 1.0 a new minor version may break its users
  install(FILES ${PROJECT_BINARY_DIR}/LanternConfig.cmake
    ${PROJECT_BINARY_DIR}/LanternConfigVersion.cmake ${PROJECT_SOURCE_DIR}/src/cmake/exports
    DESTINATION ${lantern_cmake_dir} COMPONENT development)
  install(FILES ${PROJECT_SOURCE_DIR}/src/cmake/copyright
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lantern-dev COMPONENT development)
endfunction()

# lantern_install_pages(COMPONENT FOLDER [PART]): the pages there, which were installed before, as those
# read them who have no sources. They are those of PART of the repository.
function(lantern_install_pages component folder)
  list(JOIN lantern_public_rooms "|" rooms)
  install(CODE "
    set(pages \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${folder}\")
    set(part \"${ARGN}\")
    set(source \"${PROJECT_SOURCE_DIR}\")
    set(rooms \"${rooms}\")
    include(\"${PROJECT_SOURCE_DIR}/src/cmake/InstallPages.cmake\")" COMPONENT ${component})
endfunction()

# The README with what it shows and leads to, and examples to begin from: a project with a structure
# of one's own, a workflow, a hook, programs for the libraries.
function(lantern_install_documentation)
  set(here ${CMAKE_INSTALL_DATADIR}/doc/lantern-doc)
  install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/src/cmake/copyright
    DESTINATION ${here} COMPONENT documentation)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tests/example ${PROJECT_SOURCE_DIR}/tests/example_api
    DESTINATION ${here}/tests COMPONENT documentation)
  file(STRINGS ${PROJECT_SOURCE_DIR}/README.md shown REGEX "tests/golden/")
  string(REGEX MATCHALL "tests/golden/[a-z_0-9/]+[.]png" shown "${shown}")
  foreach(picture ${shown})
    cmake_path(GET picture PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${picture} DESTINATION ${here}/${folder}
      COMPONENT documentation)
  endforeach()
  install(FILES ${PROJECT_SOURCE_DIR}/tests/README.md DESTINATION ${here}/tests
    COMPONENT documentation)
  install(FILES ${PROJECT_SOURCE_DIR}/src/ARCHITECTURE.md ${PROJECT_SOURCE_DIR}/src/THIRD_PARTY.md
    DESTINATION ${here}/src COMPONENT documentation)
  lantern_install_pages(documentation ${here})
  # The scenarios come with the program.
  install(CODE "file(CREATE_LINK ../../lantern/scenarios
    \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${here}/scenarios\" SYMBOLIC)" COMPONENT documentation)
endfunction()

# lantern_install(): after all rooms and the program.
function(lantern_install)
  foreach(embedded font shaders lecture_source examples words lesson_files output_schema)
    lantern_installed_library(${embedded})
  endforeach()
  lantern_link_headers()
  lantern_install_development()
  lantern_install_documentation()
  install(TARGETS lantern RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lantern COMPONENT runtime)
  lantern_install_pages(runtime ${CMAKE_INSTALL_DATADIR}/lantern/scenarios scenarios)
  install(FILES ${PROJECT_BINARY_DIR}/lantern.wasm  # what live pages carry, where it is built
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lantern COMPONENT runtime OPTIONAL)
  install(FILES ${PROJECT_SOURCE_DIR}/src/cmake/copyright ${PROJECT_SOURCE_DIR}/src/THIRD_PARTY.md
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lantern COMPONENT runtime)
  # Manual pages and completions are the program's own: written by it when it is installed.
  find_program(LANTERN_GZIP gzip)
  mark_as_advanced(LANTERN_GZIP)
  install(CODE "
    set(lantern \"$<TARGET_FILE:lantern>\")
    set(gzip \"${LANTERN_GZIP}\")
    set(work \"${PROJECT_BINARY_DIR}/manual\")
    set(changelog \"${PROJECT_SOURCE_DIR}/CHANGELOG.md\")
    set(data_dir \"${CMAKE_INSTALL_DATADIR}\")
    set(man_dir \"${CMAKE_INSTALL_MANDIR}\")
    include(\"${PROJECT_SOURCE_DIR}/src/cmake/InstallManual.cmake\")" COMPONENT runtime)
endfunction()
