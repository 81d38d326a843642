// When there can be a panel: questions to a file, which panels' entries ask.
#pragma once

#include "language/display.hpp"

namespace lantern::language {

struct Compare;
struct DrawScreen;
struct See;
struct Separate;

bool has_world(const Draft& draft);
bool has_bodies_or_level(const Draft& draft);
bool has_two_flat_bodies(const Draft& draft);
bool has_structure(const Draft& draft);  // at some time
bool has_array(const Draft& draft);      // of a tree's leaves
bool has_pool(const Draft& draft);       // of a tree's nodes
bool has_tree(const Draft& draft);       // or a structure, a level, an atlas
bool has_nodes(const Draft& draft);      // of one that is a tree
bool has_atlas(const Draft& draft);
bool has_chart(const Draft& draft);
bool has_code(const Draft& draft);
bool remembers_collisions(const Draft& draft);
bool runs_with_structure(const Draft& draft);
bool runs_with_what_holds(const Draft& draft);  // bodies together: contacts, springs, joints
bool sees_in_level(const Draft& draft);

// A verb of this kind is somewhere in the script: Compare, DrawScreen, See, Separate.
template <class V>
bool some_step(const Draft& draft);

// An example of the reference; with that of a verb behind it; with a step that runs.
std::string example_of(std::string_view scenario);
std::string example_with(std::string_view scenario, std::string_view verb);
std::string running_example();

}  // namespace lantern::language
