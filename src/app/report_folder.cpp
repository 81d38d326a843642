#include "app/report_folder.hpp"

#include "base/file.hpp"

namespace lantern {

ReportFolder::ReportFolder(const std::string& path) : path_(path) {
  if (!wanted()) return;
  make_folder(path_);
  remove_leftovers(path_);
  const std::filesystem::path probe = path_ / ".lantern-try";
  write_file(probe, "");
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
}

void ReportFolder::write(std::string_view name, std::string_view bytes) const {
  if (wanted()) write_file(path_ / name, bytes);
}

void ReportFolder::draw(const std::vector<ReportPage>& pages, const std::string& theme,
                        const std::string& backend) const {
  if (wanted()) save_pictures(path_, pages, *theme_named(theme), *backend_named(backend));
}

}  // namespace lantern
