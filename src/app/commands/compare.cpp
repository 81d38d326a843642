#include "render/compare.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/kept_files.hpp"
#include "app/output/sinks.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "render/png.hpp"

namespace lantern::app {
namespace {

struct CompareOptions {
  std::string expected, actual;
  std::string output;  // where the difference picture goes; empty for nowhere
  Allowance allowance;
  bool json = false;
};

Options compare_options(CompareOptions& o) {
  return {{"EXPECTED", &o.expected, "picture, facts or folder", {.required = true}},
          {"ACTUAL", &o.actual, "picture, facts or folder", {.required = true}},
          {"-o,--output", &o.output,
           "where the difference picture goes (a folder when folders are compared)",
           OptionTraits{.value = "PATH"}},
          tolerance_option(o.allowance.tolerance),
          fraction_option(o.allowance.fraction),
          json_option(o.json)};
}

struct Result {
  std::string name;
  bool equal = false;
  std::string finding;
};

std::string bytes_of(const fs::path& path) {
  constexpr std::size_t kMostFileBytes = 1u << 30;
  return read_input(path, kMostFileBytes);
}

Image image_of(const fs::path& path, std::string_view bytes) {
  auto image = decode_png(bytes);
  if (!image) throw IoError("'{}' is no PNG image, or it is damaged", path.string());
  return *std::move(image);
}

// The first line in which they differ.
std::string first_line(std::string_view expected, std::string_view actual) {
  const auto differ = std::ranges::mismatch(expected, actual);
  return fmt::format("line {} differs first", 1 + std::count(expected.begin(), differ.in1, '\n'));
}

// Where a difference picture goes; asked only where there is one. Empty: it goes nowhere.
using Picture = std::function<FilePlace()>;

// Of two files of one kind, which the second one's name tells.
Result compare_files(const fs::path& expected, const fs::path& actual, const CompareOptions& o,
                     const Picture& picture) {
  const std::string before = bytes_of(expected), now = bytes_of(actual);
  const std::string kind = actual.extension().string();
  Result result{actual.string(), true, "same bytes"};
  if (before == now && (kind == ".svg" || kind == ".json")) return result;
  if (kind == ".svg") {
    const auto a = before_seal(FileKind::svg, before), b = before_seal(FileKind::svg, now);
    result.equal = a == b;
    result.finding = result.equal ? "made from something else" : first_line(a, b);
  } else if (kind == ".json") {
    const auto compared = compare_facts(before, now);
    for (const auto& [path, bytes] : {std::pair{&expected, &before}, std::pair{&actual, &now}})
      if (!compared && !are_facts(*bytes))
        throw IoError("'{}' is no JSON object, or it is damaged", path->string());
    result.equal = compared->total == 0;
    result.finding = result.equal ? "the same facts" : finding(*compared);
  } else {
    const Image a = image_of(expected, before), b = image_of(actual, now);
    const Comparison compared = compare(a, b, o.allowance.tolerance);
    result.equal = passes(compared, a, o.allowance);
    result.finding = finding(compared);
    if (!result.equal && picture)
      write_file(picture(), encode_png(difference_picture(a, b, o.allowance.tolerance),
                                       PngEffort::fast, {}, 0));
  }
  return result;
}

// Pictures and facts; not the lists of how a folder was made.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string kind = entry.path().extension().string();
    if (entry.path().filename() == kManifest) continue;
    if (kind == ".png" || kind == ".svg" || kind == ".json")
      names.insert(entry.path().lexically_relative(folder).string());
  }
  return names;
}

// No difference picture takes the place of a file that is yet to be compared.
void require_apart(const CompareOptions& o, std::set<std::string> names) {
  std::erase_if(names, [](const std::string& name) { return !name.ends_with(".png"); });
  for (const std::string& folder : {o.expected, o.actual})
    for (const std::string& name : names) add_input(fs::path(folder) / name);
  for (const std::string& name : names) require_free(fs::path(o.output) / name);
}

// Every file of either folder; one that stands only in one of them differs.
std::vector<Result> compare_folders(const CompareOptions& o) {
  const fs::path expected_folder = o.expected, actual_folder = o.actual;
  const std::set<std::string> expected = files_in(expected_folder);
  const std::set<std::string> actual = files_in(actual_folder);
  std::set<std::string> all = expected;
  all.insert(actual.begin(), actual.end());
  if (all.empty()) throw UsageError("there are no PNG, SVG or JSON files in these folders");
  if (!o.output.empty()) require_apart(o, all);
  std::vector<Result> results;
  for (const std::string& name : all) {
    if (!actual.contains(name)) {
      results.push_back({name, false, "is missing"});
    } else if (!expected.contains(name)) {
      results.push_back({name, false, "was not expected"});
    } else {
      Picture picture;
      if (!o.output.empty())
        picture = [&] { return make_place(fs::path(o.output) / name, o.output); };
      results.push_back(compare_files(expected_folder / name, actual_folder / name, o, picture));
      results.back().name = name;
    }
  }
  return results;
}

std::vector<Result> compare_two_files(const CompareOptions& o) {
  const fs::path a = o.expected, b = o.actual;
  const auto is_text = [](const fs::path& path) {
    return path.extension() == ".svg" || path.extension() == ".json";
  };
  if ((is_text(a) || is_text(b)) && a.extension() != b.extension())
    throw UsageError("'{}' and '{}' are files of two kinds", o.expected, o.actual);
  Picture picture;
  if (!o.output.empty()) picture = [&] { return make_place(o.output, folder_of(o.output)); };
  return {compare_files(a, b, o, picture)};
}

int compare_paths(const CompareOptions& options) {
  std::error_code error;
  for (const std::string& input : {options.expected, options.actual}) {
    if (!fs::exists(input, error)) throw IoError("there is no '{}'", input);
    if (!options.output.empty() && fs::equivalent(input, options.output, error))
      throw UsageError("-o {}: that is what is compared; name another place for the difference",
                       options.output);
  }
  const bool folders = fs::is_directory(options.expected, error);
  if (folders != fs::is_directory(options.actual, error))
    throw UsageError("compare two files, or two folders");
  const std::vector<Result> results =
      folders ? compare_folders(options) : compare_two_files(options);
  const auto different = std::ranges::count_if(results, [](const Result& r) { return !r.equal; });
  JsonWriter json = answer_of("compare");
  json.line().member("equal", different == 0).line().key("files").begin_array();
  for (const Result& r : results) {
    json.line().object("name", r.name, "equal", r.equal, "finding", r.finding);
    if (!r.equal)
      complain(fmt::format("{}: different; {}", r.name, r.finding));
    else if (!options.json && !folders)
      say(fmt::format("{}: equal; {}", r.name, r.finding));
  }
  json.line().end_array().line().end_object();
  if (options.json) answer(json.text());
  if (folders && !options.json)
    say(fmt::format("{} of {} differ", different, counted(results.size(), "file")));
  return different == 0 ? kGood : kFailed;
}

}  // namespace

std::vector<Command> compare_commands() {
  return {command("compare", "Compare two PNG, SVG or JSON files, or two folders of them",
                  compare_paths, compare_options)};
}

}  // namespace lantern::app
