#include "reports/plots/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "reports/escape.hpp"
#include "reports/plots/plot_style.hpp"

namespace broadside::reports::plots {
namespace {

constexpr double kMarkRadius = 3.2;
constexpr double kMeanCharacterWidth = 6.3;  // of the 11 px sans-serif of labels

std::string attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + pixels(value) + "\"";
}

std::string styled(std::string_view element, std::string_view style) {
  return "<" + std::string(element) + " class=\"" + std::string(style) + "\"";
}

// Ends an element, with a hint if it has one; browsers show hints beside the pointer.
std::string ended(std::string_view element, std::string_view hint) {
  if (hint.empty()) return "/>\n";
  return "><title>" + xml(hint) + "</title></" + std::string(element) + ">\n";
}

std::string at(Point p) {
  return pixels(p.x) + " " + pixels(p.y);
}

bool is_finite(Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

// FNV-1a: the id is a hash of the content, so the same rows give the same bytes.
std::string id_of(std::string_view content) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  std::array<char, 24> text;
  std::snprintf(text.data(), text.size(), "p%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace

std::string pixels(double value) {
  std::array<char, 64> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.2f", std::clamp(value, -1e7, 1e7));
  std::string text = buffer.data();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

double text_width(std::string_view words) {
  return kMeanCharacterWidth * static_cast<double>(width(printable(words)));
}

Drawing::Drawing(double width, double height, std::string_view title, std::string_view description)
    : width_(width), height_(height), title_(title), description_(description) {}

void Drawing::line(std::string_view style, Point from, Point to) {
  shapes_ += styled("line", style) + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
             attribute("y2", to.y) + "/>\n";
}

void Drawing::polyline(std::string_view style, const std::vector<Point>& points) {
  std::string data;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!is_finite(points[k])) continue;
    const bool goes_on = k > 0 && is_finite(points[k - 1]);
    const bool has_next = k + 1 < points.size() && is_finite(points[k + 1]);
    if (goes_on || has_next) data += (goes_on ? "L" : "M") + at(points[k]);
  }
  if (!data.empty()) shapes_ += styled("path", style) + " d=\"" + data + "\"/>\n";
}

void Drawing::polygon(std::string_view style, const std::vector<Point>& corners) {
  if (corners.size() < 3) return;
  std::string data;
  for (const Point& p : corners) data += (data.empty() ? "M" : "L") + at(p);
  shapes_ += styled("path", style) + " d=\"" + data + "Z\"/>\n";
}

void Drawing::rect(std::string_view style, Point corner, double width, double height, std::string_view hint) {
  shapes_ += styled("rect", style) + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
             attribute("height", height) + ended("rect", hint);
}

void Drawing::shaded_rect(std::string_view style, Point corner, double width, double height, double opacity,
                          std::string_view hint) {
  shapes_ += styled("rect", style) + attribute("fill-opacity", opacity) + attribute("x", corner.x) +
             attribute("y", corner.y) + attribute("width", width) + attribute("height", height) + ended("rect", hint);
}

void Drawing::mark(std::string_view style, int shape, Point p, std::string_view hint) {
  if (!is_finite(p)) return;
  const double r = kMarkRadius;
  std::string data;
  switch (shape % 4) {
    case 0:
      shapes_ += styled("circle", style) + attribute("cx", p.x) + attribute("cy", p.y) + attribute("r", r) +
                 ended("circle", hint);
      return;
    case 1:
      data = "M" + at({p.x - 0.9 * r, p.y - 0.9 * r}) + "h" + pixels(1.8 * r) + "v" + pixels(1.8 * r) + "h" +
             pixels(-1.8 * r) + "Z";
      break;
    case 2:
      data = "M" + at({p.x, p.y - 1.35 * r}) + "L" + at({p.x + 1.35 * r, p.y}) + "L" + at({p.x, p.y + 1.35 * r}) + "L" +
             at({p.x - 1.35 * r, p.y}) + "Z";
      break;
    default:
      data = "M" + at({p.x, p.y - 1.3 * r}) + "L" + at({p.x + 1.2 * r, p.y + 0.9 * r}) + "L" +
             at({p.x - 1.2 * r, p.y + 0.9 * r}) + "Z";
  }
  shapes_ += styled("path", style) + " d=\"" + data + "\"" + ended("path", hint);
}

void Drawing::text(std::string_view style, Point at, Anchor anchor, std::string_view words) {
  shapes_ += styled("text", style) + attribute("x", at.x) + attribute("y", at.y);
  if (anchor == Anchor::kMiddle) shapes_ += " text-anchor=\"middle\"";
  if (anchor == Anchor::kEnd) shapes_ += " text-anchor=\"end\"";
  shapes_ += ">" + xml(words) + "</text>\n";
}

void Drawing::upright_text(std::string_view style, Point at, std::string_view words) {
  shapes_ += styled("text", style) + " text-anchor=\"middle\" transform=\"translate(" + pixels(at.x) + " " +
             pixels(at.y) + ") rotate(-90)\">" + xml(words) + "</text>\n";
}

void Drawing::path(std::string_view style, std::string_view color, std::string_view data) {
  if (data.empty()) return;
  shapes_ += styled("path", style);
  if (!color.empty()) shapes_ += " fill=\"" + std::string(color) + "\"";
  shapes_ += " d=\"" + std::string(data) + "\"/>\n";
}

std::string Drawing::finish(Placement placement) const {
  const std::string id = id_of(title_ + description_ + shapes_);
  std::string out = "<svg class=\"plot\"";
  if (placement == Placement::kFile) out += " xmlns=\"http://www.w3.org/2000/svg\"";
  out += " viewBox=\"0 0 " + pixels(width_) + " " + pixels(height_) + "\" width=\"" + pixels(width_) + "\" height=\"" +
         pixels(height_) + "\" role=\"img\" aria-labelledby=\"" + id + "t " + id + "d\">\n<title id=\"" + id + "t\">" +
         xml(title_) + "</title>\n<desc id=\"" + id + "d\">" + xml(description_) + "</desc>\n";
  if (placement == Placement::kFile)
    out += "<style>\n" + file_style() + "</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n";
  return out + shapes_ + "</svg>\n";
}

}  // namespace broadside::reports::plots
