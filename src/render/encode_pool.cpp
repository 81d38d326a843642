#include "render/encode_pool.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "render/png.hpp"

namespace lantern::render {
namespace {

// Pictures under way take at most this much memory, unless two are already more.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

// Files that wait: many only while equal pictures follow each other.
constexpr std::size_t kMostJobs = 64;

}  // namespace

struct EncodePool::Picture {
  Image image;
  std::unique_ptr<std::once_flag> encoded = std::make_unique<std::once_flag>();
  PngBody body;  // once encoded
};

EncodePool::EncodePool(Config config, Work& work) : config_(std::move(config)), work_(work) {
  const auto threads = static_cast<std::size_t>(std::max(1, config_.threads));
  // One being drawn, the last one to compare with, one or two for each thread.
  const std::size_t bytes = std::size_t{4} * config_.width * config_.height;
  const std::uint64_t most = std::min<std::uint64_t>(kMostBytes, memory_budget() / 4);
  most_pictures_ = std::clamp<std::size_t>(most / bytes, 2, 2 + 2 * threads);
  // The driver's own, and for each thread that has one to encode the filtered and the packed bytes.
  require_memory(bytes * (1 + most_pictures_ + 2 * std::min(threads, most_pictures_ - 1)),
                 fmt::format("pictures of {} x {} pixels under way", config_.width, config_.height),
                 "draw smaller ones (--size)");
  for (std::size_t i = 0; i < threads; ++i) try {
      threads_.emplace_back([this](const std::stop_token& stop) { encode_jobs(stop); });
    } catch (const std::system_error& error) {
      if (threads_.empty())
        throw IoError(fmt::format("cannot start a thread: {}", error.code().message()));
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

// A job lets go of its picture while it holds the mutex, so that a use count of one, seen here,
// means that nobody reads the picture any more.
std::shared_ptr<EncodePool::Picture> EncodePool::free_picture() {
  std::unique_lock lock(mutex_);
  while (true) {
    rethrow_locked();
    if (jobs_.size() < kMostJobs) {
      for (const std::shared_ptr<Picture>& picture : pictures_)
        if (picture.use_count() == 1) return picture;
      if (pictures_.size() < most_pictures_)
        return pictures_.emplace_back(std::make_shared<Picture>());
    }
    job_done_.wait(lock);
  }
}

Image& EncodePool::blank() {
  blank_.reset();
  blank_ = free_picture();
  return blank_->image;
}

void EncodePool::submit(std::vector<PngText> texts, std::filesystem::path path,
                        std::optional<MadeFrom> from) {
  std::shared_ptr<Picture> picture = std::move(blank_);
  if (last_ && picture->image == last_->image) {
    picture = last_;
  } else {
    picture->encoded = std::make_unique<std::once_flag>();
    ++work_.frames_encoded;
  }
  const std::lock_guard lock(mutex_);
  rethrow_locked();
  last_ = picture;
  jobs_.push_back({std::move(picture), std::move(texts), std::move(path), std::move(from)});
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

void EncodePool::encode(const Job& job) {
  Picture& picture = *job.picture;
  std::call_once(*picture.encoded, [&] { picture.body = compress(picture.image, config_.effort); });
  std::string png = assemble(picture.body, job.texts, config_.pixels_per_metre);
  if (job.from) png = sealed(FileKind::png, std::move(png), *job.from);
  write_file(job.path, png);
  work_.bytes_written += png.size();
  ++work_.frames_written;
  if (!config_.written) return;
  const std::lock_guard lock(written_mutex_);
  config_.written(job.path);
}

}  // namespace lantern::render
