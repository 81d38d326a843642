// What Lantern keeps in folders, and what the user has given to be read: no output is written over
// it.
#pragma once

#include <filesystem>

#include "base/file.hpp"

namespace lantern::app {

// For what a folder is kept: the frames of a run, golden frames, a part of a run, or reports.
enum class KeptFor { frames, goldens, shard, reports };

// Throws UsageError if the folder is kept for anything else: its files would be lost. A list that
// is empty or cannot be read, as a link, may be Lantern's.
void require_kept_for(KeptFor wanted, const Folder& folder);

// Is there something called as a list of Lantern's, kManifest say, that is none?
bool is_foreign(const Folder& folder, const char* list);

// For each file that an option names: -o, --report, --junit. Throws UsageError if that is what this
// run has read, or is called as what Lantern keeps: a manifest, a list of golden frames, the record
// of a part, a measurement, a frame or its facts beside one of these, or a table or page beside a
// measurement. Nor must it be a scenario by its name, a folder, a device or a pipe.
void require_free(const std::filesystem::path& file);

}  // namespace lantern::app
