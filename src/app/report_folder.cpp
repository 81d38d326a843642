#include "app/report_folder.hpp"

#include "base/file.hpp"
#include "draw/theme.hpp"
#include "render/pipeline.hpp"

namespace lantern {

namespace fs = std::filesystem;

ReportFolder::ReportFolder(const std::string& path) : path_(path) {
  if (!wanted()) return;
  make_folder(path_);
  remove_leftovers(path_);
  const fs::path probe = path_ / ".lantern-try";
  write_file(probe, "");
  std::error_code ignored;
  fs::remove(probe, ignored);
}

void ReportFolder::write(std::string_view name, std::string_view bytes) const {
  if (wanted()) write_file(path_ / name, bytes);
}

void ReportFolder::draw(const std::vector<std::pair<std::string, DrawList>>& pages,
                        const std::string& theme) const {
  if (!wanted() || pages.empty()) return;
  Pipeline::Config config;
  config.width = 1600;
  config.height = 900;
  config.theme = *theme_named(theme);
  config.effort = PngEffort::small;
  Work work;
  Pipeline pipeline(Context::create(Backend::automatic), config, work);
  for (const auto& [name, list] : pages)
    pipeline.submit(list, {{"Title", name}}, path_ / (name + ".png"));
  pipeline.finish();
}

}  // namespace lantern
