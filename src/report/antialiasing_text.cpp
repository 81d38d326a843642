#include <algorithm>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "draw/number_text.hpp"
#include "measure/records.hpp"
#include "report/antialiasing.hpp"
#include "report/page_parts.hpp"
#include "report/pareto.hpp"
#include "report/sentences.hpp"

namespace lantern::report {

template <class Visit>
void each_field(const PictureRow& row, Visit&& visit) {
  visit(Field("scene"), row.scene);
  visit(Field("part"), row.part);
  visit(Field("family"), row.family);
  visit(Field("choice"), row.choice);
  visit(Field("version"), row.version);
  visit(Field("", "width"), row.width);
  visit(Field("", "height"), row.height);
  visit(Field("edge_pixels", "edge_pixels", "error"), row.error.edge_pixels);
  visit(Field("mean", "error_mean", "error"), row.error.mean);
  visit(Field("rms", "error_rms", "error"), row.error.rms);
  visit(Field("worst", "error_worst", "error"), row.error.worst);
  visit(Field("strays", "strays", "error"), row.error.strays);
  each_timing(row.timing, "seconds", "iqr", "seconds_iqr", visit);
}

namespace {

double milliseconds(const PictureRow& row) { return 1e3 * row.timing.median; }
bool is_timed(const PictureRow& row) { return row.timing.repeats > 0; }

// "2 x 2" as a book prints it.
std::string printed(std::string choice) {
  if (const std::size_t at = choice.find(" x "); at != std::string::npos)
    choice.replace(at, 3, " × ");
  return choice;
}

double rms_of(const PictureRow* row) { return row->error.rms; }

// "coverage 2 × 2", "cairo best".
std::string way(const PictureRow& row) { return row.family + " " + printed(row.choice); }

const PictureRow* row_of(const PictureReport& report, const std::string& scene,
                         const std::string& family, const std::string& choice) {
  for (const PictureRow& row : report.rows)
    if (row.scene == scene && row.family == family && row.choice == choice && row.part.empty())
      return &row;
  return nullptr;
}

}  // namespace

Plot picture_plot(const PictureReport& report, const std::string& scene) {
  std::vector<const PictureRow*> rows;
  for (const PictureRow& row : report.rows)
    if (row.scene == scene && row.part.empty()) rows.push_back(&row);
  Plot plot;
  plot.title = fmt::format("Antialiasing of {} at {} × {}", scene, report.width, report.height);
  plot.size = 23;
  plot.x_name = "milliseconds a frame";
  plot.y_name = "error at edges (root mean square, levels of 255)";
  std::vector<Vec<2>> points;
  double least = 1e300, most = 0;
  for (const PictureRow* row : rows) {
    if (!is_timed(*row)) continue;
    if (plot.series.empty() || plot.series.back().name != row->family)
      plot.series.push_back(
          {row->family, {}, static_cast<int>(plot.series.size()), !row->version.empty()});
    points.push_back({milliseconds(*row), row->error.rms});
    plot.series.back().points.push_back({points.back(), false, printed(row->choice)});
    least = std::min(least, milliseconds(*row));
    most = std::max(most, milliseconds(*row));
  }
  for (const PictureRow* row : rows)
    if (!is_timed(*row) && most > 0)
      plot.guides.push_back(
          {row->choice == "1" ? "1 sample a pixel" : row->choice + " samples a pixel",
           {{least, row->error.rms}, {most, row->error.rms}}});
  for (const std::size_t i : pareto_front(points)) plot.front.push_back(points[i]);
  return plot;
}

std::string cheapest_picture(const PictureReport& report, const std::string& scene) {
  std::vector<const PictureRow*> rows;
  for (const PictureRow& row : report.rows)
    if (row.scene == scene && row.part.empty() && is_timed(row)) rows.push_back(&row);
  if (rows.empty()) return "No way of drawing was timed.";
  const double least = std::ranges::min(rows, {}, rms_of)->error.rms;
  double bound = 255;
  for (const double levels : {100.0, 50.0, 20.0, 10.0})
    if (least <= levels) bound = levels;
  std::vector<std::string> worse;  // each way is one run, so all that can be said of it is known
  for (const PictureRow* row : rows)
    if (row->error.rms > bound) worse.push_back(way(*row));
  std::erase_if(rows, [&](const PictureRow* row) { return row->error.rms > bound; });
  std::ranges::stable_sort(rows, {}, [](const PictureRow* row) { return row->timing.median; });
  const PictureRow* best = rows[0];
  std::erase_if(rows,
                [&](const PictureRow* row) { return !costs_the_same(best->timing, row->timing); });
  const bool many = rows.size() > 1;
  std::vector<std::string> names;
  for (const PictureRow* row : rows)
    names.push_back(fmt::format("{}{} {} ms a frame{} {} levels", way(*row), many ? " with" : ":",
                                short_number(milliseconds(*row)), many ? " and" : ", off by",
                                short_number(row->error.rms)));
  std::string text = fmt::format("The cheapest way{} under {} levels RMS {} {}", many ? "s" : "",
                                 bound, many ? "are" : "is", listed(names));
  if (many) text += ", which cost the same within the spread";
  if (!worse.empty())
    text += fmt::format("; {} {} farther off", listed(worse), worse.size() > 1 ? "are" : "is");
  return text + ".";
}

std::string picture_sentence(const PictureReport& report, const std::string& scene) {
  const PictureRow* own = row_of(report, scene, "coverage", "1 x 1");
  if (own == nullptr) return "";
  std::string text =
      fmt::format("{}: coverage is off by {} levels", scene, short_number(own->error.rms));
  if (is_timed(*own)) text += fmt::format(" in {} ms", short_number(milliseconds(*own)));
  const auto beside = [&](const char* family, const char* choice, const std::string& words) {
    const PictureRow* row = row_of(report, scene, family, choice);
    if (row == nullptr) return;
    text += fmt::format("; {} by {}", words, short_number(row->error.rms));
    if (is_timed(*row) && is_timed(*own))
      text += fmt::format(" in {} times the time",
                          short_number(row->timing.median / own->timing.median));
  };
  beside("coverage", "4 x 4", "drawn four times as large");
  beside("cairo", "default", "cairo");
  beside("samples", "4", "four samples a pixel");
  beside("samples", "1", "one sample");
  return text + ".";
}

DrawList draw_picture_page(const PictureReport& report, const std::string& scene,
                           const std::string& circumstances) {
  constexpr double kMargin = 60;
  DrawList list;
  Labels labels(list);
  const std::string small =
      fmt::format("Drawn by {}, against 16 × 16 sub-pixels a pixel · cairo: {} · {}",
                  report.backend, report.cairo, circumstances);
  const double foot =
      draw_page_foot(cheapest_picture(report, scene), {}, small, kMargin, list, labels);
  draw_plot(picture_plot(report, scene), {{kMargin, 40}, {list.page.x - kMargin, foot - 22}}, list,
            labels);
  return list;
}

std::string to_table(const PictureReport& report) {
  std::string text = fmt::format(
      "{} x {} pixels by {}, against 16 x 16 sub-pixels a pixel; cairo: {}\n"
      "error in levels of 255 over the pixels that an edge touches; milliseconds a frame\n",
      report.width, report.height, report.backend, report.cairo);
  for (const std::string& scene : report.scenes) {
    const PictureRow* first = row_of(report, scene, "coverage", "1 x 1");
    if (first == nullptr) continue;
    text += fmt::format("\n{}, {} pixels with edges\n", scene, first->error.edge_pixels);
    text += fmt::format("  {:<20}{:>8}{:>8}{:>8}{:>8}{:>10}{:>10}{:>8}\n", "", "mean", "rms",
                        "worst", "strays", "ms", "least", "iqr");
    for (const PictureRow& row : report.rows) {
      if (row.scene != scene) continue;
      const std::string name =
          row.part.empty() ? row.family + " " + row.choice : row.part + ", " + row.family;
      text += fmt::format("  {:<20}{:>8.3f}{:>8.3f}{:>8.1f}{:>8}", name, row.error.mean,
                          row.error.rms, row.error.worst, row.error.strays);
      text += is_timed(row) ? fmt::format("{:>10.2f}{:>10.2f}{:>8.2f}\n", milliseconds(row),
                                          1e3 * row.timing.least, 1e3 * row.timing.spread())
                            : fmt::format("{:>10}\n", "not timed");
    }
    text += "  " + cheapest_picture(report, scene) + "\n";
    text += "  " + picture_sentence(report, scene) + "\n";
  }
  return text;
}

std::string to_csv(const PictureReport& report) { return csv_of(report.rows); }

std::string to_json(const PictureReport& report) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.measure.pictures/1");
  json.line().member("width", report.width).member("height", report.height);
  json.line().member("sub_pixels", kReferenceTimes).member("backend", report.backend);
  json.line().member("cairo", report.cairo).line().key("sentences").begin_array();
  for (const std::string& scene : report.scenes) json.value(picture_sentence(report, scene));
  json.end_array().line().key("cheapest").begin_array();
  for (const std::string& scene : report.scenes) json.value(cheapest_picture(report, scene));
  write_rows("rows", report.rows, json.end_array());
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::report
