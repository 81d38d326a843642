// From images to PNG files: threads encode and write while the caller makes the next image. Knows
// no graphics library.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "base/work.hpp"
#include "render/image.hpp"
#include "render/png.hpp"
#include "render/seal.hpp"

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
    std::function<void(const std::filesystem::path&)> written;
  };

  // Counts each image encoded in `work`, which must outlive this. The calls below belong to one
  // thread.
  EncodePool(Config config, Work& work);

  // Without finish(): gives up what is not yet begun, and waits for the rest.
  ~EncodePool();

  // An image to be drawn upon, of whatever it was before. Waits while too many are under way. An
  // error of an earlier file is thrown here, by submit() or by finish(), as it was; after it
  // nothing more is written.
  Image& blank();

  // What blank() gave last becomes a file, later. It is sealed if it says what it was made `from`.
  void submit(std::vector<PngText> texts, std::filesystem::path path,
              std::optional<MadeFrom> from = std::nullopt);

  // Waits until every file is in place.
  void finish();

 private:
  struct Picture;
  struct Job {
    std::shared_ptr<Picture> picture;
    std::vector<PngText> texts;
    std::filesystem::path path;
    std::optional<MadeFrom> from;
  };

  std::shared_ptr<Picture> free_picture();
  void encode_jobs(const std::stop_token& stop);
  void encode(const Job& job);
  void rethrow_locked() {
    if (error_) std::rethrow_exception(error_);
  }

  Config config_;
  Work& work_;
  std::shared_ptr<Picture> blank_;  // given to be drawn upon
  std::shared_ptr<Picture> last_;   // submitted last

  std::mutex mutex_;
  std::mutex written_mutex_;  // held while `written` is called
  std::condition_variable_any job_ready_;
  std::condition_variable job_done_;  // a job ended: a picture may be free, or all may be done
  std::deque<Job> jobs_;
  int busy_ = 0;  // jobs taken from the queue and not yet ended
  std::exception_ptr error_;
  std::size_t most_pictures_ = 0;
  std::vector<std::shared_ptr<Picture>> pictures_;  // one that only this list holds is free
  std::vector<std::jthread> threads_;
};

}  // namespace lantern::render
