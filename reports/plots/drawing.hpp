// One SVG picture, drawn shape by shape. Every plot is made with this class.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace broadside::reports::plots {

// kFile: a file that contains its style: light or dark, as the reader's system is.
// kInline: part of a page that includes plot_style() in its style and defines the report's color variables.
enum class Placement { kFile, kInline };

enum class Anchor { kStart, kMiddle, kEnd };

struct Point {
  double x = 0.0;
  double y = 0.0;
};

// Coordinates in pixels, y downward. Looks come from classes (plot_style.hpp): "s0" to "s7" fill, "l0" to "l7" stroke,
// "b0" to "b7" fill faintly, "grid", "frame", "whisker", "across", "across-name", "tick", "name", "heading", "value",
// "on-full", "model-box". Texts are escaped here; whatever is drawn outside the picture is cut off by the viewer.
class Drawing {
 public:
  // A screen reader reads title and description; neither is drawn.
  Drawing(double width, double height, std::string_view title, std::string_view description);

  void line(std::string_view style, Point from, Point to);
  // Points that are not finite break the line into pieces; a piece of one point is no line.
  void polyline(std::string_view style, const std::vector<Point>& points);
  void polygon(std::string_view style, const std::vector<Point>& corners);
  void rect(std::string_view style, Point corner, double width, double height, std::string_view hint = {});
  // opacity 0 to 1: gives shades of one color that are visible on light and on dark.
  void shaded_rect(std::string_view style, Point corner, double width, double height, double opacity,
                   std::string_view hint);
  // Shape 0 to 3: circle, square, diamond, triangle. They tell series apart where colors cannot be seen.
  void mark(std::string_view style, int shape, Point at, std::string_view hint = {});
  void text(std::string_view style, Point at, Anchor anchor, std::string_view words);
  // Read from bottom to top, centered at the point.
  void upright_text(std::string_view style, Point at, std::string_view words);
  // SVG path data as they are; color is a presentation attribute and may be empty.
  void path(std::string_view style, std::string_view color, std::string_view data);

  // Two pictures on one page have the same ids only when they are the same picture.
  [[nodiscard]] std::string finish(Placement placement) const;

 private:
  double width_;
  double height_;
  std::string title_;
  std::string description_;
  std::string shapes_;
};

// Pixels with at most two decimals: "12.5", "-3".
std::string pixels(double value);

// About how wide a text of the size of axis labels is, in pixels.
double text_width(std::string_view words);

}  // namespace broadside::reports::plots
