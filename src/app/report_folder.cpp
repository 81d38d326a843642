#include "app/report_folder.hpp"

#include <cmath>

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/hash.hpp"
#include "base/number.hpp"
#include "draw/theme.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/svg.hpp"

namespace lantern::app {

namespace {

MadeFrom page_from(std::string_view report, std::string_view page) {
  const auto key = [](std::string_view text) {
    return fmt::format("{:016x}", Hash().add(text).value());
  };
  return {key(report), key(page)};
}

// Is the file a page that was drawn for such a report, and that nobody has changed since?
bool is_page_of(std::string_view report, const Folder& folder, const std::string& file) try {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  const bool png = file.ends_with(".png");
  if (!png && !file.ends_with(".svg")) return false;
  const auto bytes = folder.read(file, kMostBytes);
  return bytes && made_from(png ? FileKind::png : FileKind::svg, *bytes) ==
                      page_from(report, file.substr(0, file.size() - 4));
} catch (const IoError&) {
  return false;
}

}  // namespace

ReportFolder::ReportFolder(const std::string& path, std::string_view report)
    : path_(path), report_(report) {
  if (!wanted()) return;
  for (const char* ending : {".html", ".csv", ".json", ".txt"})
    if (const fs::path file = path_ / (report_ + ending); is_input(file))
      throw UsageError("'{}' is read by this run and would be written over; give another folder",
                       file.string());
  std::error_code ignored;
  for (fs::path folder = path_; !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    made_.push_back(folder);
  folder_ = Folder::made(path_);
  require_kept_for(KeptFor::reports, *folder_);
  lock_.emplace(*folder_);
  folder_->remove_leftovers();
  constexpr const char* kProbe = ".lantern-try";
  write_file({*folder_, kProbe}, "");
  folder_->remove(kProbe);
}

ReportFolder::~ReportFolder() {
  std::error_code not_empty;
  for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

std::optional<std::string> ReportFolder::earlier(std::string_view name,
                                                 std::size_t most_bytes) const {
  return wanted() ? folder_->read(name, most_bytes) : std::nullopt;
}

void ReportFolder::write(std::string_view name, std::string_view bytes) {
  if (!wanted()) return;
  require_writable({*folder_, name});
  if (!begun_) remove_old_pages();
  begun_ = true;
  write_file({*folder_, name}, bytes);
}

void ReportFolder::remove_old_pages() {
  std::size_t removed = 0;
  for (const std::string& name : folder_->names())
    if (is_page_of(report_, *folder_, name)) removed += folder_->remove(name) ? 1 : 0;
  if (removed > 0)
    say(fmt::format("{} of an earlier report removed from {}", counted(removed, "page"),
                    path_.string()));
}

void ReportFolder::draw(const std::vector<ReportPage>& pages, const std::string& theme,
                        const std::string& backend) const {
  if (!wanted()) return;
  const Theme colours = *theme_named(theme);
  const auto pixels_of = [](const ReportPage& page) {
    return std::pair{static_cast<int>(std::lround(page.list.page.x)),
                     static_cast<int>(std::lround(page.list.page.y))};
  };
  for (const ReportPage& page : pages) {
    const auto [width, height] = pixels_of(page);
    write_file({*folder_, page.name + ".svg"},
               sealed(FileKind::svg, to_svg(page.list, colours, false, width, height),
                      page_from(report_, page.name)));
  }
  std::optional<Renderer> renderer;
  std::pair<int, int> rendered;
  Image image;
  for (const ReportPage& page : pages) {
    if (const auto size = pixels_of(page); !renderer || size != rendered) {
      renderer.reset();  // a context is current until the next one is made: one at a time
      renderer.emplace(Context::create(*backend_named(backend)), size.first, size.second);
      rendered = size;
    }
    renderer->draw(page.list, colours, false, image);
    write_file({*folder_, page.name + ".png"},
               sealed(FileKind::png, encode_png(image, PngEffort::small, {}, 0),
                      page_from(report_, page.name)));
  }
}

void ReportFolder::finish() const {
  if (wanted()) folder_->settle();
}

}  // namespace lantern::app
