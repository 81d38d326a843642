// What an installation takes from the program: manual pages and completions.
#include <algorithm>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/command_line.hpp"
#include "app/command_words.hpp"
#include "app/commands.hpp"
#include "app/completions.hpp"
#include "app/manual.hpp"
#include "app/option_words.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"

namespace lantern::app {
namespace {

struct ManualOptions {
  std::vector<std::string> names;  // of a command; none for the program itself
  std::string folder;              // empty: one page is printed
};

int manual_command(CLI::App& app, ManualOptions options) {
  const CommandWords root = words_of(app);
  const std::vector<CommandPath> all = all_commands(root);
  if (!options.folder.empty()) {
    make_folder(options.folder);
    for (const CommandPath& path : all)
      write_file(std::filesystem::path(options.folder) / manual_file(path),
                 manual_page(path, root));
    return kGood;
  }
  options.names.insert(options.names.begin(), root.name);
  const auto found = std::ranges::find(all, options.names, &CommandPath::names);
  if (found == all.end())
    throw UsageError(fmt::format("there is no '{}'; 'lantern --help' names the commands",
                                 joined(options.names, " ")));
  write_stdout(manual_page(*found, root));
  return kGood;
}

void manual_options(CLI::App* c, CLI::App& app, Run& run) {
  const auto manual = std::make_shared<ManualOptions>();
  CLI::Option* names = c->add_option("COMMAND", manual->names,
                                     "the command; the default is all of "
                                     "Lantern");
  c->add_option("--dir", manual->folder, "write every page into this folder instead")
      ->excludes(names)
      ->type_name("DIR");
  c->callback(
      [&app, &run, manual] { run = [&app, manual] { return manual_command(app, *manual); }; });
}

void completions_options(CLI::App* c, CLI::App& app, Run& run) {
  const auto shell = std::make_shared<std::string>();
  c->add_option("SHELL", *shell, "the shell")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->required();
  c->callback([&app, &run, shell] {
    run = [&app, shell] {
      write_stdout(completions(*shell, words_of(app)));
      return int{kGood};
    };
  });
}

}  // namespace

void add_manual_commands(CLI::App& app, Run& run) {
  add_command(app, "man", "Print a command's manual page, or write all of them",
              [&app, &run](CLI::App* c) { manual_options(c, app, run); });
  add_command(app, "completions", "Print the completions of a shell",
              [&app, &run](CLI::App* c) { completions_options(c, app, run); });
}

}  // namespace lantern::app
