#include <cstring>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/number.hpp"
#include "base/random.hpp"
#include "base/stop.hpp"
#include "geometry/flat.hpp"
#include "geometry/random_vec.hpp"
#include "measure/boxes/worlds.hpp"
#include "measure/csv_file.hpp"

namespace lantern::measure {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{4} << 30;

using FileBody = Proxy<3>;  // of a flat world with z = 0

// Brings the bodies into their dimension; one frame is moved on.
template <int D>
BoxUpdates<D> in_space(const std::vector<std::vector<FileBody>>& frames, std::uint64_t seed) {
  BoxUpdates<D> all;
  for (const std::vector<FileBody>& bodies : frames) {
    std::vector<Proxy<D>>& into = all.frames.emplace_back();
    for (const FileBody& body : bodies)
      into.push_back({body.id, in_dimension<D>(body.box), body.is_static, body.awake});
  }
  if (frames.size() == 1) {
    Random random(seed);
    for (std::size_t frame = 1; frame < frames_for(frames[0].size()); ++frame) {
      all.frames.push_back(all.frames.back());
      for (Proxy<D>& body : all.frames.back()) {
        const Vec<D> way = random_point<D>(random, -0.05, 0.05) * body.box.size();
        if (!body.is_static) body.box = {body.box.lo + way, body.box.hi + way};
      }
    }
  }
  all.bounds = all.frames[0][0].box;
  for (const std::vector<Proxy<D>>& bodies : all.frames)
    for (const Proxy<D>& body : bodies) all.bounds = united(all.bounds, body.box);
  return all;
}

BoxScene scene_of(const fs::path& file, int dimension, std::vector<std::vector<FileBody>> frames,
                  std::uint64_t seed) {
  const std::size_t bodies = frames[0].size();
  if (bodies < 2)
    throw Refused("{}: it has fewer than two boxes, so there is no pair", file.string());
  BoxScene scene{
      file.stem().string(), fmt::format("the {} boxes of {}", bodies, file.string()), {}};
  if (dimension == 2)
    scene.boxes = in_space<2>(frames, seed);
  else
    scene.boxes = in_space<3>(frames, seed);
  return scene;
}

// --- CSV ---

class BoxesReader {
 public:
  explicit BoxesReader(CsvFile csv) : csv_(std::move(csv)) {}

  // The dimension, 2 or 3.
  int read(std::vector<FileBody>& bodies) {
    csv_.each_line([&](const std::vector<CsvCell>& cells) { line(cells, bodies); });
    return dimension_;
  }

 private:
  enum Column { lo_x, lo_y, lo_z, hi_x, hi_y, hi_z, x, y, z, half_x, half_y, half_z, is_static };
  static constexpr std::array<std::string_view, 13> kColumns = {
      "lo_x", "lo_y", "lo_z",   "hi_x",   "hi_y",   "hi_z",  "x",
      "y",    "z",    "half_x", "half_y", "half_z", "static"};

  void line(const std::vector<CsvCell>& cells, std::vector<FileBody>& bodies) {
    if (columns_.empty()) {
      if (!number_in<double>(cells[0].text)) return name_columns(cells);
      columns_ = {lo_x, lo_y, hi_x, hi_y};
      if (cells.size() != 4) columns_ = {lo_x, lo_y, lo_z, hi_x, hi_y, hi_z};
      dimension_ = cells.size() == 4 ? 2 : 3;
    }
    if (cells.size() != columns_.size())
      csv_.fail(
          cells.back().column,
          fmt::format("{}, where {} are expected", counted(cells.size(), "value"), columns_.size()),
          "a box is lo_x,lo_y,hi_x,hi_y or lo_x,lo_y,lo_z,hi_x,hi_y,hi_z, or what the first line "
          "names");
    bodies.push_back(body(cells, static_cast<BodyId>(bodies.size())));
  }

  void name_columns(const std::vector<CsvCell>& cells) {
    for (const std::size_t column : csv_.named(cells, kColumns))
      columns_.push_back(static_cast<Column>(column));
    by_half_ = has(half_x);
    dimension_ = has(lo_z) || has(z) ? 3 : 2;
    for (const Column column : corners())
      if (!has(column))
        csv_.fail(
            1, fmt::format("column '{}' is missing", kColumns[column]),
            "name lo_x,lo_y,hi_x,hi_y or x,y,half_x,half_y, in space lo_z,hi_z or z,half_z, too");
    if (columns_.size() != corners().size() + (has(is_static) ? 1 : 0))
      csv_.fail(
          1, "columns of corners and of half sizes are mixed",
          "name lo_x,lo_y,hi_x,hi_y or x,y,half_x,half_y, in space lo_z,hi_z or z,half_z, too");
  }

