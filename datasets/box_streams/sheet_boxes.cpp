#include "datasets/box_streams/sheet_boxes.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "datasets/circle.hpp"

namespace broadside::datasets {
namespace {

constexpr std::uint32_t kPanels = 8;
// A fold bends over this share of a panel on each side of the line between two panels.
constexpr double kBend = 0.1;
constexpr double kLastFold_parts = 0.98;  // of a half turn

// Cosine and sine of any angle, given in turns.
Turn of_turns(double turns) {
  return turn_by(2.0 * std::numbers::pi * (turns - std::floor(turns + 0.5)));
}

// How far the cloth is bent at a place along it, given in panels: from -1 to 1; neighboring panels bend to opposite
// sides.
double bend_at(double panel) {
  if (panel >= kPanels) return -1.0;  // the last edge belongs to the last panel, an odd one
  const double line = std::floor(panel + 0.5);
  const double beyond = panel - line;
  const bool is_even = static_cast<std::uint32_t>(std::floor(panel)) % 2 == 0;
  const bool is_fold = line > 0.0 && line < kPanels && std::abs(beyond) < kBend;
  if (!is_fold) return is_even ? 1.0 : -1.0;
  const double part = beyond / kBend;
  return static_cast<std::uint32_t>(line) % 2 == 0 ? part : -part;
}

struct Sheet {
  std::uint32_t triangles = 0;
  std::uint32_t width = 1;  // in squares of two triangles, along the fold
  std::uint32_t length = 1;
  std::uint32_t frames = 1;
  std::uint32_t frame = 0;
  std::vector<core::Vec3> vertices;

  void place_vertices() {
    const double done = frames > 1 ? static_cast<double>(frame) / (frames - 1) : 1.0;
    // Half of the angle between two panels' directions.
    const double tilt = 0.5 * std::numbers::pi * kLastFold_parts * done;
    const double height = 0.2 + 0.004 * length;  // of the wrinkles
    double x = 0.0;
    double z = 0.0;
    for (std::uint32_t row = 0; row <= length; ++row) {
      const double share = static_cast<double>(row) / length;
      const Turn along = turn_by(tilt * bend_at(kPanels * share));
      if (row > 0) {
        x += along.cosine;
        z += along.sine;
      }
      for (std::uint32_t column = 0; column <= width; ++column) {
        const double across = static_cast<double>(column) / width;
        const double wave = of_turns(5.0 * share + 3.0 * across + done).sine +
                            0.5 * of_turns(17.0 * across - 11.0 * share + 2.0 * done).sine;
        // Along the cloth's normal.
        const double lift = height * wave;
        vertices[std::size_t{row} * (width + 1) + column] = {static_cast<float>(x - lift * along.sine),
                                                             static_cast<float>(column),
                                                             static_cast<float>(z + lift * along.cosine)};
      }
    }
  }

  void make_boxes(std::vector<core::Box>& boxes) {
    place_vertices();
    boxes.clear();
    for (std::uint32_t k = 0; k < triangles; ++k) {
      const std::uint32_t square = k / 2;
      const std::size_t corner = std::size_t{square / width} * (width + 1) + square % width;
      const core::Vec3& diagonal_a = vertices[corner + 1];
      const core::Vec3& diagonal_b = vertices[corner + width + 1];
      const core::Vec3& third = k % 2 == 0 ? vertices[corner] : vertices[corner + width + 2];
      core::Box box = core::grown(core::grown(core::empty_box(), diagonal_a), diagonal_b);
      boxes.push_back(core::grown(box, third));
    }
  }
};

}  // namespace

BoxStream sheet_boxes(std::uint32_t n, std::uint32_t frames) {
  auto sheet = std::make_shared<Sheet>();
  sheet->triangles = n;
  sheet->frames = frames;
  const std::uint64_t squares = (std::uint64_t{n} + 1) / 2;
  while (std::uint64_t{sheet->width} * sheet->width < squares) ++sheet->width;
  sheet->length = static_cast<std::uint32_t>((squares + sheet->width - 1) / sheet->width);
  if (sheet->length == 0) sheet->length = 1;
  sheet->vertices.resize(std::size_t{sheet->length + 1} * (sheet->width + 1));
  BoxStream stream;
  stream.frames = frames;
  stream.boxes.reserve(n);
  sheet->make_boxes(stream.boxes);
  stream.advance = [sheet](std::vector<core::Box>& boxes) {
    ++sheet->frame;
    sheet->make_boxes(boxes);
    return core::Status(core::Done{});
  };
  return stream;
}

}  // namespace broadside::datasets
