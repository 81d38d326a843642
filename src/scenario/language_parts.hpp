// The parts that the language's list of tables is put together from, each in a file of its own.
#pragma once

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

// In the order of the enums.
std::vector<std::string_view> integrator_names();
std::vector<std::string_view> rotation_names();

// Verbs, each with its own keys only.
std::vector<TableDoc> body_verbs();
std::vector<TableDoc> time_verbs();
std::vector<TableDoc> structure_verbs();
std::vector<TableDoc> query_verbs();
std::vector<TableDoc> level_verbs();
std::vector<TableDoc> atlas_verbs();

// The keys of a verb that can be watched while it works.
KeyDoc pace_key();
KeyDoc events_key(std::vector<std::string_view> names);

}  // namespace lantern
