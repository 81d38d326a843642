// Golden frames of every scenario, small, in step pace. All are compared by the hashes of their
// pictures' pixels and of their facts, not of what only says how a file was made. Of each sequence
// a few pictures are kept that a person can look at, and a difference is shown beside them. What is
// missing fails. After a wanted change, `./run golden` takes today's frames as the expected ones.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/process.hpp"
#include "base/hash.hpp"
#include "render/compare.hpp"
#include "render/png.hpp"
#include "rooms.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

const fs::path kGolden = repository("tests/golden");

bool setting() { return std::getenv("LANTERN_SET_GOLDEN") != nullptr; }

// Of a picture's pixels, or of facts without their seal.
std::string hash_of(const fs::path& file) {
  const std::string bytes = read_text(file);
  if (file.extension() == ".png") {
    const auto image = decode_png(bytes);
    return image ? pixel_hash(*image) : "no picture";
  }
  return fmt::format("{:016x}", Hash().add(before_seal(FileKind::json, bytes)).value());
}

// File name -> hash.
using Hashes = std::map<std::string, std::string>;

Hashes read_hashes(const fs::path& file) {
  Hashes hashes;
  std::istringstream lines(read_text(file));
  for (std::string name, hash; lines >> name >> hash;) hashes[name] = hash;
  return hashes;
}

// Writes expected, actual and difference beside each other where a person can look at them.
std::string explain(const std::string& name, const fs::path& actual, const Image& expected,
                    const Image& found) {
  const fs::path folder = fs::path(LANTERN_TEST_OUTPUT) / "golden-failures";
  fs::create_directories(folder);
  fs::copy_file(actual, folder / (name + ".actual.png"), fs::copy_options::overwrite_existing);
  write_text(folder / (name + ".difference.png"),
             encode_png(difference_picture(expected, found, 0), PngEffort::fast, {}, 0));
  return fmt::format("{}: {}; look at {}/{}.difference.png", name,
                     finding(compare(expected, found, 0)), folder.string(), name);
}

// Is the picture of frame `index` of `count` kept? So many of each sequence are, the first and the
// last among them, evenly spread.
bool is_kept(std::size_t index, std::size_t count) {
  constexpr std::size_t kKept = 6;
  for (std::size_t k = 0; k < kKept; ++k)
    if (index == k * (count - 1) / (kKept - 1)) return true;
  return false;
}

// The names of the pictures among these files that are kept.
std::set<std::string> kept_of(const Hashes& hashes) {
  std::vector<std::string> pictures;
  for (const auto& [file, hash] : hashes)
    if (file.ends_with(".png")) pictures.push_back(file);
  std::set<std::string> kept;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    if (is_kept(i, pictures.size())) kept.insert(pictures[i]);
  return kept;
}

// The golden frames of a scenario become those of the folder `made`; pictures that are not kept go.
// One whose pixels are as before keeps its file.
void set_golden(const fs::path& expected, const fs::path& made, const Hashes& found) {
  const std::set<std::string> kept = kept_of(found);
  fs::create_directories(expected);
  std::vector<fs::path> before;
  for (const auto& entry : fs::directory_iterator(expected)) before.push_back(entry.path());
  for (const fs::path& file : before)
    if (!kept.contains(file.filename())) fs::remove(file);
  std::string lines;
  for (const auto& [file, hash] : found) {
    lines += file + " " + hash + "\n";
    const bool is_new = !fs::exists(expected / file) || hash_of(expected / file) != hash;
    if (kept.contains(file) && is_new)
      fs::copy_file(made / file, expected / file, fs::copy_options::overwrite_existing);
  }
  write_text(expected / "hashes.txt", lines);
}

// Under sanitizers, where drawing takes long, the first frames; the release build draws them all.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kDrawn = 8;
#else
constexpr std::size_t kDrawn = std::numeric_limits<std::size_t>::max();
#endif

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, FramesAreAsExpected) {
  const std::string name = GetParam();
  const fs::path expected = kGolden / name;
  Hashes hashes = setting() ? Hashes() : read_hashes(expected / "hashes.txt");
  ASSERT_TRUE(setting() || !hashes.empty()) << "no golden frames of " << name << "; ./run golden";
  const std::set<std::string> kept = kept_of(hashes);
  std::string range;
  if (hashes.size() / 2 > kDrawn) {  // a picture and facts of each frame, in order
    range = fmt::format(" --frames -{}", kDrawn - 1);
    hashes.erase(std::next(hashes.begin(), static_cast<std::ptrdiff_t>(2 * kDrawn)), hashes.end());
  }
  const fs::path out = fresh_folder("golden-" + name);
  const Outcome o = shell("lantern render " + scenario(name) +
                          " --size 480x270 --png small --pace step -o " + out.string() + range);
  ASSERT_EQ(o.code, 0) << o.err;
  Hashes found;
  for (const auto& entry : fs::directory_iterator(out / name))
    if (entry.path().filename() != "manifest.json")
      found[entry.path().filename()] = hash_of(entry.path());
  if (setting()) return set_golden(expected, out / name, found);
  for (const auto& [file, hash] : hashes)
    EXPECT_TRUE(found.contains(file)) << file << " is expected, but was not made";
  for (const auto& [file, hash] : found) {
    ASSERT_TRUE(hashes.contains(file)) << file << " has no golden counterpart; see ./run golden";
    if (kept.contains(file)) {
      const auto a = decode_png(read_text(expected / file));
      const auto b = decode_png(read_text(out / name / file));
      ASSERT_TRUE(a && b) << file << " is no picture";
      EXPECT_EQ(*a, *b) << explain(file, out / name / file, *a, *b);
    }
    // Pixels first: they tell more.
    EXPECT_EQ(hash, hashes.at(file)) << file << " is not that of the golden run";
  }
}

std::vector<std::string> all_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(repository("scenarios")))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Golden, testing::ValuesIn(all_scenarios()),
                         [](const auto& each) { return each.param; });

// What a scenario that is gone has left.
TEST(GoldenFolders, BelongToScenarios) {
  const std::vector<std::string> names = all_scenarios();
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(kGolden)) folders.push_back(entry.path());
  for (const fs::path& folder : folders) {
    if (std::binary_search(names.begin(), names.end(), folder.filename().string())) continue;
    if (setting())
      fs::remove_all(folder);
    else
      ADD_FAILURE() << folder << " belongs to no scenario; see ./run golden";
  }
}

}  // namespace
}  // namespace lantern::app
