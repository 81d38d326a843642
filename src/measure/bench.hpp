// What all benches have in common: who takes part, what was found, and who was asked for.
#pragma once

#include "base/suggest.hpp"
#include "measure/row.hpp"

namespace lantern::measure {

// Who takes part in a bench.
struct Contestant {
  std::string name, version;  // no version: ours
  std::string how;            // a sentence: what of it is run, and how; may be empty
  bool is_peer() const { return !version.empty(); }
};

// What a bench was asked for and has found. Config and circumstances are set beforehand; rows are
// added when all of a stage is done.
template <class ConfigOf, class RowOf>
struct BenchResult {
  ConfigOf config;
  Circumstances circumstances;
  std::string command;               // that asked for it
  std::vector<std::string> missing;  // peers that are not there: a line each
  std::vector<Contestant> contestants;
  std::vector<RowOf> rows;
};

// "Bullet" asks for all of its ways, "Bullet:10" for one. No names ask for all.
inline bool is_asked_for(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::ranges::any_of(names, [&](const std::string& asked) {
           return name == asked || name.starts_with(asked + ":");
         });
}

// Leaves only those that are asked for; `name_of` gives the name of one. Throws Refused for a name
// that is none: the line of `missing` that begins with it, or what there is.
template <class T, class NameOf>
void keep_asked_for(std::vector<T>& all, const std::vector<std::string>& names,
                    const std::vector<std::string>& missing, const NameOf& name_of) {
  for (const std::string& name : names) {
    if (std::ranges::any_of(all, [&](const T& one) { return is_asked_for({name}, name_of(one)); }))
      continue;
    for (const std::string& line : missing)
      if (line.starts_with(name + ":")) throw Refused(line);
    std::vector<std::string> there;
    for (const T& one : all) there.push_back(name_of(one));
    throw Refused(with_suggestion(fmt::format("there is no contestant '{}'", name), name,
                                  std::vector<std::string_view>(there.begin(), there.end()),
                                  there.size()));
  }
  std::erase_if(all, [&](const T& one) { return !is_asked_for(names, name_of(one)); });
}

}  // namespace lantern::measure
