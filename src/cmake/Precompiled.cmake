# With LANTERN_PCH, the headers that most sources read are parsed once, not 300 times: headers of the
# language and of packages only, never our own. Such a build does not notice a missing #include of
# these, so it is off by default: every build without the option is the check, among them the
# release build of `./run`.

# lantern_headers(TARGET LINKS ... HEADERS ...): TARGET holds nothing but the precompiled headers.
function(lantern_headers target)
  cmake_parse_arguments(ARG "" "" "LINKS;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/embedded/${target}.cpp CONTENT "")
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/embedded/${target}.cpp)
  target_link_libraries(${target} PRIVATE ${ARG_LINKS})
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
endfunction()

# lantern_precompiled(TARGET HEADERS): the sources of TARGET start from those of lantern_headers.
function(lantern_precompiled target headers)
  if(LANTERN_PCH)
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()

set(common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numbers> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> <glm/gtc/quaternion.hpp> <glm/matrix.hpp>)
lantern_headers(lantern_headers LINKS fmt::fmt glm::glm HEADERS ${common_headers})
