// golden.txt: which golden frames a folder holds, and what they were made with. A line a frame, so
// that a version control system shows and merges what changed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/file.hpp"

namespace lantern::app {

struct GoldenList {
  // Words as on the command line. Goldens can only be compared with frames that are made so.
  struct MadeWith {
    std::string version, size, theme, pace, facts;
    bool operator==(const MadeWith&) const = default;
  };
  struct Entry {
    std::string pixels;  // pixel_hash() of its picture
    std::string event;   // to name the frame if a run has none such any more
    bool operator==(const Entry&) const = default;
  };
  MadeWith made_with;
  std::map<std::uint32_t, Entry> frames;
  bool operator==(const GoldenList&) const = default;
};

inline constexpr const char* kGoldenList = "golden.txt";

// It is Lantern's, but cannot be read to its end: a conflict of a merge, or half of it.
class DamagedGoldens : public IoError {
 public:
  using IoError::IoError;
};

std::string to_text(const GoldenList& list);

// That of the folder; nothing if there is none. Throws DamagedGoldens; IoError if it cannot be
// read, is no golden.txt of Lantern's, or is that of a later Lantern.
std::optional<GoldenList> read_golden_list(const Folder& folder);

}  // namespace lantern::app
