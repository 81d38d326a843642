#include "fuzz/search.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <dlfcn.h>
#include <execinfo.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/memory.hpp"
#include "fuzz/desk.hpp"
#include "fuzz/generate.hpp"
#include "fuzz/trial.hpp"

extern "C" void __gcov_dump() __attribute__((weak));  // of a build with coverage

namespace lantern::fuzz {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// With counters and not optimized, reading takes sixty times as long.
const bool kSlow = kSanitized || __gcov_dump;
const auto kPatience = kSlow ? 300ms : 50ms;     // of a stage, before the wish to stop
const auto kGrace = kSlow ? 10s : 1s;            // from the wish to its end
constexpr std::uint64_t kMostMemory = 1u << 30;  // bytes that a file may take
constexpr double kEnergyGrowth = 0.1;            // from which it is told
constexpr std::size_t kMostKept = 6000;          // bytes of an interesting file
constexpr int kMostMendings = 8;
constexpr std::uint64_t kTold = 50'000;  // files after which it says how far it is
constexpr int kHung = 71;                // exit code of a worker

Desk* desk = nullptr;  // of the signal handler

// --- the worker ---

void note_crash(int number) {
  void* frames[48];
  const int depth = ::backtrace(frames, 48);
  Dl_info self{};
  ::dladdr(reinterpret_cast<void*>(&note_crash), &self);
  std::size_t noted = 0;
  for (int i = 1; i < depth && noted < desk->stack.size(); ++i) {
    Dl_info info{};
    if (::dladdr(frames[i], &info) == 0 || info.dli_fbase != self.dli_fbase) continue;
    desk->stack[noted++] = static_cast<std::uint64_t>(static_cast<char*>(frames[i]) -
                                                      static_cast<char*>(self.dli_fbase));
  }
  std::signal(number, SIG_DFL);
  ::raise(number);
}

void catch_crashes() {
  static char stack[1 << 16];
  const stack_t other{stack, 0, sizeof stack};
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = note_crash;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL})
    ::sigaction(number, &action, nullptr);
  void* warm[1];
  ::backtrace(warm, 1);  // loads what it needs
}

void save(const fs::path& folder, const std::string& name, std::string_view text) {
  if (folder.empty()) return;
  make_folder(folder);
  write_file(folder / (name + ".toml"), text);
}

