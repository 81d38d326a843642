#include "app/named_files.hpp"

#include <set>

#include <fmt/format.h>

#include "app/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"

namespace lantern::app {

namespace fs = std::filesystem;

FilePlace make_place(const fs::path& file, const fs::path& users) {
  require_free(file);
  Folder folder = users == "." ? Folder("") : Folder::made(users);  // names without ./
  for (const fs::path& part : folder_of(file).lexically_relative(users).lexically_normal()) {
    if (part == "..")
      throw UsageError(fmt::format("-o {}: it leads out again by ..", file.string()));
    if (!part.empty() && part != ".") folder = folder.inside(part.string());
  }
  return {folder, file.filename().string()};
}

void refuse_in_betweens(const Sequence& sequence) {
  if (sequence.job.in_betweens.wanted())
    throw UsageError(fmt::format(
        "-o {}: a page does not move; in-betweens (--tween, --fps) need a folder or a film",
        sequence.job.options.output));
}

void NamedFiles::write(const std::filesystem::path& file, std::string_view bytes,
                       std::uint64_t frames) {
  write_file(make_place(file, to_.users_folder()), bytes);
  work_.bytes_written += bytes.size();
  work_.frames_written += frames;
  made_.frames += frames;
  made_.files.push_back(file);
}

void NamedFiles::settle() const {
  std::set<std::filesystem::path> folders;
  for (const auto& file : made_.files) folders.insert(folder_of(file));
  for (const auto& folder : folders) Folder(folder).settle();
}

}  // namespace lantern::app
