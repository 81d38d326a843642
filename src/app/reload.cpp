#include "app/reload.hpp"

#include <set>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {
namespace {

constexpr const char* kScript = R"(<script>
(() => {{
  let known = null;
  window.lanternVersion = version => {{
    if (known !== null && known !== version) location.reload();
    known = version;
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

std::set<std::filesystem::path>& written() {
  static std::set<std::filesystem::path> files;
  return files;
}

std::string version_file(const std::filesystem::path& page) {
  return page.filename().string() + ".version.js";
}

// In a script, "</script>" would end it wherever it stands.
std::string script_string(std::string_view text) {
  std::string quoted = json_string(text);
  for (std::size_t at = 0; (at = quoted.find('<', at)) != quoted.npos;)
    quoted.replace(at, 1, "\\u003c");
  return quoted;
}

}  // namespace

std::string reload_script(const std::filesystem::path& page) {
  return fmt::format(kScript, script_string(version_file(page)));
}

void tell_version(const std::filesystem::path& page, std::string_view bytes) {
  const std::filesystem::path file = page.parent_path() / version_file(page);
  written().insert(file);
  write_file(file, fmt::format("lanternVersion(\"{:016x}\");\n", Hash().add(bytes).value()));
}

void forget_versions() noexcept {
  std::error_code error;
  for (const std::filesystem::path& file : written()) std::filesystem::remove(file, error);
  written().clear();
}

}  // namespace lantern::app
