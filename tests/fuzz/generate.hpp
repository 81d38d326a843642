// Scenarios that were never seen before: made from the language's tables, mended by the parser's
// own words, and spoilt again.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "fuzz/sees_all.hpp"
#include "fuzz/values.hpp"

namespace lantern::fuzz {

// A scenario that is mostly right as far as single keys go; what keys mean together is left to
// chance, and to mend().
Document made_scenario(Dice& dice);

// What the diagnostics complain of is taken out or written anew, what they miss is added; in
// later rounds more is taken out. False if nothing could be done.
bool mend(Document& document, std::vector<Diagnostic> diagnostics, int round, Dice& dice);

// Long runs made short and large patterns small, so that a thousand can be tried in a second.
void shrink(Document& document, Dice& dice);

// One edit that knows tables: a value, a key, a table, a name, a verb, the order of things. `other`
// is where parts are borrowed from.
void spoil(Document& document, const Document& other, Dice& dice);

// One edit of bytes.
void spoil_bytes(std::string& text, Dice& dice);

}  // namespace lantern::fuzz
