#pragma once

#include <cairo.h>

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "lychnite/image/image.h"

namespace lychnite::paper {

struct Stroke {
  glm::vec3 colour{0.11f};  ///< display values
  double width = 1;
  std::vector<double> dashes;  ///< lengths on and off; empty: solid
};

enum class Anchor { kLeft, kCentre, kRight };

/// Circle to plus differ in black and white, too.
enum class Marker { kCircle, kSquare, kTriangle, kDiamond, kCross, kPlus };

/// A drawing in points, the origin in the upper left corner, written as SVG whose texts are outlines of the
/// built-in font, so that it looks the same everywhere (Cairo).
class Canvas {
 public:
  Canvas(const std::filesystem::path& path, double width, double height);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void line(const std::vector<glm::dvec2>& points, const Stroke& stroke);
  void rectangle(const glm::dvec2& from, const glm::dvec2& size, const Stroke& stroke);
  void filledRectangle(const glm::dvec2& from, const glm::dvec2& size, const glm::vec3& colour,
                       double opacity = 1);
  void circle(const glm::dvec2& centre, double radius, const Stroke& stroke);
  /// White inside, so that it stands out of the lines.
  void marker(Marker kind, const glm::dvec2& centre, double size, const glm::vec3& colour);
  /// `at` is on the baseline; `turned`: reads upwards.
  void text(const std::string& text, const glm::dvec2& at, double size, Anchor anchor = Anchor::kLeft,
            bool turned = false, const glm::vec3& colour = glm::vec3(0.11f));
  double textWidth(const std::string& text, double size);
  /// A picture of display values (R, G, B in [0, 1]), its pixels sharp.
  void picture(const Image& image, const glm::dvec2& from, const glm::dvec2& size);
  /// Nothing outside the rectangle is drawn until unclip().
  void clip(const glm::dvec2& from, const glm::dvec2& size);
  void unclip();

  /// Writes the file; throws Error when that fails.
  void finish();

 private:
  void setStroke(const Stroke& stroke);

  std::filesystem::path path_;
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
};

}  // namespace lychnite::paper
