# Writes HEADER with the version and one hash over all sources and shaders, in order of their paths.
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/src/*.?pp ${ROOT}/shaders/*)
list(SORT files)
set(all "")
foreach(path ${files})
  file(SHA256 ${ROOT}/${path} hash)
  string(APPEND all "${path} ${hash}\n")
endforeach()
string(SHA256 all "${all}")
string(SUBSTRING ${all} 0 16 all)
file(CONFIGURE OUTPUT ${HEADER} CONTENT [[#pragma once
#include <string_view>
namespace lantern {
inline constexpr std::string_view kVersion = "@VERSION@";
// Two builds with the same hash draw the same frames.
inline constexpr std::string_view kSourceHash = "@all@";
}  // namespace lantern
]] @ONLY)
