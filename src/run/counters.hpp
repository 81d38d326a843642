// What a run counts. Each file that counts has the rows of its counts, above the code.
#pragma once

namespace lantern::run {

// Lantern's own counts and measures are known from the start of a program that runs scenarios. One
// that only reads them knows them once it has asked this.
bool counts_are_known();

}  // namespace lantern::run
