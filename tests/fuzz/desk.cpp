#include "fuzz/desk.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/mman.h>

#include "base/hash.hpp"
#include "language/language.hpp"

namespace lantern::fuzz {

bool Desk::tell(std::string_view kind, std::string_view line) {
  const std::uint64_t hash = Hash().add(kind).value();
  for (Told& place : told) {
    if (place.times > 0 && place.kind != hash) continue;
    place.kind = hash;
    if (place.times++ > 0) return false;
    std::memcpy(place.line.data(), line.data(), std::min(line.size(), place.line.size() - 1));
    return true;
  }
  return false;
}

Desk& shared_desk() {
  void* memory =
      ::mmap(nullptr, sizeof(Desk), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory to share");
  return *new (memory) Desk;
}

const std::vector<std::string>& all_uses() {
  static const std::vector<std::string> uses = [] {
    std::vector<std::string> all;
    const auto add = [&](const TableDoc& table) {
      for (const KeyDoc& key : table.keys) {
        all.push_back(fmt::format("{}.{}", table.name, key.key));
        if (key.type == KeyType::choice)
          for (const std::string_view choice : key.choices)
            all.push_back(fmt::format("{}.{} = {}", table.name, key.key, choice));
      }
    };
    for (const TableDoc& table : language_tables())
      if (table.name != "step") add(table);  // its keys are those of every verb
    for (const TableDoc& verb : language_verbs()) {
      add(verb);
      all.push_back(fmt::format("do = {}", verb.name));
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }();
  return uses;
}

}  // namespace lantern::fuzz
