#include "reports/law_sketch.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "reports/escape.hpp"

namespace broadside::reports {
namespace {

constexpr double kHeadLength = 5.0;
constexpr double kHeadHalfAngle = 0.45;  // rad

std::string sketch_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string_view class_of(Ink ink) {
  switch (ink) {
    case Ink::kBody:
      return "body";
    case Ink::kGhost:
      return "ghost";
    case Ink::kForce:
      return "force";
    case Ink::kWrong:
      return "wrong";
    case Ink::kLine:
      return "line";
  }
  return "line";
}

std::string with_class(Ink ink, std::string_view more = "") {
  return " class=\"" + std::string(class_of(ink)) + std::string(more) + "\"";
}

std::string points_text(const std::vector<SketchPoint>& points) {
  std::string text;
  for (const SketchPoint& p : points) text += (text.empty() ? "" : " ") + sketch_number(p.x) + "," + sketch_number(p.y);
  return text;
}

SketchPoint on_circle(SketchPoint center, double radius, double angle) {
  return {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)};
}

}  // namespace

LawSketch& LawSketch::box(SketchPoint corner, double width, double height, Ink ink, double degrees) {
  body_ += "<rect x=\"" + sketch_number(corner.x) + "\" y=\"" + sketch_number(corner.y) + "\" width=\"" +
           sketch_number(width) + "\" height=\"" + sketch_number(height) + "\"" + with_class(ink);
  if (degrees != 0.0)
    body_ += " transform=\"rotate(" + sketch_number(degrees) + " " + sketch_number(corner.x + width / 2) + " " +
             sketch_number(corner.y + height / 2) + ")\"";
  body_ += "/>";
  return *this;
}

LawSketch& LawSketch::ball(SketchPoint center, double radius, Ink ink) {
  body_ += "<circle cx=\"" + sketch_number(center.x) + "\" cy=\"" + sketch_number(center.y) + "\" r=\"" +
           sketch_number(radius) + "\"" + with_class(ink) + "/>";
  return *this;
}

LawSketch& LawSketch::line(SketchPoint from, SketchPoint to, Ink ink) {
  return path({from, to}, ink);
}

LawSketch& LawSketch::path(const std::vector<SketchPoint>& points, Ink ink) {
  body_ += "<polyline points=\"" + points_text(points) + "\"" + with_class(ink, " open") + "/>";
  return *this;
}

LawSketch& LawSketch::shape(const std::vector<SketchPoint>& points, Ink ink) {
  body_ += "<polygon points=\"" + points_text(points) + "\"" + with_class(ink) + "/>";
  return *this;
}

void LawSketch::head(SketchPoint at, double angle, Ink ink) {
  body_ += "<polygon points=\"" +
           points_text({at, on_circle(at, kHeadLength, angle + std::numbers::pi - kHeadHalfAngle),
                        on_circle(at, kHeadLength, angle + std::numbers::pi + kHeadHalfAngle)}) +
           "\"" + with_class(ink, " head") + "/>";
}

LawSketch& LawSketch::arrow(SketchPoint from, SketchPoint to, Ink ink) {
  line(from, to, ink);
  head(to, std::atan2(to.y - from.y, to.x - from.x), ink);
  return *this;
}

LawSketch& LawSketch::turn(SketchPoint center, double radius, double from_degrees, double to_degrees, Ink ink) {
  constexpr int kPieces = 16;
  std::vector<SketchPoint> points;
  const auto angle_at = [&](int k) {
    return (from_degrees + (to_degrees - from_degrees) * k / kPieces) * std::numbers::pi / 180.0;
  };
  for (int k = 0; k <= kPieces; ++k) points.push_back(on_circle(center, radius, angle_at(k)));
  path(points, ink);
  const SketchPoint a = points[kPieces - 1];
  const SketchPoint b = points[kPieces];
  head(b, std::atan2(b.y - a.y, b.x - a.x), ink);
  return *this;
}

LawSketch& LawSketch::dot(SketchPoint at, Ink ink) {
  body_ += "<circle cx=\"" + sketch_number(at.x) + "\" cy=\"" + sketch_number(at.y) + "\" r=\"2.2\"" +
           with_class(ink, " head") + "/>";
  return *this;
}

LawSketch& LawSketch::no(SketchPoint at) {
  constexpr double kArm = 5.0;
  line({at.x - kArm, at.y - kArm}, {at.x + kArm, at.y + kArm}, Ink::kWrong);
  return line({at.x - kArm, at.y + kArm}, {at.x + kArm, at.y - kArm}, Ink::kWrong);
}

LawSketch& LawSketch::ground(double y, double from, double to) {
  constexpr double kPitch = 8.0;
  line({from, y}, {to, y});
  for (int k = 1; from + k * kPitch <= to; ++k) line({from + k * kPitch, y}, {from + k * kPitch - 5.0, y + 5.0});
  return *this;
}

LawSketch& LawSketch::text(SketchPoint at, std::string_view words, Ink ink) {
  body_ += "<text x=\"" + sketch_number(at.x) + "\" y=\"" + sketch_number(at.y) + "\" text-anchor=\"middle\"" +
           with_class(ink) + ">" + html(words) + "</text>";
  return *this;
}

std::string LawSketch::svg() const {
  return "<svg class=\"sketch\" viewBox=\"0 0 120 72\" width=\"120\" height=\"72\" aria-hidden=\"true\">" + body_ +
         "</svg>";
}

}  // namespace broadside::reports
