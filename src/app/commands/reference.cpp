// The reference page, its pictures, and the schemas.
#include "language/reference.hpp"

#include <set>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "draw/page.hpp"
#include "embedded/output_schema.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/seal.hpp"
#include "render/svg.hpp"
#include "run/director.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

struct ReferenceOptions {
  std::string pictures;  // folder; empty: the page is printed
  std::string backend = "auto";
  bool json = false;
};

Options reference_options(ReferenceOptions& o) {
  return {{"--pictures", &o.pictures, "draw the page's pictures into this folder instead",
           OptionTraits{.value = "DIR"}},
          backend_option(o.backend),
          json_option(o.json)};
}

struct SchemaOptions {
  std::string of = "scenario";
};

Options schema_options(SchemaOptions& o) {
  return {{"--of", &o.of, "scenario files, or what commands print with --json",
           OptionTraits{.words = {"scenario", "output"}}}};
}

int print_schema(const SchemaOptions& o) {
  write_stdout(o.of == "output" ? std::string(output::output_schema_json) : json_schema());
  return kGood;
}

constexpr int kWidth = 320, kHeight = 180;  // pixels

Frame last_frame(const Scenario& scenario) {
  Work work;
  Frame last;
  direct(scenario, scenario.pace, work, [&](const Frame& frame) {
    stop_if_asked();
    last = frame;
    return true;
  });
  return last;
}

// What a picture is made from: the frame, and every shape that is drawn of it.
MadeFrom made_from_all(const Frame& frame, const DrawList& list, const Theme& theme) {
  const auto key = [](std::string_view text) {
    return fmt::format("{:016x}", Hash().add(text).value());
  };
  return {key(to_json(frame)), key(to_svg(list, theme, false, kWidth, kHeight))};
}

// Is it there, as it would be made now?
bool is_right(const fs::path& path, const MadeFrom& from) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 20;
  std::error_code error;
  return fs::is_regular_file(path, error) &&
         made_from(FileKind::png, read_file(path, kMostBytes)) == from;
}

int draw_pictures(const ReferenceOptions& options) {
  const fs::path folder = options.pictures;
  make_folder(folder);
  const Theme theme = *theme_named("light");
  constexpr int kPixelsPerMetre = 6299;
  std::optional<Renderer> renderer;  // made when the first picture is not there yet
  Image image;
  std::set<std::string> names;
  std::size_t drawn = 0;
  for (const ExamplePicture& picture : example_pictures()) {
    const Frame frame = last_frame(parse_scenario(picture.text, picture.name + ".toml"));
    Work work;
    const DrawList list = draw_frame(frame, page_for(kWidth, kHeight), work);
    const MadeFrom from = made_from_all(frame, list, theme);
    const fs::path path = folder / (picture.name + ".png");
    names.insert(path.filename().string());
    if (is_right(path, from)) continue;
    if (!renderer)
      renderer.emplace(Context::create(*backend_named(options.backend)), kWidth, kHeight);
    renderer->draw(list, theme, false, image);
    write_file(path, sealed(FileKind::png, encode_png(image, PngEffort::small, {}, kPixelsPerMetre),
                            from));
    ++drawn;
  }
  if (options.json)
    answer(answer_of("reference")
               .lines("folder", folder.string(), "pictures", names.size(), "drawn", drawn)
               .line()
               .end_object()
               .text());
  else
    print(fmt::format("{}: {}, {} of them new\n", folder.string(), counted(names.size(), "picture"),
                      drawn));
  return kGood;
}

int print_reference(const ReferenceOptions& options) {
  if (!options.pictures.empty()) return draw_pictures(options);
  if (options.json)
    answer(answer_of("reference")
               .line()
               .member("markdown", reference_page())
               .line()
               .end_object()
               .text());
  else
    write_stdout(reference_page());
  return kGood;
}

}  // namespace

Command reference_command() {
  return command("reference", "Print the scenario language's reference page (Markdown)",
                 print_reference, reference_options);
}

Command schema_command() {
  return command("schema", "Print a JSON Schema", print_schema, schema_options);
}

}  // namespace lantern::app