std::string place_of_number(const SearchOptions& options) {
  return fmt::format("{}_{}_{}", to_string(static_cast<Stage>(desk->stage.load())), options.seed,
                     desk->number.load());
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  if (!folder.empty() && fs::is_directory(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) texts.push_back(read_file(path, 1 << 22));
  return texts;
}

class Worker {
 public:
  Worker(const SearchOptions& options, double seconds_left)
      : options_(options),
        seconds_left_(seconds_left),
        corpus_(files_in(options.corpus)),
        seeds_(corpus_),
        watch_(kPatience, kGrace, [] { ::_exit(kHung); }),
        trial_(
            watch_, [](Stage stage) { desk->stage = static_cast<int>(stage); },
            [](std::string_view use) { note_use(use); }) {
    set_memory_budget(kMostMemory);
    for (const fs::path& folder : {fs::path(LANTERN_ROOT "/scenarios"), options.keep})
      for (std::string& text : files_in(folder)) seeds_.push_back(std::move(text));
    if (!kSanitized) {
      catch_crashes();
      enforce_memory_budget();
    }
  }

  void work() {
    for (; !is_over(); ++desk->number) {
      const std::uint64_t number = desk->number;
      Dice dice(Hash().add(options_.seed).add(number).value());
      if (number < corpus_.size())
        attempt(corpus_[number], dice);
      else if (dice.chance(0.01))
        attempt(random_bytes(dice), dice);
      else if (dice.chance(0.5))
        make_one(dice);
      else
        change_one(dice);
    }
    desk->finished = true;
  }

 private:
  bool is_over() const {
    if (desk->finished) return true;  // Ctrl-C
    if (options_.rounds > 0 && desk->files >= options_.rounds && desk->number >= corpus_.size())
      return true;
    return options_.minutes > 0 && clock_.seconds() > seconds_left_;
  }

  static void note_use(std::string_view use) {
    const auto& all = all_uses();
    const auto found = std::lower_bound(all.begin(), all.end(), use);
    if (found != all.end() && *found == use)
      ++desk->used[static_cast<std::size_t>(found - all.begin())];
  }

  static std::string random_bytes(Dice& dice) {
    const bool ascii = dice.chance(0.5);
    std::string text(dice.index(200), ' ');
    for (char& c : text) c = static_cast<char>(ascii ? dice.whole(9, 126) : dice.whole(0, 255));
    return text;
  }

  // From nothing; once it is right, it is spoilt a little.
  void make_one(Dice& dice) {
    Document document = made_scenario(dice);
    if (!mended(document, dice) || dice.chance(0.5)) return;
    for (std::int64_t edits = dice.whole(1, 2); edits > 0; --edits) spoil(document, document, dice);
    attempt(document.text(), dice);
  }

  // From a file that there is.
  void change_one(Dice& dice) {
    Document document = document_of(dice.pick(seeds_));
    const Document other = document_of(dice.pick(seeds_));
    if (dice.chance(0.95)) shrink(document, dice);
    do spoil(document, other, dice);
    while (dice.chance(0.5));
    if (dice.chance(0.4)) {
      mended(document, dice);
      return;
    }
    std::string text = document.text();
    if (dice.chance(0.3))
      for (std::int64_t edits = dice.whole(1, 4); edits > 0; --edits) spoil_bytes(text, dice);
    attempt(text, dice);
  }

  // Tries it, and again without what was wrong. True once it runs.
  bool mended(Document& document, Dice& dice) {
    for (int i = 0; i < kMostMendings; ++i) {
      const std::optional<TrialResult> result = attempt(document.text(), dice);
      if (!result) return false;
      if (result->mistakes.empty()) return result->ran;
      if (!mend(document, result->mistakes, i, dice)) return false;
    }
    return false;
  }

  // Nothing for a file that is too long, or that breaks something.
  std::optional<TrialResult> attempt(const std::string& text, Dice& dice) {
    if (text.size() > kMostText) return std::nullopt;
    std::copy(text.begin(), text.end(), desk->text.begin());
    desk->size = text.size();
    if (++desk->files % kTold == 0)
      fmt::print(stderr, "fuzz: {} files, {} crashes, {} hangs, {} broken promises\n",
                 desk->files.load(), desk->crashes.load(), desk->hangs.load(), desk->broken.load());
    try {
      TrialResult result = trial_.run(text, dice);
      count(result);
      keep(result, text);
      return result;
    } catch (const std::exception& e) {
      ++desk->broken;
      const std::string_view stage = to_string(static_cast<Stage>(desk->stage.load()));
      const bool first =
          desk->tell(fmt::format("{} {}", stage, kind_of(e.what())),
                     fmt::format("{} ({}): {}", stage, place_of_number(options_), e.what()));
      if (first) fmt::print(stderr, "fuzz: {}: {}\n", place_of_number(options_), e.what());
      if (first) save(options_.findings, "broken_" + place_of_number(options_), text);
      return std::nullopt;
    }
  }

  void count(const TrialResult& result) {
    desk->good += result.good;
    desk->ran += result.ran;
    desk->drawn += result.drawn;
    desk->measured += result.measured;
    desk->stopped += result.stopped;
    const double slowest = std::chrono::duration<double>(watch_.slowest()).count();
    desk->slowest_stop = std::max(desk->slowest_stop.load(), slowest);
    if (!(result.energy_growth > kEnergyGrowth)) return;
    ++desk->energy;
    if (result.energy_growth < 1.5 * desk->worst_energy) return;
    desk->worst_energy = result.energy_growth;
    fmt::print(stderr, "fuzz: {}: energy grows by {:.3g} times what there was\n",
               place_of_number(options_), result.energy_growth);
    save(options_.findings, "energy_" + place_of_number(options_),
         std::string_view(desk->text.data(), desk->size));
  }

  void keep(const TrialResult& result, const std::string& text) {
    bool interesting = false;
    for (const std::uint64_t feature : result.features)
      interesting = desk->note(feature) || interesting;
    if (!interesting || text.size() > kMostKept || desk->number < corpus_.size()) return;
    seeds_.push_back(text);
    save(options_.keep, fmt::format("{:016x}", Hash().add(text).value()), text);
  }

  const SearchOptions& options_;
  double seconds_left_;
  Stopwatch clock_;
  std::vector<std::string> corpus_, seeds_;
  Watch watch_;
  Trial trial_;
};

// --- the search ---

std::string name_of(std::uint64_t place) {
  const std::string command =
      fmt::format("addr2line -Cfe /proc/{}/exe {:#x} 2>/dev/null", ::getpid(), place - 1);
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return {};
  char line[200] = {};
  const bool read = std::fgets(line, sizeof line, pipe) != nullptr;
  ::pclose(pipe);
  const std::string name(line);
  return read ? name.substr(0, name.find_first_of("(\n")) : std::string();
}

// The worker has ended in the midst of a file: tells why, and keeps the file.
void note_death(const SearchOptions& options, int status) {
  const bool hung = WIFEXITED(status) && WEXITSTATUS(status) == kHung;
  ++(hung ? desk->hangs : desk->crashes);
  const std::string place = place_of_number(options);
  const std::string_view stage = to_string(static_cast<Stage>(desk->stage.load()));
  std::string why = hung                  ? "hang"
                    : WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                          : fmt::format("exit code {}", WEXITSTATUS(status));
  for (auto& frame : desk->stack) {
    if (!hung && frame != 0) why += " < " + name_of(frame);
    frame = 0;
  }
  const std::string line = fmt::format("{} ({}): {}", stage, place, why);
  if (!desk->tell(fmt::format("{} {}", stage, why), line) && !hung) return;
  fmt::print(stderr, "fuzz: {}\n", line);
  save(options.findings, (hung ? "hang_" : "crash_") + place,
       std::string_view(desk->text.data(), desk->size));
}

SearchReport report_of(double seconds) {
  SearchReport report;
  report.files = desk->files;
  report.good = desk->good;
  report.ran = desk->ran;
  report.drawn = desk->drawn;
  report.measured = desk->measured;
  report.stopped = desk->stopped;
  report.crashes = desk->crashes;
  report.hangs = desk->hangs;
  report.broken = desk->broken;
  report.energy = desk->energy;
  report.seconds = seconds;
  report.slowest_stop = desk->slowest_stop;
  for (std::size_t i = 0; i < all_uses().size(); ++i) report.used[all_uses()[i]] = desk->used[i];
  for (const Told& told : desk->told)
    if (told.times > 0)
      report.told.push_back(fmt::format("{} × {}", told.times.load(), told.line.data()));
  return report;
}

}  // namespace

