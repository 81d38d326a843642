#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "render/compare.hpp"
#include "render/png.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPixelBytes = 1u << 30;

Image load(const fs::path& path) {
  const auto image = decode_png(read_file(path, kMostPixelBytes));
  if (!image) throw IoError(fmt::format("'{}' is no PNG image, or it is damaged", path.string()));
  return *image;
}

struct Result {
  std::string name;
  bool equal = false;
  std::string finding;
};

Result compare_files(const fs::path& expected, const fs::path& actual, const fs::path& picture,
                     const CompareOptions& o) {
  Result result{actual.string(), false, {}};
  const Image a = load(expected);
  const Image b = load(actual);
  const Comparison c = compare(a, b, o.tolerance);
  const double allowed = o.fraction * static_cast<double>(a.width) * a.height;
  result.equal = c.same_size && static_cast<double>(c.differing) <= allowed;
  result.finding = c.same_size ? fmt::format("{} {}, at most by {}", counted(c.differing, "pixel"),
                                             c.differing == 1 ? "differs" : "differ",
                                             counted(c.largest, "level"))
                               : fmt::format("expected {} x {} pixels, found {} x {}", a.width,
                                             a.height, b.width, b.height);
  if (!result.equal && !picture.empty()) {
    if (picture.has_parent_path()) make_folder(picture.parent_path());
    write_file(picture, encode_png(difference_picture(a, b, o.tolerance), PngEffort::fast, {}, 0));
  }
  return result;
}

std::set<std::string> pictures_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".png")
      names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

// Every picture of either folder; one that stands only in one of them differs.
std::vector<Result> compare_folders(const CompareOptions& o) {
  const std::set<std::string> expected = pictures_in(o.expected);
  const std::set<std::string> actual = pictures_in(o.actual);
  std::set<std::string> all = expected;
  all.insert(actual.begin(), actual.end());
  if (all.empty()) throw UsageError("there are no PNG files in these folders");
  std::vector<Result> results;
  for (const std::string& name : all) {
    if (!actual.contains(name))
      results.push_back({name, false, "is missing"});
    else if (!expected.contains(name))
      results.push_back({name, false, "was not expected"});
    else
      results.push_back(compare_files(fs::path(o.expected) / name, fs::path(o.actual) / name,
                                      o.output.empty() ? fs::path() : fs::path(o.output) / name,
                                      o));
  }
  return results;
}

}  // namespace

int compare_command(const CompareOptions& options) {
  if (!std::isfinite(options.fraction)) throw UsageError("--fraction must be a number from 0 to 1");
  std::error_code error;
  const bool folders = fs::is_directory(options.expected, error);
  if (folders != fs::is_directory(options.actual, error))
    throw UsageError("compare two files, or two folders");
  const std::vector<Result> results =
      folders
          ? compare_folders(options)
          : std::vector{compare_files(options.expected, options.actual, options.output, options)};
  const auto different = std::ranges::count_if(results, [](const Result& r) { return !r.equal; });
  JsonWriter json = answer_of("compare");
  json.line().member("equal", different == 0).line().key("files").begin_array();
  for (const Result& r : results) {
    json.line().begin_object().member("name", r.name).member("equal", r.equal);
    json.member("finding", r.finding).end_object();
    if (!options.json && (!r.equal || !folders))
      say(fmt::format("{}: {}; {}", r.name, r.equal ? "equal" : "different", r.finding));
  }
  json.line().end_array().line().end_object();
  if (options.json) answer(json.text());
  if (folders && !options.json)
    say(fmt::format("{} of {} differ", different, counted(results.size(), "picture")));
  return different == 0 ? kGood : kFailed;
}

}  // namespace lantern::app
