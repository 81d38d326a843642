#include "publish/film_stream.hpp"

#include <cmath>
#include <string_view>

namespace lantern::publish {
namespace {

std::string big_endian(std::uint64_t number) {
  std::string bytes;
  for (int shift = 56; shift >= 0; shift -= 8)
    bytes += static_cast<char>(static_cast<unsigned char>(number >> shift));
  return bytes;
}

// The length of an element, in 8 bytes of which the first one says so.
std::string length(std::uint64_t bytes) { return big_endian(bytes | std::uint64_t{1} << 56); }

std::string element(std::string_view id, const std::string& content) {
  return std::string(id) + length(content.size()) + content;
}
std::string element(std::string_view id, std::uint64_t number) {
  return element(id, big_endian(number));
}

}  // namespace

std::string film_stream_start(int width, int height, double rate) {
  constexpr std::string_view kUnknownLength = "\x01\xff\xff\xff\xff\xff\xff\xff";
  const std::string head =
      element("\x1a\x45\xdf\xa3", element("\x42\x82", "matroska") + element("\x42\x87", 4) +
                                      element("\x42\x85", 2));  // DocType, versions
  const auto nanoseconds = static_cast<std::uint64_t>(std::llround(1e9 / rate));
  const std::string info = element("\x15\x49\xa9\x66", element("\x2a\xd7\xb1", nanoseconds));
  const std::string video = element("\xb0", static_cast<std::uint64_t>(width)) +
                            element("\xba", static_cast<std::uint64_t>(height)) +
                            element("\x2e\xb5\x24", "RGBA");
  const std::string track = element("\xd7", 1) + element("\x73\xc5", 1) +  // number, unique id
                            element("\x83", 1) +                           // it is video
                            element("\x86", "V_UNCOMPRESSED") + element("\xe0", video);
  return head + "\x18\x53\x80\x67" + std::string(kUnknownLength) + info +
         element("\x16\x54\xae\x6b", element("\xae", track));
}

std::string film_stream_picture(std::uint64_t moment, std::size_t bytes) {
  using namespace std::string_literals;
  const std::string timestamp = element("\xe7", moment);
  const std::string about = "\x81\x00\x00\x80"s;  // of track 1, at the cluster's time, a key frame
  const std::string block = "\xa3" + length(about.size() + bytes) + about;
  return "\x1f\x43\xb6\x75" + length(timestamp.size() + block.size() + bytes) + timestamp + block;
}

}  // namespace lantern::publish
