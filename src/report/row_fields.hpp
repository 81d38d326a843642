// The list of a row's fields, and of the circumstances': what CSV and JSON hold, and what is read
// back from JSON.
#pragma once

#include <type_traits>

#include "measure/records.hpp"

namespace lantern {

// `R` is Row or const Row.
template <class R, class Visit>
requires std::same_as<std::remove_const_t<R>, Row>
void each_field(R& row, Visit&& visit) {
  visit(Field("problem"), row.problem);
  visit(Field("family"), row.family);
  visit(Field("variant"), row.variant);
  visit(Field("file"), row.file);
  visit(Field("text_hash"), Hashed(row.text_hash));
  visit(Field("method"), row.method);
  visit(Field("version"), row.version);
  visit(Field("step"), row.step);
  visit(Field("status"), row.status);
  visit(Field("reference"), row.reference);
  visit(Field("reference_error"), row.reference_error);
  visit(Field("reason"), row.reason);
  visit(Field("norms"), row.norms);
  visit(Field("energy", "drift_energy", "drift"), row.drift.energy);
  visit(Field("momentum", "drift_momentum", "drift"), row.drift.momentum);
  visit(Field("angular_momentum", "drift_angular_momentum", "drift"), row.drift.angular_momentum);
  visit(Field("penetration"), row.penetration);
  each_timing(row.timing, "timing", "spread", "seconds_spread", visit);
  visit(Field("steps", "steps", "counted"), row.counted.steps);
  visit(Field("force_evaluations", "force_evaluations", "counted"), row.counted.force_evaluations);
  visit(Field("constraint_rows", "constraint_rows", "counted"), row.counted.constraint_rows);
  visit(Field("pair_tests", "pair_tests", "counted"), row.counted.pair_tests);
  visit(Field("hash"), Hashed(row.hash));
}

template <class C, class Visit>
requires std::same_as<std::remove_const_t<C>, Circumstances>
void each_field(C& c, Visit&& visit) {
  visit(Field("version"), c.version);
  visit(Field("sources"), c.sources);
  visit(Field("compiler"), c.compiler);
  visit(Field("flags"), c.flags);
  visit(Field("processor"), c.processor);
  visit(Field("seed"), c.seed);
  visit(Field("effort"), c.effort);
}

}  // namespace lantern
