// From draw lists to PNG files: the caller's thread draws, others encode and write meanwhile.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/context.hpp"
#include "render/encode_pool.hpp"
#include "render/renderer.hpp"

namespace lantern::render {

// The files are the same for every number of threads. What is as in the picture before is neither
// drawn nor encoded again; each file still has its own texts.
class Pipeline {
 public:
  struct Config : EncodePool::Config {
    Theme theme;
    bool transparent = false;
  };

  // Counts the context, and each frame drawn and encoded, in `work`, which must outlive this.
  // Belongs to the calling thread, like the context.
  Pipeline(std::unique_ptr<Context> context, Config config, Work& work)
      : config_(std::move(config)),
        work_(work),
        renderer_(std::move(context), config_.width, config_.height),
        pool_(config_, work) {
    ++work_.graphics_contexts;
  }

  // Draws at once; the file appears later. Waits while too many pictures are under way. An error of
  // an earlier file is thrown here or by finish(), as it was; after it nothing more is written.
  // The file is sealed if it says what it was made `from`.
  void submit(const DrawList& list, std::vector<PngText> texts, FilePlace place,
              std::optional<MadeFrom> from = std::nullopt) {
    const Drawn drawn = renderer_.draw(list, config_.theme, config_.transparent);
    ++work_.frames_drawn;
    work_.pixels_drawn += static_cast<std::uint64_t>(drawn.pixels);
    pool_.submit(drawn.image, drawn.changed, std::move(texts), std::move(place), std::move(from));
  }

  // Waits until every file is in place.
  void finish() { pool_.finish(); }

 private:
  Config config_;
  Work& work_;
  Renderer renderer_;
  EncodePool pool_;
};

}  // namespace lantern::render
