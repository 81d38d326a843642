// The other engines that Lantern is measured beside. They are optional: what was not installed when
// Lantern was built is missing, and all else is the same.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "measure/simulation.hpp"

namespace lantern::measure {

// Loads their modules from the folder "peers" beside the program, or beside the program's folder.
// A line is added to `missing` for each engine that is not there: "Box2D: not built in; apt-get
// install libbox2d-dev and build again: ...". A module once loaded stays.
std::vector<std::unique_ptr<Solver>> load_peers(std::vector<std::string>& missing);

// The libraries of boxes that `bench pairs` measures beside: "CGAL 5.5.1 (double)". Lines are added
// to `missing` as above.
std::vector<std::string> box_peer_names(std::vector<std::string>& missing);

}  // namespace lantern::measure