SearchReport search(const SearchOptions& options) {
  static Desk& shared = shared_desk();
  desk = new (&shared) Desk;
  desk->number = options.first;
  std::signal(SIGINT, [](int) { desk->finished = true; });  // what was found until then is told
  const Stopwatch clock;
  while (!desk->finished) {
    const double left = 60 * options.minutes - clock.seconds();
    const pid_t worker = ::fork();
    if (worker == 0) {
      try {
        Worker(options, left).work();
      } catch (const std::exception& e) {
        fmt::print(stderr, "fuzz: {}\n", e.what());
        desk->finished = true;
        ++desk->broken;
      }
      std::fflush(stderr);
      if (__gcov_dump) __gcov_dump();  // _exit does not
      ::_exit(0);
    }
    if (worker < 0) throw std::runtime_error("cannot start a process");
    int status = 0;
    while (::waitpid(worker, &status, 0) < 0 && errno == EINTR) {
    }
    if (desk->finished) break;
    note_death(options, status);
    ++desk->number;
  }
  return report_of(clock.seconds());
}

std::string to_text(const SearchReport& r) {
  std::string text = fmt::format(
      "{} files in {:.0f} s ({:.2f} ms each): {} good, {} ran to their end, {} drawn, {} measured, "
      "{} stopped in time (the slowest heard it after {:.3f} s)\n"
      "{} crashes, {} hangs, {} broken promises; in {} scenes energy grew\n",
      r.files, r.seconds,
      1e3 * r.seconds / static_cast<double>(std::max<std::uint64_t>(1, r.files)), r.good, r.ran,
      r.drawn, r.measured, r.stopped, r.slowest_stop, r.crashes, r.hangs, r.broken, r.energy);
  for (const std::string& line : r.told) text += "  " + line + "\n";
  text += "how many good files used each verb and key:\n";
  std::vector<std::string> never;
  for (const auto& [use, times] : r.used) {
    if (times == 0)
      never.push_back(use);
    else
      text += fmt::format("{:>9} {}\n", times, use);
  }
  text += fmt::format("never used: {} of {}\n", never.size(), r.used.size());
  for (const std::string& use : never) text += "          " + use + "\n";
  return text;
}

}  // namespace lantern::fuzz
