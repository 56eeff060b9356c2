#include "app/paper/canvas.h"

#include <cairo-ft.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "lychnite/base/error.h"
#include "lychnite/image/montage.h"

namespace lychnite::paper {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The built-in font's face, which must live for as long as anything that Cairo has made of it.
struct Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }
};

using FontFace = std::unique_ptr<cairo_font_face_t, void (*)(cairo_font_face_t*)>;

FontFace builtinFont() {
  static const cairo_user_data_key_t kKey{};
  auto font = std::make_unique<Face>();
  const std::string_view bytes = labelFont();
  if (FT_Init_FreeType(&font->library) != 0 ||
      FT_New_Memory_Face(font->library, reinterpret_cast<const FT_Byte*>(bytes.data()), FT_Long(bytes.size()),
                         0, &font->face) != 0)
    throw Error({.where = "plots", .expected = "", .found = "the built-in font cannot be used", .todo = ""});
  FontFace result(cairo_ft_font_face_create_for_ft_face(font->face, 0), cairo_font_face_destroy);
  const auto destroy = [](void* data) { delete static_cast<Face*>(data); };
  if (cairo_font_face_set_user_data(result.get(), &kKey, font.get(), destroy) != CAIRO_STATUS_SUCCESS)
    throw std::bad_alloc();
  font.release();
  return result;
}

}  // namespace

Canvas::Canvas(const std::filesystem::path& path, double width, double height)
    : path_(path),
      surface_(cairo_svg_surface_create(path.c_str(), width, height), cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  cairo_set_font_face(cairo_.get(), builtinFont().get());
  filledRectangle({0, 0}, {width, height}, glm::vec3(1));
}

void Canvas::setStroke(const Stroke& stroke) {
  cairo_set_source_rgb(cairo_.get(), double(stroke.colour.x), double(stroke.colour.y),
                       double(stroke.colour.z));
  cairo_set_line_width(cairo_.get(), stroke.width);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(cairo_.get(), stroke.dashes.data(), int(stroke.dashes.size()), 0);
}

void Canvas::line(const std::vector<glm::dvec2>& points, const Stroke& stroke) {
  for (size_t i = 0; i < points.size(); ++i)
    (i == 0 ? cairo_move_to : cairo_line_to)(cairo_.get(), points[i].x, points[i].y);
  setStroke(stroke);
  cairo_stroke(cairo_.get());
}

void Canvas::rectangle(const glm::dvec2& from, const glm::dvec2& size, const Stroke& stroke) {
  cairo_rectangle(cairo_.get(), from.x, from.y, size.x, size.y);
  setStroke(stroke);
  cairo_stroke(cairo_.get());
}

void Canvas::filledRectangle(const glm::dvec2& from, const glm::dvec2& size, const glm::vec3& colour,
                             double opacity) {
  cairo_rectangle(cairo_.get(), from.x, from.y, size.x, size.y);
  cairo_set_source_rgba(cairo_.get(), double(colour.x), double(colour.y), double(colour.z), opacity);
  cairo_fill(cairo_.get());
}

void Canvas::circle(const glm::dvec2& centre, double radius, const Stroke& stroke) {
  cairo_new_sub_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x, centre.y, radius, 0, 2 * kPi);
  setStroke(stroke);
  cairo_stroke(cairo_.get());
}

void Canvas::marker(Marker kind, const glm::dvec2& centre, double size, const glm::vec3& colour) {
  cairo_t* c = cairo_.get();
  const double r = size / 2;
  const auto polygon = [&](std::initializer_list<glm::dvec2> corners) {
    cairo_new_path(c);
    for (const glm::dvec2& p : corners) cairo_line_to(c, centre.x + r * p.x, centre.y + r * p.y);
    cairo_close_path(c);
  };
  const bool open = kind == Marker::kCross || kind == Marker::kPlus;
  if (kind == Marker::kCircle) {
    cairo_new_path(c);
    cairo_arc(c, centre.x, centre.y, r, 0, 2 * kPi);
  } else if (kind == Marker::kSquare) {
    polygon({{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}});
  } else if (kind == Marker::kTriangle) {
    polygon({{0, -1.2}, {1.1, .8}, {-1.1, .8}});
  } else if (kind == Marker::kDiamond) {
    polygon({{0, -1.25}, {1.1, 0}, {0, 1.25}, {-1.1, 0}});
  } else {
    const double d = kind == Marker::kCross ? 0.85 : 1.15, e = kind == Marker::kCross ? d : 0;
    cairo_move_to(c, centre.x - r * d, centre.y - r * e);
    cairo_line_to(c, centre.x + r * d, centre.y + r * e);
    cairo_move_to(c, centre.x - r * e, centre.y + r * d);
    cairo_line_to(c, centre.x + r * e, centre.y - r * d);
  }
  if (!open) {
    cairo_set_source_rgb(c, 1, 1, 1);
    cairo_fill_preserve(c);
  }
  setStroke({.colour = colour, .width = 1.4});
  cairo_stroke(c);
}

double Canvas::textWidth(const std::string& text, double size) {
  cairo_set_font_size(cairo_.get(), size);
  cairo_text_extents_t extents{};
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& text, const glm::dvec2& at, double size, Anchor anchor, bool turned,
                  const glm::vec3& colour) {
  const double width = textWidth(text, size);
  const double shift = anchor == Anchor::kLeft ? 0 : anchor == Anchor::kCentre ? -width / 2 : -width;
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), at.x, at.y);
  if (turned) cairo_rotate(cairo_.get(), -kPi / 2);
  cairo_move_to(cairo_.get(), shift, 0);
  cairo_set_source_rgb(cairo_.get(), double(colour.x), double(colour.y), double(colour.z));
  cairo_show_text(cairo_.get(), text.c_str());
  cairo_restore(cairo_.get());
}

void Canvas::picture(const Image& image, const glm::dvec2& from, const glm::dvec2& size) {
  const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, image.width());
  std::vector<unsigned char> bytes(size_t(stride) * size_t(image.height()));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const glm::vec3 c = image.rgb(size_t(y) * size_t(image.width()) + size_t(x));
      unsigned char* texel = &bytes[size_t(y) * size_t(stride) + size_t(x) * 4];
      for (int k = 0; k < 3; ++k) texel[k] = uint8_t(std::lround(255 * std::clamp(c[2 - k], 0.0f, 1.0f)));
    }
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> source(
      cairo_image_surface_create_for_data(bytes.data(), CAIRO_FORMAT_RGB24, image.width(), image.height(),
                                          stride),
      cairo_surface_destroy);
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), from.x, from.y);
  cairo_scale(cairo_.get(), size.x / image.width(), size.y / image.height());
  cairo_set_source_surface(cairo_.get(), source.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo_.get()), CAIRO_FILTER_NEAREST);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
  cairo_surface_flush(surface_.get());
}

void Canvas::clip(const glm::dvec2& from, const glm::dvec2& size) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), from.x, from.y, size.x, size.y);
  cairo_clip(cairo_.get());
}

void Canvas::unclip() {
  cairo_restore(cairo_.get());
}

void Canvas::finish() {
  cairo_surface_finish(surface_.get());
  const cairo_status_t status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error({.where = path_.string(),
                 .expected = "",
                 .found = std::string("cannot write: ") + cairo_status_to_string(status),
                 .todo = ""});
}

}  // namespace lychnite::paper
