# Writes HEADER with the version and, as CONSTANT, one hash over all sources and shaders in order of
# their paths, but for those whose path is like WITHOUT.
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/src/*.?pp ${ROOT}/shaders/*)
list(SORT files)
if(WITHOUT)
  list(FILTER files EXCLUDE REGEX "${WITHOUT}")
endif()
set(all "")
foreach(path ${files})
  file(SHA256 ${ROOT}/${path} hash)
  string(APPEND all "${path} ${hash}\n")
endforeach()
string(SHA256 all "${all}")
string(SUBSTRING ${all} 0 16 all)
set(mark "")
if(CONSTANT STREQUAL kSourceHash)
  set(mark "// Stands in the engine of these sources for live pages, and tells it from others.
inline constexpr std::string_view kEngineMark = \"lantern-engine ${VERSION} ${all}\";
")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT [[#pragma once
#include <string_view>
namespace lantern {
inline constexpr std::string_view kVersion = "@VERSION@";
// Two builds with the same hash draw the same frames.
inline constexpr std::string_view @CONSTANT@ = "@all@";
@mark@}  // namespace lantern
]] @ONLY)
