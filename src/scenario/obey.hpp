// What a verb does to the bodies of an engine, without frames.
#pragma once

#include "scenario/engine.hpp"

namespace lantern {

// Verbs that only show, ask or partition do nothing; `wait` neither: how long it lasts is for the
// caller to find out. A `run` takes steps until its time is over. Throws Refused as the engine
// does.
void obey(Engine& engine, const Verb& verb, double time_step);

}  // namespace lantern
