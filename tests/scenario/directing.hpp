// Helpers of the tests that run scenarios.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "run/director.hpp"

namespace lantern::run {

// Every frame of a run.
std::vector<Frame> frames_of(const Scenario& scenario, Pace pace = Pace::step);

// Of a scenario that comes with Lantern, by its name.
std::vector<Frame> frames_of(const std::string& name, Pace pace = Pace::step);

Scenario shipped(const std::string& name);
std::vector<std::string> all_scenarios();
std::vector<std::string> all_files();  // scenarios and problems, by names for `shipped`

// What a test of one of `all_files` is called.
std::string test_name_of_file(const testing::TestParamInfo<std::string>& file);

// The first frame of this event, the node of this label, the body of this name; the test fails if
// there is none.
const Frame& at(const std::vector<Frame>& frames, const std::string& event);
const FrameNode& node(const Frame& frame, const std::string& label);
const FrameBody& body(const Frame& frame, const std::string& name);

using Names = std::set<std::string>;
Names bodies_in(const Frame& frame, const std::string& label);

// In the order of the list.
std::vector<std::string> names(const Frame& frame, const std::vector<BodyId>& ids);

// Of where the bodies are and how they move, not of the structure; by bits.
std::uint64_t motion_hash(const Frame& frame);

// "title", then a world with these keys, then `rest`.
std::string world_text(const std::string& keys, const std::string& rest);

}  // namespace lantern::run
