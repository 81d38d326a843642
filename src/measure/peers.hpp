// The other engines that Lantern is measured beside. They are optional: what was not installed when
// Lantern was built is missing, and all else is the same.
#pragma once

#include "base/child.hpp"
#include "measure/simulation.hpp"

namespace lantern::measure {

// The modules of other libraries that Lantern is measured beside (src/peers), loaded when asked
// for.

struct PeerModule {
  const char* name;     // of the library
  const char* file;     // of the module
  const char* package;  // that it is built from
};

// From the folder "peers" beside the program, or beside the program's folder. Nothing, and a line
// in `missing`, if it is not there: "Box2D: not built in; apt-get install libbox2d-dev and build
// again: ...".
std::optional<Library> load_module(const PeerModule& module, std::vector<std::string>& missing);

// What the function `entry` of each module adds. A module once loaded stays.
template <class Peer>
std::vector<Peer> peers_of(std::span<const PeerModule> modules, const char* entry,
                           std::vector<std::string>& missing) {
  std::vector<Peer> peers;
  for (const PeerModule& module : modules) {
    const auto library = load_module(module, missing);
    if (!library) continue;
    void (*add)(std::vector<Peer>&) = nullptr;
    if (library->find(add, entry))
      add(peers);
    else
      missing.push_back(std::string(module.name) + ": cannot be loaded: " + library->problem());
  }
  return peers;
}

// Loads their modules from the folder "peers" beside the program, or beside the program's folder.
// A line is added to `missing` for each engine that is not there: "Box2D: not built in; apt-get
// install libbox2d-dev and build again: ...". A module once loaded stays.
std::vector<std::unique_ptr<Solver>> load_peers(std::vector<std::string>& missing);

// The libraries of boxes that `bench pairs` measures beside: "CGAL 5.5.1 (double)". Lines are added
// to `missing` as above.
std::vector<std::string> box_peer_names(std::vector<std::string>& missing);

}  // namespace lantern::measure
