#include "app/report_folder.hpp"

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/number.hpp"

namespace lantern::app {

namespace fs = std::filesystem;

ReportFolder::ReportFolder(const std::string& path, std::string_view report)
    : path_(path), report_(report) {
  if (!wanted()) return;
  for (const char* ending : {".html", ".csv", ".json", ".txt"})
    if (const fs::path file = path_ / (report_ + ending); is_input(file))
      throw UsageError(
          fmt::format("'{}' is read by this run and would be written over; give another "
                      "folder",
                      file.string()));
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
  if (wanted())
    save_pictures(*folder_, report_, pages, *theme_named(theme), *backend_named(backend));
}

void ReportFolder::finish() const {
  if (wanted()) folder_->settle();
}

}  // namespace lantern::app
