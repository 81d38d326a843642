#include "report/measure_tables.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "report/problem_rows.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

constexpr std::size_t kLineWidth = 100;

// Terminal cells of a text: characters, not bytes.
std::size_t cells(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string cell(std::string text, std::size_t width, bool right) {
  while (cells(text) > width) {
    while ((static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
    text.pop_back();
  }
  const std::string gap(width - cells(text), ' ');
  return right ? gap + text : text + gap;
}

std::string line(const std::vector<std::string>& fields) {
  constexpr std::size_t kWidths[] = {27, 7, 6, 10, 9, 10, 12, 11};
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i)
    text += (i > 0 ? " " : "") + cell(fields[i], kWidths[i], i > 0 && i < 7);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text + "\n";
}

std::string line_for(const MethodRows& c, const WorkCount& work) {
  const Row* best = nullptr;
  std::array<std::size_t, kStatusNames.size()> ended{};
  for (const Row& row : c.rows) {
    ++ended[static_cast<std::size_t>(row.status)];
    const auto error = row.error();
    if (error && (!best || *error < *best->error())) best = &row;
  }
  std::string status;  // the worst that happened
  for (const Status s :
       {Status::left_out, Status::nan, Status::refused, Status::diverged, Status::collapsed})
    if (ended[static_cast<std::size_t>(s)] > 0) status = to_string(s);
  const auto order = c.is_peer && c.rows.size() < 3 ? std::nullopt : observed_order(c.rows);
  const auto seconds = best ? seconds_of(*best) : std::nullopt;
  const auto count = best ? work.of(*best) : std::nullopt;
  const std::string name = c.is_peer ? c.name() : c.method;  // without "(double)"
  return line({name.substr(0, name.find(" (")), fmt::format("{}/{}", ended[0], c.rows.size()),
               order ? fmt::format("{:.2f}", *order) : "-", best ? figure(*best->error()) : "-",
               best ? figure(best->step) : "-", seconds ? seconds_text(*seconds) : "-",
               count ? fmt::format("{:.0f}", *count) : "-", status});
}

// No wider than its column.
std::string short_name(const std::string& work) {
  if (work == "force evaluations") return "force evals";
  return work == "constraint rows" ? "constr. rows" : work;
}

// Broken at spaces.
std::string folded(const std::string& text) {
  std::string out, row;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, to - from);
    if (!row.empty() && cells(row) + 1 + cells(word) > kLineWidth) {
      out += row + "\n";
      row.clear();
    }
    row += (row.empty() ? "" : " ") + word;
    from = to + 1;
  }
  return out + row + "\n";
}

}  // namespace

std::string to_table(const Measurement& measurement) {
  std::string text;
  for (const ProblemRows& problem : by_problem(measurement.rows)) {
    const WorkCount work = work_count(problem);
    const std::string norm = main_norm(problem);
    text += fmt::format("{}{} ({}, {})\n", text.empty() ? "" : "\n", problem.problem,
                        problem.family, problem.variant);
    text += line({"method", "runs ok", "order", norm.empty() ? "error" : norm, "at h", "time",
                  short_name(work.name), "not ok"});
    for (const MethodRows& c : by_method(problem)) text += line_for(c, work);
    for (const std::string& note : notes_on(problem)) text += folded(note);
  }
  return text;
}

}  // namespace lantern::report
