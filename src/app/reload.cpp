#include "app/reload.hpp"

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
  write_file(page.parent_path() / version_file(page),
             fmt::format("lanternVersion(\"{:016x}\");\n", Hash().add(bytes).value()));
}

}  // namespace lantern::app
