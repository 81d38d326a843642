#include "render/pipeline.hpp"

namespace lantern {
Pipeline::Pipeline(std::unique_ptr<Context> context, Config config, Work& work)
    : config_(std::move(config)),
      work_(work),
      renderer_(std::move(context), config_.width, config_.height),
      pool_(config_, work) {
  ++work_.graphics_contexts;
}

void Pipeline::submit(const DrawList& list, std::vector<PngText> texts, std::filesystem::path path,
                      std::optional<MadeFrom> from) {
  renderer_.draw(list, config_.theme, config_.transparent, pool_.blank());
  ++work_.frames_drawn;
  pool_.submit(std::move(texts), std::move(path), std::move(from));
}

}  // namespace lantern
