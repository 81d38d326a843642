#include "publish/pdf.hpp"

#include <new>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "render/cairo_painter.hpp"
#include "render/canvas.hpp"

namespace lantern::publish {
namespace {

// As <cairo-pdf.h> numbers them.
constexpr int kTitle = 0, kSubject = 2, kCreator = 4, kCreated = 5;

}  // namespace

PdfDocument::PdfDocument(const PdfWords& words) {
  cairo_face(Weight::regular);  // before anything is made: what is missing is told at once
  surface_ = cairo().pdf_surface_create_for_stream(append, &bytes_, 1, 1);
  context_ = cairo().create(surface_);
  cairo().pdf_surface_set_metadata(surface_, kTitle, words.title.c_str());
  cairo().pdf_surface_set_metadata(surface_, kSubject, words.subject.c_str());
  cairo().pdf_surface_set_metadata(surface_, kCreator, words.creator.c_str());
  cairo().pdf_surface_set_metadata(surface_, kCreated, "");  // or it would be now
}

PdfDocument::~PdfDocument() {
  cairo().destroy(context_);
  cairo().surface_destroy(surface_);
}

// Cairo calls it, and is no place for exceptions.
int PdfDocument::append(void* to, const unsigned char* bytes, unsigned int length) noexcept try {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), length);
  return 0;
} catch (const std::bad_alloc&) {
  constexpr int kNoMemory = 1;
  return kNoMemory;
}

void PdfDocument::require_good() const {
  cairo().require(cairo().status(context_));
  cairo().require(cairo().surface_status(surface_));
}

void PdfDocument::add_page(const DrawList& list, const Theme& theme, bool paper, const Vec<2>& size,
                           const std::string& label) {
  cairo().pdf_surface_set_size(surface_, size.x, size.y);
  Canvas canvas;
  canvas.scale = std::min(size.x / list.page.x, size.y / list.page.y);
  canvas.origin = (size - list.page * canvas.scale) * 0.5;
  CairoPainter(context_, CairoPainter::For::vectors).draw(list, theme, paper, canvas);
  if (!label.empty()) cairo().pdf_surface_set_page_label(surface_, label.c_str());
  cairo().show_page(context_);
  require_good();
  ++pages_;
}

void PdfDocument::add_entry(const std::string& words) {
  constexpr int kTopLevel = 0;
  LANTERN_CHECK(pages_, >, 0);
  const std::string link = fmt::format("page={} pos=[0 0]", pages_);
  cairo().pdf_surface_add_outline(surface_, kTopLevel, words.c_str(), link.c_str(), 0);
  require_good();
}

std::string PdfDocument::finish() {
  cairo().surface_finish(surface_);
  cairo().require(cairo().surface_status(surface_));
  return std::move(bytes_);
}

}  // namespace lantern::publish
