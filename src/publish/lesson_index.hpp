// The page that lists the lessons of a folder.
#pragma once

#include <string>

#include "base/file.hpp"

namespace lantern::publish {

// index.html of a folder: each lesson page that stands in it, in the order of the lecture, those
// without a place there behind the others by name, with its first picture, its idea, how many steps
// it has and what is to be seen before. Made from those pages alone, so that it is the same
// whichever of them were written last. Throws IoError if the folder or a page cannot be read.
std::string lesson_index(const Folder& folder);

// Writes it. False, and nothing is touched, if an index.html stands there that is not of this kind.
// Throws IoError.
bool write_lesson_index(const Folder& folder);

}  // namespace lantern::publish
