// Helpers of the tests that read scenarios.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/scenario.hpp"

namespace lantern::run {

// The mistakes in a scenario text; none if it is good. The file is called ghosts.toml.
std::vector<Diagnostic> mistakes(const std::string& text);

// All of them as a user sees them, for a failed test's message.
std::string shown(const std::vector<Diagnostic>& diagnostics);

// The marks @ are taken out of `text`; exactly so many mistakes must be found, each at its mark,
// and the n-th must say `words[n]`.
void expect_mistakes(const std::string& text, const std::vector<std::string>& words);

// The good scenario of that text; fails the test if it is not good.
Scenario good(const std::string& text);

// A good scenario of a solid world that uses most of what a world can have.
extern const std::string_view kSolid;

// Steps in a row, each given by its keys.
std::string steps(const std::vector<std::string>& list);

// The texts of the scenarios that come with Lantern, and of the reference page's, and kSolid.
std::vector<std::string> good_texts();

std::string read_text(const std::string& path);

// Parts of many a test's scenario.
inline const std::string kTree = "[structure]\nkind = \"quadtree\"\n";
inline const std::string kShow = "[[step]]\ndo = \"show\"\n";

}  // namespace lantern::run
