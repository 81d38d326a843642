// A web page of a bench that stands alone: contestants to be shown or hidden, how it was run, and
// sections of plots and tables.
#pragma once

#include <string>
#include <vector>

#include "draw/plot.hpp"
#include "measure/row.hpp"

namespace lantern::report {

struct BenchContestant {
  std::string name, version;  // no version: ours
  std::string how;            // a sentence; may be empty
  bool is_peer() const { return !version.empty(); }
};

struct BenchPageHead {
  std::string title;
  std::string about;    // a paragraph
  std::string command;  // that made it
  Circumstances circumstances;
};

struct BenchCell {
  std::string text;
  bool bad = false;
};

class BenchPage {
 public:
  BenchPage(BenchPageHead head, std::vector<BenchContestant> contestants);

  void begin_section(const std::string& title, const std::string& words);
  // The look of a contestant is the same in every plot. Series are told apart by their names, which
  // must be contestants'.
  PlotSeries series_of(const std::string& contestant) const;
  // Beside the plots of this section so far.
  void add_plot(const Plot& plot);
  // Each row begins with a contestant's name, numbers follow; what is bad is stressed.
  void add_table(const std::vector<std::string>& columns,
                 const std::vector<std::vector<BenchCell>>& rows);

  std::string text() const;

 private:
  std::size_t number_of(const std::string& contestant) const;
  void end_plots();
  std::string head_text() const;

  BenchPageHead head_;
  std::vector<BenchContestant> contestants_;
  std::string body_;
  bool in_section_ = false, in_plots_ = false;
};

}  // namespace lantern::report
