// The parts that the language's list of tables is put together from, each in a file of its own.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "scenario/language.hpp"

namespace lantern {

TableDoc world_table();
TableDoc structure_table();
TableDoc planes_table();
TableDoc body_table();
TableDoc pattern_table();
TableDoc spring_table();
TableDoc joint_table();
TableDoc level_table();
TableDoc chart_table();
TableDoc problem_table();
TableDoc atlas_table();
TableDoc texture_table();
TableDoc texture_pattern_table();
TableDoc expect_table();

// Those of a table for a body or a pattern: `own` and what both have.
std::vector<KeyDoc> body_keys(std::vector<KeyDoc> own);

// The keys that several verbs have.
KeyDoc body_key();  // read by the verb, as is "bodies"
KeyDoc bodies_key();
KeyDoc pace_key();  // of a verb that can be watched while it works, as is "events"
KeyDoc events_key(std::initializer_list<std::string_view> names);

}  // namespace lantern
