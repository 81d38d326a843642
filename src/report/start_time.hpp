// How long a new process takes to a context, and to its first frame.
#pragma once

#include <filesystem>

#include "report/bench_frames.hpp"

namespace lantern {

// `rounds` new processes for each of the two times. Writes one file into `folder` and removes it.
// Throws BackendError if a process fails.
StartTimes measure_start(const DrawList& list, const std::filesystem::path& folder,
                         const FrameBenchConfig& config, bool shaders_known);

// The middle one, or the mean of the two in the middle; not of an empty list.
double median(std::vector<double> values);

}  // namespace lantern
