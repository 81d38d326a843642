// Draw lists as the pages of a PDF: vectors, and text that can be searched and copied.
#pragma once

#include <string>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"

namespace lantern::publish {

// What a document says of itself. No clock is asked: the same pages give the same bytes, with the
// same version of cairo.
struct PdfWords {
  std::string title, subject, creator;
};

class PdfDocument {
 public:
  // Throws BackendError, naming the packages to install, if cairo or FreeType are missing.
  explicit PdfDocument(const PdfWords& words);
  ~PdfDocument();
  PdfDocument(const PdfDocument&) = delete;
  PdfDocument& operator=(const PdfDocument&) = delete;

  // A page of this size, in points of 1/72 inch, with the draw list in its middle. `label` is the
  // page's number as a viewer shows it; none if it is empty. Throws Refused as check_draw_list()
  // does.
  void add_page(const DrawList& list, const Theme& theme, bool paper, const Vec<2>& size,
                const std::string& label = {});

  // An entry of the table of contents, for the page that was added last.
  void add_entry(const std::string& words);

  int pages() const { return pages_; }
  // That the document has by now.
  std::size_t bytes() const { return bytes_.size(); }

  // The whole file; nothing can be added after it.
  std::string finish();

 private:
  static int append(void* to, const unsigned char* bytes, unsigned int length) noexcept;
  void require_good() const;

  std::string bytes_;
  void* surface_ = nullptr;
  void* context_ = nullptr;
  int pages_ = 0;
};

}  // namespace lantern::publish
