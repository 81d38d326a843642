// Without words of its own, the short search of the tests. Else
//   tests_fuzz --minutes M | --rounds N  [--seed S] [--first N] [--corpus DIR] [--keep DIR]
//              [--findings DIR]     searches
//   tests_fuzz --distil FROM TO     copies the fewest files that reach the most: a new corpus
//   tests_fuzz --replay FILE...     tries these files in this very process, for a debugger
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "fuzz/search.hpp"
#include "fuzz/trial.hpp"

namespace lantern::fuzz {
namespace {

int replay(const std::vector<std::string>& files) {
  using namespace std::chrono_literals;
  Watch watch(1h, 1h, [] {});
  Trial trial(
      watch, [](Stage stage) { fmt::print("  {}\n", to_string(stage)); }, [](std::string_view) {});
  for (const std::string& file : files) {
    fmt::print("{}\n", file);
    Dice dice(1);
    const TrialResult result = trial.run(read_file(file, 1 << 22), dice);
    for (const Diagnostic& mistake : result.mistakes) fmt::print("{}\n", to_string(mistake));
    fmt::print("  {}, {} frames, energy grows by {:.3g}\n",
               result.ran    ? "ran"
               : result.good ? "good"
                             : "not good",
               result.frames, result.energy_growth);
  }
  return 0;
}

// The one that adds most for its size, again and again.
int distil(const std::filesystem::path& from, const std::filesystem::path& to) {
  using namespace std::chrono_literals;
  constexpr std::size_t kMostFiles = 180;
  struct File {
    std::filesystem::path path;
    std::string text;
    std::set<std::uint64_t> features;
  };
  Watch watch(1s, 1h, [] {});
  Trial trial(
      watch, [](Stage) {}, [](std::string_view) {});
  std::vector<File> files;
  for (const auto& entry : std::filesystem::directory_iterator(from)) {
    File file{entry.path(), read_file(entry.path(), 1 << 22), {}};
    Dice dice(1);
    file.features = trial.run(file.text, dice).features;
    files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, [](const File& f) { return std::pair(f.text.size(), f.path); });
  make_folder(to);
  std::set<std::uint64_t> reached;
  const auto gain = [&](const File& file) {
    const auto fresh = std::ranges::count_if(
        file.features, [&](std::uint64_t feature) { return !reached.contains(feature); });
    return static_cast<double>(fresh) / static_cast<double>(file.text.size() + 500);
  };
  std::size_t kept = 0;
  for (; kept < kMostFiles && !files.empty(); ++kept) {
    const auto best = std::ranges::max_element(files, {}, gain);
    if (gain(*best) == 0) break;
    reached.insert(best->features.begin(), best->features.end());
    write_file(to / best->path.filename(), best->text);
    files.erase(best);
  }
  fmt::print("{} files reach {} things\n", kept, reached.size());
  return 0;
}

int search_and_tell(const std::vector<std::string>& words) {
  SearchOptions options;
  options.corpus = LANTERN_ROOT "/tests/fuzz/corpus";
  options.findings = "fuzz-findings";
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    const std::string& value = words[i + 1];
    if (words[i] == "--minutes")
      options.minutes = std::stod(value);
    else if (words[i] == "--rounds")
      options.rounds = std::stoull(value);
    else if (words[i] == "--seed")
      options.seed = std::stoull(value);
    else if (words[i] == "--first")
      options.first = std::stoull(value);
    else if (words[i] == "--corpus")
      options.corpus = value;
    else if (words[i] == "--keep")
      options.keep = value;
    else if (words[i] == "--findings")
      options.findings = value;
    else
      return fmt::print(stderr, "tests_fuzz: there is no option '{}'\n", words[i]), 2;
  }
  if (options.minutes <= 0 && options.rounds == 0)
    return fmt::print(stderr, "tests_fuzz: give --minutes or --rounds\n"), 2;
  const SearchReport report = search(options);
  fmt::print("{}", to_text(report));
  return report.findings() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace lantern::fuzz

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words[0] == "--replay")
    return lantern::fuzz::replay({words.begin() + 1, words.end()});
  if (words.size() == 3 && words[0] == "--distil") return lantern::fuzz::distil(words[1], words[2]);
  if (!words.empty() && !words[0].starts_with("--gtest"))
    return lantern::fuzz::search_and_tell(words);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
