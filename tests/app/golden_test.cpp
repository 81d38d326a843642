// Golden images of every scenario, small. All frames in step pace are compared by the hashes of
// their pictures' pixels and of their facts, not of what only says how a file was made. Pictures
// are kept of all frames of short sequences; of long ones of every twentieth frame and of the last,
// so that a difference can be looked at. Missing ones fail. After a wanted change, `./run golden`
// takes today's pictures as the expected ones.
#include <algorithm>
#include <cstdlib>
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

namespace lantern::test {
namespace {

namespace fs = std::filesystem;

const fs::path kGolden = repository("tests/golden");

bool setting() { return std::getenv("LANTERN_SET_GOLDEN") != nullptr; }

// Of a picture's pixels, or of facts without their seal.
std::string hash_of(const fs::path& file) {
  const std::string bytes = read_text(file);
  Hash hash;
  if (file.extension() == ".png") {
    const auto image = decode_png(bytes);
    if (!image) return "no picture";
    hash.add(std::uint64_t(image->width)).add(std::uint64_t(image->height));
    hash.add(
        std::string_view(reinterpret_cast<const char*>(image->rgba.data()), image->rgba.size()));
  } else {
    hash.add(std::string_view(bytes).substr(0, bytes.find(",\n\"made_from\"")));
  }
  return fmt::format("{:016x}", hash.value());
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
  const Comparison c = compare(expected, found, 0);
  return fmt::format("{} pixels of {} differ, at most by {} levels; look at {}/{}.difference.png",
                     c.differing, name, c.largest, folder.string(), name);
}

// `index` of `count` frames.
bool is_kept(std::size_t index, std::size_t count) {
  constexpr std::size_t kShort = 70, kEvery = 20;
  return count <= kShort || index % kEvery == 0 || index + 1 == count;
}

// A picture whose pixels are as before keeps its file.
void set_golden(const fs::path& expected, const fs::path& made, const Hashes& found,
                const std::set<std::string>& kept) {
  fs::create_directories(expected);
  for (const auto& entry : fs::directory_iterator(expected))
    if (!kept.contains(entry.path().filename())) fs::remove(entry.path());
  std::string lines;
  for (const auto& [file, hash] : found) {
    lines += file + " " + hash + "\n";
    const bool is_new = !fs::exists(expected / file) || hash_of(expected / file) != hash;
    if (kept.contains(file) && is_new)
      fs::copy_file(made / file, expected / file, fs::copy_options::overwrite_existing);
  }
  write_text(expected / "hashes.txt", lines);
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, FramesAreAsExpected) {
  const std::string name = GetParam();
  const fs::path expected = kGolden / name;
  const fs::path out = fresh_folder("golden-" + name);
  const Outcome o = shell("lantern render " + scenario(name) +
                          " --size 480x270 --png small --pace step -o " + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  Hashes found;
  std::vector<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(out / name))
    if (entry.path().filename() != "manifest.json")
      found[entry.path().filename()] = hash_of(entry.path());
  for (const auto& [file, hash] : found)
    if (fs::path(file).extension() == ".png") pictures.push_back(file);
  std::set<std::string> kept;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    if (is_kept(i, pictures.size())) kept.insert(pictures[i]);
  if (setting()) {
    set_golden(expected, out / name, found, kept);
    return;
  }
  const Hashes hashes = read_hashes(expected / "hashes.txt");
  ASSERT_FALSE(hashes.empty()) << "no golden images for " << name << "; see ./run golden";
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

}  // namespace
}  // namespace lantern::test
