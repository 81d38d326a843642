# With CMAKE_UNITY_BUILD, as in the builds of the script `run`, several sources are compiled at once,
# and the headers that most of them read are parsed once, not 300 times: headers of the language and
# of packages only, never our own. The compiler then does not notice where an #include is missing. A
# plain build (cmake -S . -B ...) does neither: who changes code builds so, and sees.

# lantern_headers(TARGET LINKS ... OPTIONS ... HEADERS ...): TARGET is nothing but these headers,
# precompiled with these compile options.
function(lantern_headers target)
  cmake_parse_arguments(ARG "" "" "LINKS;OPTIONS;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/embedded/${target}.cpp CONTENT "")
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/embedded/${target}.cpp)
  target_link_libraries(${target} PRIVATE ${ARG_LINKS})
  target_compile_options(${target} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
endfunction()

# lantern_precompile(TARGET FROM HEADERS): in a unity build the sources of TARGET start from HEADERS.
function(lantern_precompile target from headers)
  if(CMAKE_UNITY_BUILD)
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()

set(common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numbers> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> <glm/gtc/quaternion.hpp> <glm/matrix.hpp>)
if(LANTERN_WEB)
  return()
endif()
lantern_headers(lantern_headers LINKS fmt::fmt glm::glm HEADERS ${common_headers})
