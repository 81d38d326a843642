#include "render/pipeline.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"

namespace lantern::render {

namespace {

// Pictures under way take at most this much memory, unless two are already more.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

// What one thread does and the others wait for; if it throws, the next one tries. Unlike
// std::call_once it can be watched by the thread sanitizer, which lets nobody in after a throw.
class Once {
 public:
  void call(const auto& function) {
    const std::lock_guard lock(mutex_);
    if (done_) return;
    function();
    done_ = true;
  }

 private:
  std::mutex mutex_;
  bool done_ = false;
};

}  // namespace

// A band of rows, shared by the pictures in which it is the same.
struct EncodePool::Piece {
  Band band;
  bool is_opaque = true;
  Once once;
  PackedBand packed;  // once encoded
};

struct EncodePool::Picture {
  int channels = 3;
  std::vector<std::shared_ptr<Piece>> pieces;  // from the uppermost down
  Once once;
  PngBody body;  // once encoded
};

EncodePool::EncodePool(Config config, Work& work) : config_(std::move(config)), work_(work) {
  const auto threads = static_cast<std::size_t>(std::max(1, config_.threads));
  // One being drawn, the last one, of whose bands the next may consist, one or two for each thread.
  const std::size_t bytes = std::size_t{4} * config_.width * config_.height;
  const std::uint64_t most = std::min<std::uint64_t>(kMostBytes, memory_budget() / 4);
  most_jobs_ = std::clamp<std::size_t>(most / bytes, 3, 2 + 2 * threads) - 2;
  // The driver's own, and for each thread that has one to encode the rows and the packed bytes.
  require_memory(bytes * (3 + most_jobs_ + 2 * std::min(threads, most_jobs_)),
                 fmt::format("pictures of {} x {} pixels under way", config_.width, config_.height),
                 "draw smaller ones (--size)");
  for (std::size_t i = 0; i < threads; ++i) try {
      threads_.emplace_back([this](const std::stop_token& stop) { encode_jobs(stop); });
    } catch (const std::system_error& error) {
      if (threads_.empty()) throw IoError("cannot start a thread: {}", error.code().message());
      break;  // the machine gives no more: those there are do all
    }
}

EncodePool::~EncodePool() {
  {
    const std::lock_guard lock(mutex_);
    jobs_.clear();
  }
  threads_.clear();  // stops and joins them
}

void EncodePool::wait_for_room() {
  std::unique_lock lock(mutex_);
  job_done_.wait(lock, [this] {
    return error_ || jobs_.size() + static_cast<std::size_t>(busy_) < most_jobs_;
  });
  rethrow_locked();
}

Band EncodePool::free_band() {
  const std::lock_guard lock(mutex_);
  if (free_bands_.empty()) return {};
  Band band = std::move(free_bands_.back());
  free_bands_.pop_back();
  return band;
}

// Of the last picture's pieces those that are the same, and new ones.
std::shared_ptr<EncodePool::Picture> EncodePool::picture_of(const Image& image,
                                                            const std::vector<bool>& changed) {
  auto picture = std::make_shared<Picture>();
  const auto count = static_cast<std::size_t>((image.height + kBandRows - 1) / kBandRows);
  picture->pieces.resize(count);
  const auto renew = [&](std::size_t i) {
    auto piece = std::make_shared<Piece>();
    piece->band = free_band();
    take_band(image, static_cast<int>(i) * kBandRows, piece->band);
    piece->is_opaque = piece->band.is_opaque;
    picture->pieces[i] = std::move(piece);
  };
  const auto differs = [&](std::size_t i) {  // the row above counts, too
    const auto first = changed.begin() + static_cast<std::ptrdiff_t>(i * kBandRows);
    const auto last = first + std::min<std::ptrdiff_t>(kBandRows, changed.end() - first);
    return std::find(i > 0 ? first - 1 : first, last, true) != last;
  };
  for (std::size_t i = 0; i < count; ++i)
    if (!last_ || differs(i))
      renew(i);
    else
      picture->pieces[i] = last_->pieces[i];
  const bool is_opaque =
      std::ranges::all_of(picture->pieces, [](const auto& piece) { return piece->is_opaque; });
  picture->channels = is_opaque ? 3 : 4;
  std::size_t kept = 0;
  for (std::size_t i = 0; last_ && i < count; ++i) {
    if (picture->pieces[i] != last_->pieces[i]) continue;
    // What was packed without alpha is of no use beside what has some.
    if (picture->channels != last_->channels)
      renew(i);
    else
      ++kept;
  }
  if (last_ && kept == count) return last_;
  ++work_.frames_encoded;
  if (config_.effort == PngEffort::small) kept = 0;  // all of it is packed in one
  work_.bands_packed += count - kept;
  work_.bands_kept += kept;
  return picture;
}

void EncodePool::submit(const Image& image, const std::vector<bool>& changed,
                        std::vector<PngText> texts, FilePlace place, std::optional<MadeFrom> from) {
  LANTERN_CHECK(changed.size(), ==, static_cast<std::size_t>(image.height));
  wait_for_room();
  last_ = picture_of(image, changed);
  const std::lock_guard lock(mutex_);
  rethrow_locked();
  jobs_.push_back({last_, std::move(texts), std::move(place), std::move(from)});
  job_ready_.notify_one();
}

void EncodePool::finish() {
  std::unique_lock lock(mutex_);
  job_done_.wait(lock, [this] { return error_ || (jobs_.empty() && busy_ == 0); });
  rethrow_locked();
}

void EncodePool::encode_jobs(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (job_ready_.wait(lock, stop, [this] { return !jobs_.empty(); })) {
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    ++busy_;
    lock.unlock();
    std::exception_ptr error;
    try {
      encode(job);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    job.picture.reset();
    --busy_;
    if (error) {
      if (!error_) error_ = error;
      jobs_.clear();
    }
    job_done_.notify_all();
  }
}

std::string EncodePool::stream_of(Picture& picture) {
  if (config_.effort == PngEffort::small) {
    std::vector<const Band*> bands;
    for (const auto& piece : picture.pieces) bands.push_back(&piece->band);
    return small_stream(bands, picture.channels);
  }
  BandStream stream;
  for (const auto& piece : picture.pieces) {
    piece->once.call([&] {
      piece->packed = pack(piece->band, picture.channels);
      const std::lock_guard lock(mutex_);
      free_bands_.push_back(std::move(piece->band));
    });
    stream.add(piece->packed);
  }
  return stream.finish();
}

void EncodePool::encode(const Job& job) {
  Picture& picture = *job.picture;
  picture.once.call([&] {
    picture.body = png_body(config_.width, config_.height, picture.channels, stream_of(picture));
  });
  std::string png = assemble(picture.body, job.texts, config_.pixels_per_metre);
  if (job.from) png = sealed(FileKind::png, std::move(png), *job.from);
  write_file(job.place, png);
  work_.bytes_written += png.size();
  ++work_.frames_written;
  if (!config_.written) return;
  const std::lock_guard lock(written_mutex_);
  config_.written(job.place.path());
}

}  // namespace lantern::render
