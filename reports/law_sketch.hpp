// A small drawing of 120 by 72 units, made of the few shapes that explain a law. Colors come from the page's style.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace broadside::reports {

// How a shape is drawn; the page's style gives the colors.
enum class Ink {
  kBody,   // a body
  kGhost,  // where a body was, or might be: dashed
  kForce,  // what acts, and what is measured
  kWrong,  // what the law forbids
  kLine,   // the ground, an axis
};

struct SketchPoint {
  double x = 0.0;
  double y = 0.0;  // downward, as in SVG
};

class LawSketch {
 public:
  // A box, turned clockwise about its center.
  LawSketch& box(SketchPoint corner, double width, double height, Ink ink = Ink::kBody, double degrees = 0.0);
  LawSketch& ball(SketchPoint center, double radius, Ink ink = Ink::kBody);
  LawSketch& line(SketchPoint from, SketchPoint to, Ink ink = Ink::kLine);
  // Straight lines through all points.
  LawSketch& path(const std::vector<SketchPoint>& points, Ink ink = Ink::kLine);
  // A filled outline.
  LawSketch& shape(const std::vector<SketchPoint>& points, Ink ink = Ink::kBody);
  LawSketch& arrow(SketchPoint from, SketchPoint to, Ink ink = Ink::kForce);
  // An arc about a center from one angle to another, in degrees clockwise from the right, with an arrowhead at its end.
  LawSketch& turn(SketchPoint center, double radius, double from_degrees, double to_degrees, Ink ink = Ink::kForce);
  LawSketch& dot(SketchPoint at, Ink ink = Ink::kForce);
  // A small cross: what is drawn here is forbidden.
  LawSketch& no(SketchPoint at);
  // Line with hatching below.
  LawSketch& ground(double y = 60.0, double from = 8.0, double to = 112.0);
  // Text centered on the point; it is escaped.
  LawSketch& text(SketchPoint at, std::string_view words, Ink ink = Ink::kForce);

  // One line of SVG, hidden from screen readers because the sentence beside it says the same.
  [[nodiscard]] std::string svg() const;

 private:
  void head(SketchPoint at, double angle, Ink ink);
  std::string body_;
};

}  // namespace broadside::reports
