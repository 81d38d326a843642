#include "app/output/watch.hpp"

#include <chrono>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <sys/stat.h>

#include "app/commands/command.hpp"
#include "app/output/render_job.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"

namespace lantern::app {

namespace {

std::optional<std::uint64_t> hash_of(const std::string& file) try {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  return Hash().add(read_file(file, kMostBytes)).value();
} catch (const IoError&) {
  return std::nullopt;
}

constexpr const char* kScript = R"(<script>
(() => {{
  let known = null;
  const told = document.createElement("pre");
  told.id = "lantern-error";
  told.style = "position:fixed;z-index:99;inset:0 0 auto;max-height:60vh;overflow:auto;margin:0;padding:1rem;background:#8a1c1c;color:#fff;white-space:pre-wrap";
  window.lanternVersion = (version, error = "") => {{
    if (known !== null && known !== version) location.reload();
    known = version;
    told.textContent = error;
    error ? document.body.append(told) : told.remove();
  }};
  setInterval(() => {{
    const script = document.createElement("script");
    script.src = encodeURIComponent({}) + "?" + Date.now();
    script.onload = script.onerror = () => script.remove();
    document.head.append(script);
  }}, 500);
}})();
</script>
)";

constexpr std::string_view kCall = "lanternVersion(";

struct Version {
  FilePlace place;
  std::uint64_t version = 0;
  std::string bytes;
};

std::vector<Version>& written() {
  static std::vector<Version> versions;
  return versions;
}

std::string version_file(std::string_view page) { return fmt::format("{}.version.js", page); }

// What stands there; nothing if nothing does. Throws IoError for a link, a folder or a device.
std::optional<std::string> standing(const FilePlace& place) {
  constexpr std::size_t kMostBytes = 1000;  // of ours
  return place.folder.read(place.name, kMostBytes);
}

// In a script, "</script>" would end it wherever it stands.
std::string script_string(std::string_view text) {
  std::string quoted = json_string(text);
  for (std::size_t at = 0; (at = quoted.find('<', at)) != quoted.npos;)
    quoted.replace(at, 1, "\\u003c");
  return quoted;
}

std::string call_of(std::uint64_t version, const std::string& error) {
  return fmt::format("{}\"{:016x}\"{});\n", kCall, version,
                     error.empty() ? "" : ", " + script_string(error));
}

constexpr auto kLook = std::chrono::milliseconds(25);  // a signal is heard as soon

// What is wrong with a scenario, or with what was asked of it, may be mended by the next save: it
// is said, and the watch goes on. A machine without graphics will not be.
// The pages are told, too.
void render_and_tell(const RenderOptions& options) {
  std::string errors;
  hear_errors(&errors);
  try {
    draw_scenarios(options);
  } catch (const UsageError& e) {
    complain(e.what());
  } catch (const IoError& e) {
    complain(e.what());
  }
  hear_errors(nullptr);
  try {
    tell_error(errors);
  } catch (const IoError& e) {
    complain(e.what());
  }
}

}  // namespace

WatchedFiles::WatchedFiles(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const Stamp stamp = stamp_of(file);
    files_.push_back({file, stamp, std::nullopt, hash_of(file).value_or(0)});
  }
}

WatchedFiles::Stamp WatchedFiles::stamp_of(const std::string& file) {
  struct stat found {};
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  if (error || ::stat(file.c_str(), &found) != 0) return std::nullopt;
  return std::tuple(written, static_cast<std::uintmax_t>(found.st_size),
                    static_cast<std::uint64_t>(found.st_ino));
}

// A stamp that has rested is older than a clock tick, so that whatever is written later has
// another.
std::vector<std::string> WatchedFiles::changed() {
  std::vector<std::string> changed;
  gone_.clear();
  back_.clear();
  for (Watched& one : files_) {
    const Stamp now = stamp_of(one.file);
    const bool rests = now == one.looked_at;
    one.looked_at = now;
    if (rests && one.is_gone != !now) {
      one.is_gone = !now;
      (now ? back_ : gone_).push_back(one.file);
    }
    if (!now || !rests || now == one.told) continue;
    const auto hash = hash_of(one.file);
    if (!hash) continue;
    one.told = now;
    if (*hash == one.hash) continue;
    one.hash = *hash;
    changed.push_back(one.file);
  }
  return changed;
}

std::string reload_script(const fs::path& page) {
  return fmt::format(kScript, script_string(version_file(page.filename().string())));
}

void require_version_place(const FilePlace& page) {
  const FilePlace place(page.folder, version_file(page.name));
  require_writable(place);
  const auto is_ours = [&] {
    try {
      return standing(place).value_or(std::string(kCall)).starts_with(kCall);
    } catch (const IoError&) {
      return false;
    }
  };
  if (!is_ours())
    throw UsageError(
        "'{}' is not Lantern's, and the page is told by it that it was made again; name "
        "another page",
        place.path().string());
}

void tell_version(const FilePlace& page, std::string_view bytes) {
  const FilePlace place(page.folder, version_file(page.name));
  const std::uint64_t version = Hash().add(bytes).value();
  const std::string text = call_of(version, "");
  write_file(place, text);
  std::erase_if(written(), [&](const Version& old) { return old.place.path() == place.path(); });
  written().push_back({place, version, text});
}

void tell_error(const std::string& error) {
  for (Version& one : written()) {
    std::string text = call_of(one.version, error);
    if (text == one.bytes || standing(one.place) != one.bytes) continue;
    write_file(one.place, text);
    one.bytes = std::move(text);
  }
}

void forget_versions() noexcept {
  for (const Version& version : written()) try {
      if (standing(version.place) == version.bytes) version.place.folder.remove(version.place.name);
    } catch (const std::exception&) {
      // it is somebody else's by now
    }
  written().clear();
}

int watch_scenarios(const RenderOptions& asked) {
  RenderOptions options = asked;
  options.reloading = true;
  const RenderJob checked(options);  // words that no save can mend
  if (Destination(options.output, !options.sheet.empty()).kind() == OutputKind::standard_output)
    throw UsageError("watch draws again and again; -o - takes one picture");
  for (const std::string& file : options.files)
    if (!fs::exists(file)) throw IoError("'{}' is not there to be watched", file);
  const struct Leftovers {
    ~Leftovers() { forget_versions(); }
  } at_the_end;
  WatchedFiles watched(options.files);
  render_and_tell(options);
  say(fmt::format("watching {}; Ctrl-C ends", fmt::join(options.files, ", ")));
  while (!stop_asked()) {
    std::this_thread::sleep_for(kLook);
    options.files = watched.changed();
    for (const std::string& file : watched.gone())
      say(fmt::format("'{}' is gone; it is waited for", file));
    for (const std::string& file : watched.back()) say(fmt::format("'{}' is back", file));
    if (!options.files.empty()) render_and_tell(options);
  }
  return kInterrupted;
}

}  // namespace lantern::app
