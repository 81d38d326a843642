// `bench frames`: how fast frames become files, beside cairo.
#include <cerrno>
#include <cstring>
#include <thread>

#include <fmt/format.h>

#include "base/number.hpp"
#include "draw/page.hpp"
#include "report/benches.hpp"
#include "run/director.hpp"

namespace lantern::report {

void each_field(const FrameRow& row, auto&& visit) {
  visit_fields(visit, "sequence", row.sequence, "writer", row.writer, "frames", row.frames,
               "frames_per_second", row.frames_per_second, "lower_quartile", row.lower_quartile,
               "upper_quartile", row.upper_quartile, "against_cairo", row.against_cairo,
               "bytes_per_file", row.bytes_per_file);
  const auto counted = [](const std::optional<std::uint64_t>& count) {
    return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
  };
  visit_fields(visit, "pixels_drawn", counted(row.pixels_drawn), "bands_packed",
               counted(row.bands_packed), "bands_kept", counted(row.bands_kept));
}

void each_field(const FrameMean& mean, auto&& visit) {
  visit_fields(visit, "writer", mean.writer, "against_cairo", mean.against_cairo, "bytes_per_file",
               mean.bytes_per_file);
}

void each_field(const StartTimes& s, auto&& visit) {
  visit_fields(visit, "shaders_known", s.shaders_known, "bare_context_seconds", s.bare_context,
               "first_file_seconds", s.first_file);
}

namespace {

std::string times_text(const std::optional<double>& times) {
  return times ? fmt::format("{:.2f}", *times) : "–";
}

// Of all pixels of the frames, and of all their bands.
std::string share_text(const std::optional<std::uint64_t>& part, double whole) {
  return part ? fmt::format("{:.0f}%", 100 * static_cast<double>(*part) / whole) : "–";
}

const char* how_of(const std::string& writer) {
  if (!writer.starts_with("lantern"))
    return "the same shapes on an image surface, cairo's usual antialiasing, and "
           "cairo_surface_write_to_png";
  return writer.ends_with("fast")
             ? "draws what differs from the picture before, and packs the bands of rows that differ"
             : "draws what differs from the picture before; libdeflate packs all of it";
}

// A point a sequence, by its number in the tables.
Sheet<FrameRow>::Curve curve_of(const FrameBenchResult& result, bool bytes) {
  Plot plot;
  plot.title = bytes ? "How large the files are" : "How soon they are written";
  plot.x_name = "sequence, in the order of the tables";
  plot.y_name = bytes ? "bytes a file: down is better"
                      : "frames a second, quartiles as whiskers: up is better";
  plot.log_x = false;
  plot.log_y = !bytes;
  std::vector<std::string> sequences;
  for (const FrameRow& row : result.rows)
    if (sequences.empty() || sequences.back() != row.sequence) sequences.push_back(row.sequence);
  return {plot, [=](const FrameRow& row) -> std::optional<PlotPoint> {
            const auto at = std::ranges::find(sequences, row.sequence) - sequences.begin();
            const double x = static_cast<double>(at) + 1;
            if (bytes) return PlotPoint{{x, row.bytes_per_file}};
            return PlotPoint{.at = {x, row.frames_per_second},
                             .spread = Box<2>{{x, row.lower_quartile}, {x, row.upper_quartile}}};
          }};
}

Sheet<FrameRow> sheet_of(const FrameBenchResult& result) {
  const FrameBenchConfig& c = result.config;
  Sheet<FrameRow> sheet;
  sheet.format = "lantern.bench.frames/2";
  sheet.title = "Frames to disk";
  sheet.about = fmt::format(
      "Pictures of {} x {} from draw list to file, only those that differ from the one before; "
      "{} threads encode. Writers take turns in {} rounds: medians, and times as fast as cairo on "
      "one thread in the same round.",
      c.width, c.height, c.threads, c.rounds);
  sheet.head = [&result, &c](JsonWriter& json) {
    json.members("width", c.width, "height", c.height);
    json.line().members("rounds", c.rounds, "threads", c.threads);
    json.line().member("cairo", result.cairo);
  };
  sheet.lists = [&result](JsonWriter& json) {
    write_rows("means", means_of(result), json);
    write_rows("starts", result.starts, json);
  };
  sheet.who = [](const FrameRow& row) { return row.writer; };
  sheet.chapter = [](const FrameRow&) { return "All sequences"; };
  sheet.stage = [](const FrameRow& row) {
    return fmt::format("{}: {} frames", row.sequence, row.frames);
  };
  sheet.columns = {
      {"frames/s", [](auto& row) { return fmt::format("{:.1f}", row.frames_per_second); }},
      {"quartiles",
       [](auto& row) {
         return fmt::format("{:.1f} ... {:.1f}", row.lower_quartile, row.upper_quartile);
       }},
      {"x cairo", [](auto& row) { return times_text(row.against_cairo); }},
      {"bytes/file", [](auto& row) { return fmt::format("{:.0f}", row.bytes_per_file); }},
      {"drawn",
       [&c](auto& row) {
         return share_text(row.pixels_drawn, static_cast<double>(row.frames) * c.width *
                                                 static_cast<double>(c.height));
       }},
      {"packed",
       [](auto& row) {
         const std::uint64_t bands = row.bands_packed.value_or(0) + row.bands_kept.value_or(0);
         return share_text(row.bands_packed, static_cast<double>(bands));
       }},
  };
  sheet.curves = {curve_of(result, false), curve_of(result, true)};
  return sheet;
}

// The mean counts each sequence as much.
Chapter mean_chapter(const FrameBenchResult& result) {
  Table table{"", {{"", false}, {"x cairo, mean"}, {"bytes/file, mean"}}};
  for (const FrameMean& mean : means_of(result))
    table.lines.push_back({{mean.writer},
                           {mean.writer, times_text(mean.against_cairo),
                            fmt::format("{:.0f}", mean.bytes_per_file)}});
  return {"Means", {"Each sequence counts as much."}, {}, {std::move(table)}};
}

Chapter start_chapter(const FrameBenchResult& result) {
  Table table{"", columns_of({"ms|", "bare context", "first 1280 x 720 file", "ratio"})};
  for (const StartTimes& s : result.starts)
    table.lines.push_back(
        {{},
         {s.shaders_known ? "shaders in Mesa's cache" : "shaders never compiled yet",
          fmt::format("{:.1f}", 1e3 * s.bare_context), fmt::format("{:.1f}", 1e3 * s.first_file),
          fmt::format("{:.2f}", s.first_file / s.bare_context)}});
  return {"The first picture", {"From the start of a process."}, {}, {std::move(table)}};
}

// A folder for the files of the measurement, gone when it ends.
class ScratchFolder {
 public:
  // Nobody else can have made it before.
  ScratchFolder() {
    std::string name = std::filesystem::temp_directory_path() / "lantern-bench-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr)
      throw IoError("cannot make the folder '{}': {}", name, std::strerror(errno));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder& operator=(ScratchFolder&&) = delete;  // nor any other copy or move
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

class FramesBench : public ExperimentOf<FrameBenchResult> {
 public:
  explicit FramesBench(ScenarioFinder find) : find_(std::move(find)) {
    result_.config.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    result_.config.theme = *theme_named("light");
  }

  Options options() override {
    FrameBenchConfig& c = result_.config;
    return {
        {"FILE", &names_, "scenario files; the default is six of Lantern's in which much moves"},
        rounds_option("repeats; the median counts", c.rounds, 1000),
        option("--frames", &c.most_frames, {.value = "N", .least = 2, .most = 10000},
               "of a sequence, at most; those that differ count")};
  }
  void prepare() override {
    if (names_.empty())
      names_ = {"ghost_quadtree", "ghost_maze",  "falling_boxes",
                "pong_game",      "spring_rope", "tumbling_box"};
    for (const std::string& name : names_) sequences_.push_back(sequence_of(find_(name)));
  }
  std::vector<std::string> announcement() const override {
    const FrameBenchConfig& c = result_.config;
    return {fmt::format("{} of {} at {} x {}", counted(c.rounds, "round"),
                        counted(sequences_.size(), "sequence"), c.width, c.height)};
  }
  std::string unit() const override { return "sequences"; }
  std::size_t stages() const override { return sequences_.size(); }
  void run(const std::function<void(const std::string&)>& tell) override {
    const ScratchFolder folder;
    bench_frames(result_, sequences_, folder.path(), [&](std::size_t i) {
      tell(fmt::format("sequence {} of {}, {}", i + 1, stages(), sequences_[i].name));
    });
  }

 private:
  FrameSequence sequence_of(const std::string& file) const {
    const FrameBenchConfig& c = result_.config;
    const Scenario scenario = load_scenario(file);
    FrameSequence sequence{scenario.name, {}};
    const std::size_t most = 2 * c.most_frames;  // some of the frames equal the one before
    Work work;
    direct(scenario, Pace::step, work, [&](const Frame& frame) {
      sequence.lists.push_back(draw_frame(frame, page_for(c.width, c.height), work));
      return sequence.lists.size() < most;
    });
    if (sequence.lists.size() < 2)
      throw Refused(scenario.name + " gives fewer than two frames; choose one in which more moves");
    return sequence;
  }

  ScenarioFinder find_;
  std::vector<std::string> names_;
  std::vector<FrameSequence> sequences_;
};

}  // namespace

Texts texts_of(const FrameBenchResult& result) {
  const Sheet<FrameRow> sheet = sheet_of(result);
  FrameBenchResult told = result;
  for (const FrameMean& mean : means_of(result))
    told.contestants.push_back(
        {mean.writer, mean.writer.starts_with("lantern") ? "" : result.cairo, how_of(mean.writer)});
  Document document = document_of(told, sheet);
  document.chapters.push_back(mean_chapter(result));
  document.chapters.push_back(start_chapter(result));
  return texts_of(result, sheet, document);
}

std::unique_ptr<Experiment> frames_bench(ScenarioFinder find) {
  return std::make_unique<FramesBench>(std::move(find));
}

}  // namespace lantern::report
