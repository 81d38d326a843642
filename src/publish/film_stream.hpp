// Pictures with times, as a stream that ffmpeg reads: Matroska (RFC 9559) of uncompressed frames.
// What stands still is sent once and takes no room until it is encoded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lantern::publish {

// What the stream begins with. Its unit of time is 1/rate seconds; pictures are rows from the top,
// 4 bytes a pixel: red, green, blue, alpha.
std::string film_stream_start(int width, int height, double rate);

// What stands before the bytes of a picture that is shown from `moment` on.
std::string film_stream_picture(std::uint64_t moment, std::size_t bytes);

}  // namespace lantern::publish
