#include "app/output/sinks.hpp"

#include <set>

#include <fmt/format.h>

#include "app/folders/kept_files.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"
#include "draw/staging.hpp"

namespace lantern::app {

void StagedSink::frame(const Frame& frame) {
  const std::size_t bytes = estimated_bytes(frame);
  if (!waiting_.empty() && (waiting_.size() >= bound_.frames || bytes_ + bytes > bound_.bytes))
    flush();
  waiting_.push_back(frame);
  ++undrawn_;
  bytes_ += bytes;
}

void StagedSink::finish(const DirectorReport& report) {
  flush();
  close(report);
}

void StagedSink::flush() {
  draw::AxisRanges axes;
  for (const Frame& frame : waiting_) axes.see(frame);
  std::size_t first = 0;
  for (std::size_t next = 1; next <= waiting_.size(); ++next) {
    if (next < waiting_.size() && Staging::is_one_group(waiting_[next - 1], waiting_[next]))
      continue;
    const std::span<const Frame> group = std::span(waiting_).subspan(first, next - first);
    const Staging staging(group, axes);
    for (const Frame& frame : group) {
      stop_if_asked();
      draw(frame, staging);
      --undrawn_;
    }
    first = next;
  }
  waiting_.clear();
  bytes_ = 0;
}

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

void Sequence::refuse(const std::string& why) const {
  throw UsageError(fmt::format("-o {}: {}", job.options.output, why));
}

void FileSink::draw(const Frame& frame, const Staging& staging) {
  if (of_.selection.takes(frame)) take(frame, staging);
}

void FileSink::close(const DirectorReport&) {
  of_.selection.require_some();
  end();
  std::set<fs::path> folders;
  for (const fs::path& file : made_.files) folders.insert(folder_of(file));
  for (const fs::path& folder : folders) Folder(folder).settle();
}

FilePlace FileSink::place_of(const fs::path& file) const {
  return make_place(file, of_.to.users_folder());
}

void FileSink::write(const fs::path& file, std::string_view bytes, std::uint64_t frames) {
  write_file(place_of(file), bytes);
  of_.work.bytes_written += bytes.size();
  of_.work.frames_written += frames;
  made_.frames += frames;
  made_.files.push_back(file);
}

std::unique_ptr<FileSink> make_file_sink(const Sequence& sequence) {
  switch (sequence.to.kind()) {
    case OutputKind::standard_output:
      return make_stdout_sink(sequence);
    case OutputKind::picture:
      return make_picture_sink(sequence);
    case OutputKind::film:
      return make_film_sink(sequence);
    case OutputKind::document:
      return make_document_sink(sequence);
    case OutputKind::sheet:
      return make_sheet_sink(sequence);
    case OutputKind::page:
      return make_page_sink(sequence);
    case OutputKind::folder:
      break;
  }
  sequence.refuse("no file");
}

}  // namespace lantern::app