  bool has(Column column) const { return std::ranges::find(columns_, column) != columns_.end(); }
  std::vector<Column> corners() const {
    if (by_half_)
      return dimension_ == 2 ? std::vector{x, y, half_x, half_y}
                             : std::vector{x, y, z, half_x, half_y, half_z};
    return dimension_ == 2 ? std::vector{lo_x, lo_y, hi_x, hi_y}
                           : std::vector{lo_x, lo_y, lo_z, hi_x, hi_y, hi_z};
  }

  FileBody body(const std::vector<CsvCell>& cells, BodyId id) const {
    std::array<double, kColumns.size()> values{};
    std::array<int, kColumns.size()> places{};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number_in<double>(cells[i].text);
      if (!value || !std::isfinite(*value))
        csv_.fail(cells[i].column, fmt::format("{} is no finite number", in_quotes(cells[i].text)));
      values[columns_[i]] = *value;
      places[columns_[i]] = cells[i].column;
    }
    if (values[is_static] != 0 && values[is_static] != 1)
      csv_.fail(places[is_static], "static is 0 or 1");
    const Vec<3> center(values[x], values[y], values[z]),
        half(values[half_x], values[half_y], values[half_z]);
    const Box<3> corners{{values[lo_x], values[lo_y], values[lo_z]},
                         {values[hi_x], values[hi_y], values[hi_z]}};
    const Box<3> box = by_half_ ? Box<3>::around(center, half) : corners;
    for (int i = 0; i < 3; ++i)
      if (!(box.lo[i] <= box.hi[i]))
        csv_.fail(places[static_cast<std::size_t>((by_half_ ? half_x : hi_x) + i)],
                  by_half_ ? "a half size is negative" : "the box ends before it begins");
    if (!is_valid(box)) csv_.fail(1, "the box is too large");
    return {id, box, values[is_static] == 1, true};
  }

  CsvFile csv_;
  int dimension_ = 2;
  bool by_half_ = false;
  std::vector<Column> columns_;
};

// --- Broadmark ---

class AabbsReader {
 public:
  AabbsReader(const fs::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::vector<std::vector<FileBody>> read() const {
    constexpr std::size_t kHeader = 304, kBox = 32, kCounts = 256;
    if (bytes_.size() < kHeader) fail("it is too short to be one of Broadmark");
    const auto objects = value<std::int32_t>(kCounts), told = value<std::int32_t>(kCounts + 4);
    if (objects < 2 || told < 1 || value<std::int32_t>(kCounts + 8) != 0)
      fail("its header has no counts of objects and frames; is it one of Broadmark?");
    const std::size_t bodies = static_cast<std::size_t>(objects), frame = bodies * kBox;
    const std::size_t there = (bytes_.size() - kHeader) / frame;
    if (there < 1 || (bytes_.size() - kHeader) % frame != 0)
      fail(fmt::format("{} objects need {} bytes a frame, and {} bytes follow the header", objects,
                       frame, bytes_.size() - kHeader));
    std::vector<std::vector<FileBody>> frames(std::min(there, frames_for(bodies)));
    for (std::size_t i = 0; i < frames.size() * bodies; ++i) {
      stop_if_asked();
      frames[i / bodies].push_back(body(kHeader + i * kBox, i % bodies, i / bodies));
    }
    return frames;
  }

 private:
  [[noreturn]] void fail(std::string message) const {
    throw ScenarioError(Diagnostic{{file_.string(), 0, 0}, std::move(message), "", ""});
  }

  template <class T>
  T value(std::size_t at) const {
    static_assert(std::endian::native == std::endian::little);
    T value;
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }

  FileBody body(std::size_t at, std::size_t object, std::size_t frame) const {
    Box<3> box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[static_cast<int>(i)] = value<float>(at + 4 * i);
      box.hi[static_cast<int>(i)] = value<float>(at + 16 + 4 * i);
    }
    if (!is_valid(box))
      fail(fmt::format("object {} of frame {}: its box is not finite or inverted", object, frame));
    return {static_cast<BodyId>(object), box, false, true};
  }

  const fs::path& file_;
  std::string_view bytes_;
};

}  // namespace

BoxScene read_boxes(const fs::path& file, std::uint64_t seed) {
  const std::string bytes = read_input(file, kMostBytes);
  require_memory(4 * bytes.size(), file.string() + ": its boxes", "take fewer of them");
  if (file.extension() == ".aabbs") return scene_of(file, 3, AabbsReader(file, bytes).read(), seed);
  std::vector<std::vector<FileBody>> frames(1);
  const int dimension = BoxesReader(CsvFile(file.string(), bytes)).read(frames[0]);
  return scene_of(file, dimension, std::move(frames), seed);
}

}  // namespace lantern::measure
