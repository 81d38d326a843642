# With LANTERN_PCH, the headers that most sources read are parsed once, not 300 times: headers of
# the language and of packages only, never our own. The compiler then does not notice where an
# #include of one of these is missing. So a plain build, such as that of `./run build`, has none:
# that is the check that each file includes what it uses.

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

# lantern_precompile(TARGET FOR WHICH FROM HEADERS): the sources of TARGET start from HEADERS where
# LANTERN_PCH names one of WHICH.
function(lantern_precompile target)
  cmake_parse_arguments(ARG "" "FROM" "FOR" ${ARGN})
  if(LANTERN_PCH IN_LIST ARG_FOR)
    target_precompile_headers(${target} REUSE_FROM ${ARG_FROM})
  endif()
endfunction()

set(common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numbers> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <fmt/format.h> <glm/gtc/quaternion.hpp> <glm/matrix.hpp>)
lantern_headers(lantern_headers LINKS fmt::fmt glm::glm HEADERS ${common_headers})
