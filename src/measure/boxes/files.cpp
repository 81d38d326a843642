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
                  std::uint64_t seed, std::size_t there = 0, const std::string& note = "") {
  const std::size_t bodies = frames[0].size();
  if (bodies < 2)
    throw Refused("{}: it has fewer than two boxes, so there is no pair", file.string());
  const std::size_t kept = frames.size();
  BoxScene scene{
      file.stem().string(),
      fmt::format("the {} boxes of {}, {}{}", bodies, file.string(),
                  kept < there ? fmt::format("which move: the first {} of {} frames", kept, there)
                  : kept > 1   ? fmt::format("which move: {} frames", kept)
                               : "at one moment: from step to step each is moved by up to 5 % of "
                                 "its size, the static ones not; times are of all these positions",
                  note),
      {}};
  if (dimension == 2)
    scene.boxes = in_space<2>(frames, seed);
  else
    scene.boxes = in_space<3>(frames, seed);
  return scene;
}

// --- CSV ---

// Lines of boxes: of four or six numbers, or of what the first line names. Other columns are passed
// over, and named. Every bad line is a mistake, of which the first are told.
class BoxesReader {
 public:
  // `called` is what columns are called in the file instead: "x=cx,y=cy".
  BoxesReader(CsvFile csv, std::string_view called) : csv_(std::move(csv)) {
    for (std::string_view rest = called; !rest.empty();) {
      const std::string_view one = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(one.size() + 1, rest.size()));
      const std::size_t equals = std::min(one.find('='), one.size());
      const auto column = std::ranges::find(kColumns, one.substr(0, equals));
      if (column == kColumns.end() || equals + 1 >= one.size())
        throw Refused("--columns {}: give ours = theirs, as x=cx,y=cy; ours are {}", one,
                      fmt::join(kColumns, ", "));
      names_[static_cast<std::size_t>(column - kColumns.begin())] = one.substr(equals + 1);
    }
  }

  // The dimension, 2 or 3.
  int read(std::vector<std::vector<FileBody>>& frames) {
    Diagnostics bad;
    csv_.each_line([&](const std::vector<CsvCell>& cells) {
      if (columns_.empty() && !begin(cells)) return;
      try {
        add(cells);
      } catch (const ScenarioError& error) {
        bad.add([&] { return error.diagnostics()[0]; });
      }
    });
    if (!bad.empty()) throw ScenarioError(bad.list("bad lines"));
    for (const auto& [time, boxes] : frames_) {
      require_all(frames_.begin()->second, boxes, "not in", time);
      require_all(boxes, frames_.begin()->second, "not in the first frame, but in", time);
      frames.emplace_back();
      for (const auto& [who, one] : boxes) {
        frames.back().push_back(one.first);
        frames.back().back().id = static_cast<BodyId>(frames.back().size() - 1);
      }
    }
    return dimension_;
  }

  std::string note() const {
    constexpr const char* kHow = "; not used: {} (--columns frame=T,id=N if one is frame or id)";
    return unused_.empty() ? "" : fmt::format(kHow, fmt::join(unused_, ", "));
  }

 private:
  using Id = std::pair<double, std::string_view>;        // a number; a text, behind all numbers
  using Lines = std::map<Id, std::pair<FileBody, int>>;  // and the file's line

  static std::string words(const Id& who, const char* what, double time) {
    const auto& [number, text] = who;
    return fmt::format("box {} is {} frame {}",
                       text.empty() ? fmt::format("{}", number) : in_quotes(text), what, time);
  }

  void require_all(const Lines& boxes, const Lines& in, const char* what, double time) const {
    for (const auto& [who, one] : boxes)
      if (!in.contains(who)) csv_.fail(1, words(who, what, time), kEachOnce, one.second);
  }

  enum Column { lo_x, lo_y, lo_z, hi_x, hi_y, hi_z, x, y, z, half_x, half_y, half_z, width };
  enum { height = width + 1, depth, is_static, id, frame, kCount };
  static constexpr std::array<std::string_view, kCount> kColumns = {
      "lo_x",   "lo_y",   "lo_z",   "hi_x",  "hi_y",   "hi_z",  "x",      "y",  "z",
      "half_x", "half_y", "half_z", "width", "height", "depth", "static", "id", "frame"};

  // False if the line only names columns.
  bool begin(const std::vector<CsvCell>& cells) {
    const bool is_bare = number(cells[0].text.substr(0, cells[0].text.find(','))).has_value();
    const bool flat = cells.size() - cells.back().text.empty() == 4;
    if (is_bare)
      columns_ = flat ? std::vector<int>{lo_x, lo_y, hi_x, hi_y}
                      : std::vector<int>{lo_x, lo_y, lo_z, hi_x, hi_y, hi_z};
    for (std::size_t i = 0; !is_bare && i < cells.size(); ++i) {
      const auto found = std::ranges::find(names_, cells[i].text);
      const int column = found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
      if (column >= 0 && has(column))
        csv_.fail(cells[i].column, fmt::format("column '{}' is there twice", cells[i].text));
      columns_.push_back(column);
    }
    sizes_ = has(half_x) ? half_x : has(width) ? width : hi_x;
    from_ = sizes_ == hi_x ? lo_x : x;
    dimension_ = has(from_ + 2) ? 3 : 2;
    for (std::size_t i = 0; !is_bare && i < cells.size(); ++i)
      if (columns_[i] < 0 && !cells[i].text.empty()) unused_.push_back(cells[i].text);
    for (const std::string& name : names_)
      if (std::ranges::find(kColumns, name) == kColumns.end() &&
          std::ranges::find(cells, name, &CsvCell::text) == cells.end())
        csv_.fail(1, fmt::format("no column is called '{}', as --columns says", name),
                  fmt::format("there are {}", fmt::join(mapped(cells, &CsvCell::text), ", ")));
    for (const int from : {from_, sizes_})
      for (int column = from; column < from + dimension_; ++column)
        if (!has(column)) miss(named(column), nearest_name(named(column), unused_));
    return is_bare;
  }

  [[noreturn]] void miss(std::string_view column, const std::optional<std::string>& near) const {
    csv_.fail(1, fmt::format("column '{}' is missing", column),
              near ? fmt::format("is it '{0}'? --columns {1}={0}", *near, column)
                   : "name lo_x,lo_y,hi_x,hi_y, x,y,half_x,half_y or x,y,width,height, in space "
                     "lo_z,hi_z, z,half_z or z,depth, too; or --columns x=cx,y=cy");
  }

  bool has(int column) const { return std::ranges::find(columns_, column) != columns_.end(); }
  std::string_view named(int column) const { return names_[static_cast<std::size_t>(column)]; }

  static std::optional<double> number(std::string_view text) {
    const auto value = number_in<double>(text.substr(text.starts_with('+')));
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  void add(const std::vector<CsvCell>& cells) {
    const bool ends = cells.size() > columns_.size() && cells.back().text.empty();  // "1,2,3,4,"
    if (cells.size() != columns_.size() + ends)
      csv_.fail(
          cells.back().column,
          fmt::format("{}, where {} are expected", counted(cells.size(), "value"), columns_.size()),
          "a box is what the first line names, or its lower and its upper corner");
    std::array<double, kCount> values{};
    std::array<int, kCount> places{};
    Id who;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i] < 0) continue;
      const auto column = static_cast<std::size_t>(columns_[i]);
      const auto value = number(cells[i].text);
      if (column == id) who = value ? Id(*value, "") : Id(HUGE_VAL, cells[i].text);
      if (!value && column != id)
        csv_.fail(cells[i].column, fmt::format("{} is no finite number", in_quotes(cells[i].text)),
                  cells[i].text.find(',') == std::string_view::npos ? "" : "write 0.5, not 0,5");
      values[column] = value.value_or(0);
      places[column] = cells[i].column;
    }
    if (values[is_static] != 0 && values[is_static] != 1)
      csv_.fail(places[is_static], "static is 0 or 1");
    Lines& boxes = frames_[values[frame]];
    if (!has(id)) who.first = static_cast<double>(boxes.size());
    const FileBody body{0, box(values, places), values[is_static] == 1, true};
    if (!boxes.insert({who, {body, csv_.line()}}).second)
      csv_.fail(places[id], words(who, "twice in", values[frame]), kEachOnce);
  }

  Box<3> box(const std::array<double, kCount>& values,
             const std::array<int, kCount>& places) const {
    const auto three = [&](int first) {
      const auto i = static_cast<std::size_t>(first);
      return Vec<3>(values[i], values[i + 1], values[i + 2]);
    };
    Box<3> box{three(from_), three(sizes_)};
    if (sizes_ != hi_x) box = Box<3>::around(box.lo, box.hi * (sizes_ == width ? 0.5 : 1.0));
    for (int i = 0; i < 3; ++i)
      if (!(box.lo[i] <= box.hi[i]))
        csv_.fail(places[static_cast<std::size_t>(sizes_ + i)],
                  sizes_ == hi_x     ? "the box ends before it begins"
                  : sizes_ == half_x ? "a half size is negative"
                                     : "a size is negative");
    if (!is_valid(box)) csv_.fail(1, "the box is too large");
    return box;
  }

  static constexpr const char* kEachOnce = "give each box its id, once in every frame";
  CsvFile csv_;
  std::vector<std::string> names_{kColumns.begin(), kColumns.end()};  // there
  int dimension_ = 2, from_ = lo_x, sizes_ = hi_x;
  std::vector<int> columns_;  // of each cell; -1: passed over
  std::vector<std::string_view> unused_;
  std::map<double, Lines> frames_;
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

BoxScene read_boxes(const fs::path& file, std::uint64_t seed, const std::string& columns) {
  const std::string bytes = read_input(file, kMostBytes);
  require_memory(8 * bytes.size(), file.string() + ": its boxes", "take fewer of them");
  if (file.extension() == ".aabbs") return scene_of(file, 3, AabbsReader(file, bytes).read(), seed);
  std::vector<std::vector<FileBody>> frames;
  BoxesReader reader(CsvFile(file.string(), bytes), columns);
  const int dimension = reader.read(frames);
  if (frames.empty()) frames.emplace_back();
  const std::size_t there = frames.size();
  frames.resize(std::min(frames.size(), frames_for(frames[0].size())));
  return scene_of(file, dimension, std::move(frames), seed, there, reader.note());
}

}  // namespace lantern::measure
