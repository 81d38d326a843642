// The members of a JSON file that Lantern keeps for itself, and that anybody may have written.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scenario/scenario_name.hpp"

namespace lantern::app {

// A file that is not as Lantern writes it is refused as a whole, for the first member that is
// otherwise: "frames[3].file is \"../x\": it is \"pong_0003.png\"".
class RefusedFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An object of the file. Every call names a member, says what it must be, and throws RefusedFile
// for one that is missing or anything else.
class JsonMembers {
 public:
  // The whole file. Throws RefusedFile unless it is one JSON object.
  explicit JsonMembers(std::string_view text);

  bool has(const char* member) const { return json_->contains(member); }
  std::string text(const char* member) const;
  std::vector<std::string> texts(const char* member) const;
  double number(const char* member) const;
  bool flag(const char* member) const;
  std::uint64_t whole(const char* member, std::uint64_t least, std::uint64_t most) const;
  std::uint64_t hash(const char* member) const;  // of 16 hexadecimal digits
  ScenarioName scenario_name(const char* member) const;
  std::string picture_size(const char* member) const;  // as --size takes it, "1600x900"
  // Exactly this text.
  void is(const char* member, std::string_view text) const;
  // One of these words, by what it stands for.
  template <class Value>
  Value word(const char* member, std::span<const std::pair<std::string_view, Value>> words) const {
    const std::string found = text(member);
    std::string known;
    for (const auto& [word, value] : words) {
      if (found == word) return value;
      known += (known.empty() ? "" : ", ") + std::string(word);
    }
    refuse(member, "it is one of " + known);
  }
  // The object of this name, and the objects of a list.
  JsonMembers object(const char* member) const;
  std::vector<JsonMembers> objects(const char* member) const;
  std::vector<std::string> names() const;  // of all members

  // That the member is something else than it must be.
  [[noreturn]] void refuse(const char* member, std::string_view must) const;

 private:
  // A part of the whole, which lives as long as any part of it is used.
  JsonMembers(const JsonMembers& whole, const nlohmann::json& part, std::string place)
      : json_(whole.json_, &part), place_(std::move(place)) {}
  const nlohmann::json& at(const char* member) const;

  std::shared_ptr<const nlohmann::json> json_;
  std::string place_;  // "frames[3]."
};

// That a file is as Lantern writes what was read of it, to the byte: no member more, none twice.
// Throws RefusedFile with the first line that is otherwise.
void require_as_written(std::string_view file, std::string_view written);

}  // namespace lantern::app
