# The lab: measure, stress and bench. A module of its own, build/lantern_lab.so, that the program loads
# when it is asked for them (src/app/lab.hpp). What it uses of Lantern's rooms is in the program.
file(GLOB problems CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scenarios/problems/*.toml
  ${PROJECT_SOURCE_DIR}/scenarios/problems/crowds/*.toml)  # these take minutes to run
lantern_embed(lantern_problems problem problems.hpp ${problems})
file(GLOB stress CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scenarios/stress/*.toml)
lantern_embed(lantern_stress stress_scenario stress_scenarios.hpp ${stress})
lantern_version_of(lab_version kLabHash "" ${lab_sources})
lantern_headers(lab_headers LINKS fmt::fmt glm::glm HEADERS ${common_headers})
set_target_properties(lantern_problems lantern_stress lab_headers PROPERTIES
  POSITION_INDEPENDENT_CODE ON)

lantern_room(measure GUEST LINKS run lantern_problems lantern_stress lantern_lab_version)
lantern_room(report GUEST LINKS measure render)
lantern_room(lab GUEST LINKS report app)
# What they do is not what is measured: of that a fiftieth is measure's own.
foreach(room measure report lab)
  target_compile_options(lantern_${room} PRIVATE ${cold_options})
endforeach()
# A report says how its program was built.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
target_compile_definitions(lantern_measure PRIVATE
  LANTERN_FLAGS="${CMAKE_BUILD_TYPE}: ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off$<$<BOOL:${hot_options}>:, engine -O3>")

add_library(lab MODULE $<TARGET_OBJECTS:lantern_problems> $<TARGET_OBJECTS:lantern_stress>
  $<TARGET_OBJECTS:lantern_measure> $<TARGET_OBJECTS:lantern_report> $<TARGET_OBJECTS:lantern_lab>)
set_target_properties(lab PROPERTIES PREFIX "" OUTPUT_NAME lantern_lab SUFFIX ".so"
  LINKER_LANGUAGE CXX LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
target_link_libraries(lab PRIVATE fmt::fmt)
install(TARGETS lab LIBRARY DESTINATION lib/lantern COMPONENT lab OPTIONAL)
install(FILES ${PROJECT_SOURCE_DIR}/src/cmake/copyright
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lantern-lab COMPONENT lab)

# Other physics engines that Lantern is measured beside: each a module of its own in build/peers,
# loaded only while it is measured. All are optional; what is not installed is left out.
option(LANTERN_PEERS "Build the engines that Lantern is measured beside, where installed" ON)
add_custom_target(lantern_peers)

# lantern_peer(NAME VERSION FOUND INCLUDES ... LIBRARIES ... DEFINITIONS ... OPTIONS ...): the module
# of src/peers/NAME_peer.cpp. The engines are not built for the sanitizers, so neither are the modules.
function(lantern_peer name version)
  cmake_parse_arguments(PEER "" "" "FOUND;INCLUDES;LIBRARIES;DEFINITIONS;OPTIONS" ${ARGN})
  set(file ${PROJECT_BINARY_DIR}/peers/lantern_peer_${name}.so)
  if(NOT LANTERN_PEERS OR LANTERN_SANITIZE OR NOT PEER_FOUND)
    file(REMOVE ${file})  # of an earlier build
    return()
  endif()
  add_library(lantern_peer_${name} MODULE ${PROJECT_SOURCE_DIR}/src/peers/${name}_peer.cpp)
  set_target_properties(lantern_peer_${name} PROPERTIES PREFIX "" SUFFIX ".so"
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/peers)
  target_include_directories(lantern_peer_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_include_directories(lantern_peer_${name} SYSTEM PRIVATE ${PEER_INCLUDES})
  target_compile_definitions(lantern_peer_${name} PRIVATE ${PEER_DEFINITIONS}
    LANTERN_PEER_VERSION="${version}")
  target_compile_options(lantern_peer_${name} PRIVATE ${PEER_OPTIONS})
  target_link_libraries(lantern_peer_${name} PRIVATE fmt::fmt glm::glm ${PEER_LIBRARIES})
  add_dependencies(lantern_peers lantern_peer_${name})
  install(TARGETS lantern_peer_${name} LIBRARY DESTINATION lib/lantern/peers COMPONENT lab OPTIONAL)
endfunction()

lantern_peer(bullet "${bullet_VERSION} (double)" FOUND ${bullet_FOUND}
  INCLUDES ${bullet_INCLUDE_DIRS} LIBRARIES ${bullet_LINK_LIBRARIES}
  DEFINITIONS BT_USE_DOUBLE_PRECISION)
lantern_peer(box2d "${box2d_VERSION} (single)" FOUND ${box2d_FOUND}
  LIBRARIES ${box2d_LINK_LIBRARIES})
if(LANTERN_MUJOCO AND LANTERN_MUJOCO_DIR)
  file(STRINGS ${LANTERN_MUJOCO_DIR}/mujoco/mujoco.h mujoco_version REGEX "mjVERSION_HEADER [0-9]")
  string(REGEX REPLACE ".* ([0-9])([0-9])([0-9])$" "\\1.\\2.\\3" mujoco_version
    "${mujoco_version}")
  set(mujoco_FOUND TRUE)
endif()
lantern_peer(mujoco "${mujoco_version} (double)" FOUND ${mujoco_FOUND}
  LIBRARIES ${LANTERN_MUJOCO})

# A packer of textures, one header: optimized in any build, as ours is in a release.
if(EXISTS ${LANTERN_STB_DIR}/stb_rect_pack.h)
  file(STRINGS ${LANTERN_STB_DIR}/stb_rect_pack.h stb_version REGEX "^// stb_rect_pack.h - v")
  string(REGEX REPLACE ".*v([0-9.]+).*" "\\1" stb_version "${stb_version}")
  set(stb_FOUND TRUE)
endif()
lantern_peer(atlas_stb "${stb_version}" FOUND ${stb_FOUND} INCLUDES ${LANTERN_STB_DIR}
  OPTIONS -O3 -DNDEBUG)
# Libraries of boxes. Two of them are headers alone, so what makes them quick is set here: optimized
# as far as it goes, without their own checks, in any build. Their modules count their own calls of
# operator new.
set(quick -O3 -DNDEBUG)
set(own_new -Wl,-Bsymbolic)
lantern_peer(boxes_bullet "${bullet_single_VERSION} (single)" FOUND ${bullet_single_FOUND}
  INCLUDES ${bullet_single_INCLUDE_DIRS} LIBRARIES ${bullet_single_LINK_LIBRARIES}
  OPTIONS ${quick})
lantern_peer(boxes_box2d "${box2d_VERSION} (single)" FOUND ${box2d_FOUND}
  LIBRARIES ${box2d_LINK_LIBRARIES} OPTIONS ${quick})
if(LANTERN_BOOST_DIR)
  file(STRINGS ${LANTERN_BOOST_DIR}/boost/version.hpp boost_version REGEX "BOOST_LIB_VERSION \"")
  string(REGEX REPLACE ".*\"([0-9]+)_([0-9]+).*" "\\1.\\2" boost_version "${boost_version}")
  set(boost_headers_FOUND TRUE)
endif()
lantern_peer(boxes_boost "${boost_version} (double)" FOUND ${boost_headers_FOUND}
  INCLUDES ${LANTERN_BOOST_DIR} LIBRARIES ${own_new} OPTIONS ${quick})
if(LANTERN_CGAL_DIR AND LANTERN_BOOST_DIR)
  file(STRINGS ${LANTERN_CGAL_DIR}/CGAL/version.h cgal_version REGEX "CGAL_VERSION [0-9]")
  string(REGEX REPLACE ".* ([0-9.]+)$" "\\1" cgal_version "${cgal_version}")
  set(cgal_headers_FOUND TRUE)
endif()
lantern_peer(boxes_cgal "${cgal_version} (double)" FOUND ${cgal_headers_FOUND}
  INCLUDES ${LANTERN_CGAL_DIR} LIBRARIES ${own_new} OPTIONS ${quick} -DCGAL_NDEBUG)
add_dependencies(lab lantern_peers)
