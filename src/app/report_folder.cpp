#include "app/report_folder.hpp"

#include "base/file.hpp"

namespace lantern {

namespace fs = std::filesystem;

ReportFolder::ReportFolder(const std::string& path) : path_(path) {
  if (!wanted()) return;
  std::error_code ignored;
  for (fs::path folder = path_; !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    made_.push_back(folder);
  make_folder(path_);
  remove_leftovers(path_);
  const fs::path probe = path_ / ".lantern-try";
  write_file(probe, "");
  fs::remove(probe, ignored);
}

ReportFolder::~ReportFolder() {
  std::error_code not_empty;
  for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

void ReportFolder::write(std::string_view name, std::string_view bytes) const {
  if (wanted()) write_file(path_ / name, bytes);
}

void ReportFolder::draw(const std::vector<ReportPage>& pages, const std::string& theme,
                        const std::string& backend) const {
  if (wanted()) save_pictures(path_, pages, *theme_named(theme), *backend_named(backend));
}

void ReportFolder::finish() const {
  if (wanted()) make_durable(path_);
}

}  // namespace lantern
