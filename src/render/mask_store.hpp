// Coverage masks in one array of bytes, as the GPU reads them.
#pragma once

#include <cstdint>
#include <vector>

namespace lantern {

class MaskStore {
 public:
  // Byte 0 is 255: the mask of whatever has none.
  MaskStore() : bytes_{255} {}

  // To be called before each frame: forgets everything once the store is large. The masks of one
  // frame stay together, however large they are. True if it forgot.
  bool start_frame() {
    if (bytes_.size() <= kMostKept) return false;
    bytes_.assign(1, 255);
    ++generation_;
    return true;
  }

  // Room for a mask of so many bytes, all 0; gives its first index.
  std::int32_t add(std::size_t size) {
    const std::size_t first = bytes_.size();
    bytes_.resize(first + size);
    return static_cast<std::int32_t>(first);
  }
  std::uint8_t* at(std::int32_t index) { return bytes_.data() + index; }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  // Counts how often the store was emptied; in between, what was there at a frame's end never
  // changes.
  std::uint64_t generation() const { return generation_; }

 private:
  static constexpr std::size_t kMostKept = std::size_t{16} << 20;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t generation_ = 0;
};

}  // namespace lantern
