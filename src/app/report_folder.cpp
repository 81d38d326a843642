#include "app/report_folder.hpp"

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/file.hpp"

namespace lantern::app {

namespace fs = std::filesystem;

ReportFolder::ReportFolder(const std::string& path, std::string_view report)
    : path_(path), report_(report) {
  if (!wanted()) return;
  std::error_code ignored;
  for (fs::path folder = path_; !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    made_.push_back(folder);
  make_folder(path_);
  lock_.emplace(path_);
  remove_leftovers(path_);
  const fs::path probe = path_ / ".lantern-try";
  write_file(probe, "");
  fs::remove(probe, ignored);
}

ReportFolder::~ReportFolder() {
  std::error_code not_empty;
  for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

void ReportFolder::write(std::string_view name, std::string_view bytes) {
  if (!wanted()) return;
  if (!begun_) remove_old_pages();
  begun_ = true;
  write_file(path_ / name, bytes);
}

void ReportFolder::remove_old_pages() {
  std::vector<fs::path> old;
  std::error_code error;
  for (fs::directory_iterator it(path_, error), end; !error && it != end; it.increment(error))
    if (is_page_of(report_, it->path())) old.push_back(it->path());
  for (const fs::path& page : old) fs::remove(page, error);
  if (!old.empty())
    say(fmt::format("{} of an earlier report removed from {}", counted(old.size(), "page"),
                    path_.string()));
}

void ReportFolder::draw(const std::vector<ReportPage>& pages, const std::string& theme,
                        const std::string& backend) const {
  if (wanted()) save_pictures(path_, report_, pages, *theme_named(theme), *backend_named(backend));
}

void ReportFolder::finish() const {
  if (wanted()) make_durable(path_);
}

}  // namespace lantern::app
