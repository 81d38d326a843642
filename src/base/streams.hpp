// What a run reads and where its words go: its inputs, over which nothing is written, and the
// standard streams.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace lantern {

// The bytes of standard input, to its end: an input of this run, too. Throws IoError as read_file()
// does, and Stopped if that is wished while it waits.
std::string read_stdin(std::size_t most_bytes);

// What will be read is an input before it is.
void add_input(const std::filesystem::path& path);

// Is what stands at `path` an input of this run, under whatever name? Nothing is written over it.
bool is_input(const std::filesystem::path& path);

// Is standard output written to a file that this run has read, an input or not? Nothing is written
// there either.
bool output_is_input();

// What is open at `descriptor` is about to be read. Throws IoError if it is the file that standard
// output or standard error is written to: nothing is written there any more.
void see_read(int descriptor);

// False with errno set if not everything could be written. Waits where a pipe does not.
bool write_all(int descriptor, std::string_view bytes);

// Takes the numbers of standard streams that are closed, so that no file opened later gets one and
// has messages written into it. What is written to a stream held so is an error like any other.
// Call it before anything is opened.
void hold_standard_streams() noexcept;

// Writes all bytes to standard output, unbuffered. Throws IoError (a full disk, a closed stream, an
// input of this run); ReaderGone if it is a pipe that nobody reads any more.
void write_stdout(std::string_view bytes);

// Writes to standard error what can be written there, unbuffered; the rest is lost, and all of it
// where standard error is a file that this run has read.
void write_stderr(std::string_view bytes) noexcept;

}  // namespace lantern
