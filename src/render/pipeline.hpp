// From images to PNG files: threads encode and write while the caller makes the next image. Bands
// of rows that are as in the image before are not encoded again. Knows no graphics library.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/file.hpp"
#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/image.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"

namespace lantern::render {

// The files are the same for every number of threads. An image equal to the one before it is
// encoded once; each file still has its own texts.
class EncodePool {
 public:
  struct Config {
    int width = 0, height = 0;  // of the images, pixels; bounds how many are under way
    PngEffort effort = PngEffort::fast;
    int pixels_per_metre = 0;
    int threads = 1;  // at least 1
    // Called after each file is in place, by one thread at a time, in no certain order. May be
    // empty.
    std::function<void(const fs::path&)> written;
  };

  // Counts each image encoded in `work`, which must outlive this. The calls below belong to one
  // thread.
  EncodePool(Config config, Work& work);

  // Without finish(): gives up what is not yet begun, and waits for the rest.
  ~EncodePool();

  // `image` becomes a file of this name, later; the caller may go on drawing upon it. `changed`
  // tells of each row whether it may differ from the image submitted before; of the first all may.
  // The file is sealed if it says what it was made `from`. Waits while too many are under way. An
  // error of an earlier file is thrown here or by finish(), as it was; after it nothing more is
  // written.
  void submit(const Image& image, const std::vector<bool>& changed, std::vector<PngText> texts,
              FilePlace place, std::optional<MadeFrom> from = std::nullopt);

  // Waits until every file is in place.
  void finish();

 private:
  struct Piece;
  struct Picture;
  struct Job {
    std::shared_ptr<Picture> picture;
    std::vector<PngText> texts;
    FilePlace place;
    std::optional<MadeFrom> from;
  };

  void wait_for_room();
  std::shared_ptr<Picture> picture_of(const Image& image, const std::vector<bool>& changed);
  Band free_band();
  std::string stream_of(Picture& picture);
  void encode_jobs(const std::stop_token& stop);
  void encode(const Job& job);
  void rethrow_locked() {
    if (error_) std::rethrow_exception(error_);
  }

  Config config_;
  Work& work_;
  std::shared_ptr<Picture> last_;  // submitted last

  std::mutex mutex_;
  std::mutex written_mutex_;  // held while `written` is called
  std::condition_variable_any job_ready_;
  std::condition_variable job_done_;
  std::deque<Job> jobs_;
  int busy_ = 0;  // jobs taken from the queue and not yet ended
  std::exception_ptr error_;
  std::size_t most_jobs_ = 0;     // waiting and busy
  std::vector<Band> free_bands_;  // kept for their memory
  std::vector<std::jthread> threads_;
};

// The files are the same for every number of threads. What is as in the picture before is neither
// drawn nor encoded again; each file still has its own texts.
class Pipeline {
 public:
  struct Config : EncodePool::Config {
    Theme theme;
    bool transparent = false;
  };

  // The renderer draws pictures of this size, perhaps for others before. Counts each frame drawn
  // and encoded in `work`. Both must outlive this, which belongs to the renderer's thread.
  Pipeline(Renderer& renderer, Config config, Work& work)
      : config_(std::move(config)), work_(work), renderer_(renderer), pool_(config_, work) {}

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
  Renderer& renderer_;
  EncodePool pool_;
};

}  // namespace lantern::render
