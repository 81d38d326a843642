// What came of comparing frames with golden ones, as a page for a person and as JUnit's XML for a
// machine that builds.
#pragma once

#include <span>

#include "render/compare.hpp"
#include "rooms.hpp"

namespace lantern::publish {

// One frame.
struct GoldenCase {
  std::uint32_t frame = 0;
  std::string event;                  // the step's name, or what the algorithm did
  std::vector<std::string> findings;  // what differs, in a few words each; empty: as expected
  FactsComparison facts;
  bool picture_differs = false;
  // If so, as PNG files; empty where there is none, or none is to be shown.
  std::string expected, actual, difference;
};

// One scenario.
struct GoldenSuite {
  std::string scenario;               // or the file, if that cannot be read
  std::string file;                   // as the user named it
  std::string error;                  // why it could not be run to its end; empty if it was
  std::vector<std::string> findings;  // about all of its frames
  std::uint64_t unmet_count = 0;      // expectations of the scenario that do not hold
  std::vector<std::string> unmet;     // the first of them
  std::vector<GoldenCase> cases;      // of the frames compared, in order

  std::size_t differing() const;
  bool good() const;
  // Of the case that differs first; nothing if none does.
  const GoldenCase* first() const;
};

// "frame 7 (split)"
std::string name_of(const GoldenCase& one);

// "1 of 8 frames differs", "3 of 8 frames differ"
std::string differing_of(std::size_t differing, std::size_t frames);

// One page without network or scripts, light or dark as the reader has it. What differs first
// stands on top. Of very many frames the first 200 are shown, each picture that is there in them.
// `made_by` says which Lantern drew the actual pictures.
std::string golden_page(std::span<const GoldenSuite> suites, const std::string& made_by);

// A suite for each scenario with a case for each frame, one for its expectations if it has unmet
// ones, and one for what concerns all of its frames. As jenkinsci/xunit-plugin's junit-10.xsd has
// it, which GitLab and the usual GitHub actions read, too. No times: the same findings give the
// same bytes.
std::string golden_junit(std::span<const GoldenSuite> suites);

}  // namespace lantern::publish
