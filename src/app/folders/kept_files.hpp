// Files that Lantern keeps for later runs: nothing is written over them, and they are read as if a
// stranger had written them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "language/scenario.hpp"

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
void require_free(const fs::path& file);

// A file that is not as Lantern writes it is refused as a whole, for the first member that is
// otherwise: "frames[3].file is \"../x\": it is \"pong_0003.png\"".
class RefusedFile : public Told<std::runtime_error> {
 public:
  using Told::Told;
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
