// What `bench frames` says: a table, CSV, JSON and a page.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "measure/records.hpp"
#include "report/bench_frames.hpp"
#include "report/bench_page.hpp"

namespace lantern::report {

template <class Visit>
void each_field(const FrameRow& row, Visit&& visit) {
  visit(Field("sequence"), row.sequence);
  visit(Field("writer"), row.writer);
  visit(Field("frames"), row.frames);
  visit(Field("frames_per_second"), row.frames_per_second);
  visit(Field("lower_quartile"), row.lower_quartile);
  visit(Field("upper_quartile"), row.upper_quartile);
  visit(Field("against_cairo"), row.against_cairo);
  visit(Field("bytes_per_file"), row.bytes_per_file);
  const auto counted = [](const std::optional<std::uint64_t>& count) {
    return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
  };
  visit(Field("pixels_drawn"), counted(row.pixels_drawn));
  visit(Field("bands_packed"), counted(row.bands_packed));
  visit(Field("bands_kept"), counted(row.bands_kept));
}

template <class Visit>
void each_field(const FrameMean& mean, Visit&& visit) {
  visit(Field("writer"), mean.writer);
  visit(Field("against_cairo"), mean.against_cairo);
  visit(Field("bytes_per_file"), mean.bytes_per_file);
}

template <class Visit>
void each_field(const StartTimes& s, Visit&& visit) {
  visit(Field("shaders_known"), s.shaders_known);
  visit(Field("bare_context_seconds"), s.bare_context);
  visit(Field("first_file_seconds"), s.first_file);
}

namespace {

std::string times_text(const std::optional<double>& times) {
  return times ? fmt::format("{:.2f}", *times) : "–";
}

// Of all pixels of the frames, and of all their bands.
std::string share_text(const std::optional<std::uint64_t>& part, double whole) {
  return part ? fmt::format("{:.0f}%", 100 * static_cast<double>(*part) / whole) : "–";
}
std::string drawn_text(const FrameRow& row, const FrameBenchConfig& c) {
  return share_text(row.pixels_drawn,
                    static_cast<double>(row.frames) * c.width * static_cast<double>(c.height));
}
std::string packed_text(const FrameRow& row) {
  return share_text(row.bands_packed,
                    static_cast<double>(row.bands_packed.value_or(0) + row.bands_kept.value_or(0)));
}

std::string start_name(const StartTimes& s) {
  return s.shaders_known ? "shaders in Mesa's cache" : "shaders never compiled yet";
}

std::string about(const FrameBenchResult& result) {
  const FrameBenchConfig& c = result.config;
  return fmt::format(
      "Pictures of {} x {} from draw list to file, only those that differ from the one before; "
      "{} threads encode. Writers take turns in {} rounds: medians, and times as fast as cairo on "
      "one thread in the same round.",
      c.width, c.height, c.threads, c.rounds);
}

}  // namespace

std::string to_table(const FrameBenchResult& result) {
  std::string text = about(result) + "\n" +
                     (result.cairo.empty() ? result.missing : "cairo " + result.cairo) + "\n\n";
  text += fmt::format("{:<24}{:<18}{:>7}{:>10}{:>20}{:>9}{:>12}{:>8}{:>8}\n", "", "", "frames",
                      "frames/s", "quartiles", "x cairo", "bytes/file", "drawn", "packed");
  std::string_view sequence;
  for (const FrameRow& row : result.rows) {
    text += fmt::format("{:<24}{:<18}{:>7}{:>10.1f}{:>20}{:>9}{:>12.0f}{:>8}{:>8}\n",
                        row.sequence == sequence ? "" : row.sequence, row.writer, row.frames,
                        row.frames_per_second,
                        fmt::format("{:.1f} ... {:.1f}", row.lower_quartile, row.upper_quartile),
                        times_text(row.against_cairo), row.bytes_per_file,
                        drawn_text(row, result.config), packed_text(row));
    sequence = row.sequence;
  }
  for (const FrameMean& mean : means_of(result)) {
    text += fmt::format("{:<24}{:<18}{:>37}{:>9}{:>12.0f}\n", sequence == "mean" ? "" : "mean",
                        mean.writer, "", times_text(mean.against_cairo), mean.bytes_per_file);
    sequence = "mean";
  }
  text += "\nfrom the start of a process, ms   bare context   first 1280 x 720 file   ratio\n";
  for (const StartTimes& s : result.starts)
    text += fmt::format("{:<34}{:>12.1f}{:>24.1f}{:>8.2f}\n", start_name(s), 1e3 * s.bare_context,
                        1e3 * s.first_file, s.first_file / s.bare_context);
  return text;
}

std::string to_csv(const FrameBenchResult& result) { return csv_of(result.rows); }

std::string to_json(const FrameBenchResult& result) {
  const FrameBenchConfig& c = result.config;
  const Circumstances& at = result.circumstances;
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.bench.frames/2");
  json.line().member("command", result.command);
  json.line().member("width", c.width).member("height", c.height);
  json.line().member("rounds", c.rounds).member("threads", c.threads);
  json.line().member("cairo", result.cairo);
  json.line().member("version", at.version).member("sources", at.sources);
  json.line().member("compiler", at.compiler).member("flags", at.flags);
  json.line().member("processor", at.processor);
  write_rows("rows", result.rows, json);
  write_rows("means", means_of(result), json);
  write_rows("starts", result.starts, json);
  json.line().end_object();
  return json.text() + "\n";
}

namespace {

std::vector<BenchContestant> contestants_of(const FrameBenchResult& result) {
  std::vector<BenchContestant> all;
  for (const FrameMean& mean : means_of(result)) {
    const bool ours = mean.writer.starts_with("lantern");
    const char* how =
        "The same shapes on an image surface, cairo's usual antialiasing, and "
        "cairo_surface_write_to_png.";
    if (ours && mean.writer.ends_with("fast"))
      how = "Draws what differs from the picture before, and packs the bands of rows that differ.";
    else if (ours)
      how = "Draws what differs from the picture before; libdeflate packs all of it.";
    all.push_back({mean.writer, ours ? "" : result.cairo, how});
  }
  return all;
}

// A point a sequence, by its number in the tables.
Plot plot_of(const BenchPage& page, const FrameBenchResult& result, bool bytes) {
  Plot plot;
  plot.title = bytes ? "How large the files are" : "How soon they are written";
  plot.x_name = "sequence, in the order of the tables";
  plot.y_name = bytes ? "bytes a file: down is better"
                      : "frames a second, quartiles as whiskers: up is better";
  plot.log_x = false;
  plot.log_y = !bytes;
  for (const FrameMean& mean : means_of(result)) {
    PlotSeries series = page.series_of(mean.writer);
    for (const FrameRow& row : result.rows) {
      if (row.writer != mean.writer) continue;
      const auto x = static_cast<double>(series.points.size() + 1);
      PlotPoint point{{x, bytes ? row.bytes_per_file : row.frames_per_second}};
      if (!bytes) point.spread = Box<2>{{x, row.lower_quartile}, {x, row.upper_quartile}};
      series.points.push_back(point);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

std::vector<BenchCell> cells_of(const FrameRow& row, const FrameBenchConfig& config) {
  return {{row.writer},
          {fmt::format("{:.1f}", row.frames_per_second)},
          {fmt::format("{:.1f} … {:.1f}", row.lower_quartile, row.upper_quartile)},
          {times_text(row.against_cairo)},
          {fmt::format("{:.0f}", row.bytes_per_file)},
          {drawn_text(row, config)},
          {packed_text(row)}};
}

std::string starts_text(const FrameBenchResult& result) {
  std::string text;
  for (const StartTimes& s : result.starts)
    text += fmt::format(
        "{}{}: a bare context {:.1f} ms, the first file of 1280 x 720 {:.1f} ms, {:.2f} times.",
        text.empty() ? "" : " ", start_name(s), 1e3 * s.bare_context, 1e3 * s.first_file,
        s.first_file / s.bare_context);
  return text;
}

}  // namespace

std::string to_html(const FrameBenchResult& result) {
  BenchPage page({"Frames to disk", about(result), result.command, result.circumstances},
                 contestants_of(result));
  page.begin_section("All sequences", "The mean counts each sequence as much.");
  page.add_plot(plot_of(page, result, false));
  page.add_plot(plot_of(page, result, true));
  std::vector<std::vector<BenchCell>> means;
  for (const FrameMean& mean : means_of(result))
    means.push_back({{mean.writer},
                     {times_text(mean.against_cairo)},
                     {fmt::format("{:.0f}", mean.bytes_per_file)}});
  page.add_table({"", "× cairo, mean", "bytes a file, mean"}, means);
  for (std::size_t i = 0; i < result.rows.size();) {
    const FrameRow& first = result.rows[i];
    std::vector<std::vector<BenchCell>> rows;
    for (; i < result.rows.size() && result.rows[i].sequence == first.sequence; ++i)
      rows.push_back(cells_of(result.rows[i], result.config));
    page.begin_section(first.sequence, fmt::format("{} frames.", first.frames));
    page.add_table(
        {"", "frames/s", "quartiles", "× cairo", "bytes a file", "pixels drawn", "bands packed"},
        rows);
  }
  page.begin_section("The first picture", "From the start of a process. " + starts_text(result));
  return page.text();
}

}  // namespace lantern::report
