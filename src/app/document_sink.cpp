#include "app/file_sink.hpp"
#include "app/terminal.hpp"

namespace lantern::app {

std::unique_ptr<FileSink> make_document_sink(const Sequence&) { throw UsageError("not yet"); }

}  // namespace lantern::app
