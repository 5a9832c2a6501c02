// Playbacks as the page's script unpacks them (page/playback.js).
#include "reports/playback.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/contact.hpp"
#include "reports/escape.hpp"
#include "reports/page_json.hpp"

namespace broadside::reports {
namespace {

using core::Box;
using core::Vec3;
using OrderedJson = nlohmann::ordered_json;
using Words = std::vector<std::uint16_t>;

constexpr double kMostWord = 65535.0;

template <typename Word>
std::string base64(const std::vector<Word>& words) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (const Word word : words)
    for (std::size_t b = 0; b < sizeof word; ++b) bytes += static_cast<char>(word >> (8 * b) & 0xFFU);
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b)
      three = three << 8U | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d) text += k + d > bytes.size() ? '=' : kDigits[three >> (18 - 6 * d) & 63U];
  }
  return text;
}

// Maps coordinates to whole numbers of cells above a corner: 65535 cells over the extent, so the error is half a cell.
struct Grid {
  std::array<double, 3> min{};
  std::array<double, 3> cell{};

  void pack(Vec3 p, Words& into) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double cells = cell[a] > 0.0 ? (static_cast<double>(p[axis]) - min[a]) / cell[a] : 0.0;
      into.push_back(
          static_cast<std::uint16_t>(std::isfinite(cells) ? std::clamp(std::round(cells), 0.0, kMostWord) : 0.0));
    }
  }
  [[nodiscard]] OrderedJson min_json() const { return {min[0], min[1], min[2]}; }
  [[nodiscard]] OrderedJson cell_json() const { return {cell[0], cell[1], cell[2]}; }
};

// From -1 to 1.
std::uint16_t packed_unit(float value) {
  const double share = (static_cast<double>(value) + 1.0) / 2.0;
  return static_cast<std::uint16_t>(std::isfinite(share) ? std::clamp(std::round(share * kMostWord), 0.0, kMostWord)
                                                         : 0.0);
}

void pack(core::Quat q, Words& into) {
  for (const float part : {q.w, q.x, q.y, q.z}) into.push_back(packed_unit(part));
}

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

class Extent {
 public:
  void add(Vec3 p) {
    if (is_finite(p)) box_ = core::grown(box_, p);
  }
  [[nodiscard]] Grid grid() const {
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
      if (core::is_empty(box_)) continue;
      const auto a = static_cast<std::size_t>(axis);
      grid.min[a] = static_cast<double>(box_.min[axis]);
      grid.cell[a] = (static_cast<double>(box_.max[axis]) - grid.min[a]) / kMostWord;
    }
    return grid;
  }

 private:
  Box box_ = core::empty_box();
};

OrderedJson to_json(const PlaybackShape& shape) {
  Extent extent;
  for (const auto& level : shape.levels)
    for (const Box& box : level) {
      extent.add(box.min);
      extent.add(box.max);
    }
  for (const Vec3 v : shape.vertices) extent.add(v);
  const Grid grid = extent.grid();
  OrderedJson levels = OrderedJson::array();
  for (const auto& level : shape.levels) {
    Words words;
    for (const Box& box : level) {
      grid.pack(box.min, words);
      grid.pack(box.max, words);
    }
    levels.push_back(base64(words));
  }
  Words vertices;
  for (const Vec3 v : shape.vertices) grid.pack(v, vertices);
  Words triangles;
  for (const auto& t : shape.triangles)
    for (const std::uint32_t v : t) triangles.push_back(static_cast<std::uint16_t>(v));
  return {{"min", grid.min_json()},
          {"cell", grid.cell_json()},
          {"levels", std::move(levels)},
          {"vertices", base64(vertices)},
          {"triangles", base64(triangles)}};
}

// A face of the domain is numbered after the last body.
std::uint16_t short_name(std::uint32_t body, std::size_t body_count) {
  return static_cast<std::uint16_t>(core::is_face(body) ? body_count + (body - core::kFirstFace) : body);
}

OrderedJson to_json(const Playback& p) {
  const std::size_t bodies = p.shape_of_body.size();
  Extent extent;
  float deepest = 0.0F;
  for (const PlaybackFrame& frame : p.frames) {
    for (const Vec3 x : frame.position) extent.add(x);
    for (const PlaybackContact& c : frame.contacts) {
      extent.add(c.point);
      if (std::isfinite(c.depth_m)) deepest = std::max(deepest, c.depth_m);
    }
  }
  const Grid grid = extent.grid();
  const double depth_cell = std::max(static_cast<double>(deepest), 1e-30) / kMostWord;
  OrderedJson steps = OrderedJson::array();
  Words positions;
  Words turns;
  Words pairs;
  Words contacts;
  std::vector<std::uint32_t> pair_begin{0};
  std::vector<std::uint32_t> contact_begin{0};
  for (const PlaybackFrame& frame : p.frames) {
    steps.push_back(frame.step);
    for (const Vec3 x : frame.position) grid.pack(x, positions);
    for (const core::Quat q : frame.turn) pack(q, turns);
    for (const core::Pair pair : frame.pairs) {
      pairs.push_back(static_cast<std::uint16_t>(pair.i));
      pairs.push_back(static_cast<std::uint16_t>(pair.j));
    }
    for (const PlaybackContact& c : frame.contacts) {
      contacts.push_back(short_name(c.a, bodies));
      contacts.push_back(short_name(c.b, bodies));
      grid.pack(c.point, contacts);
      for (int axis = 0; axis < 3; ++axis) contacts.push_back(packed_unit(c.normal[axis]));
      const double depth = static_cast<double>(c.depth_m) / depth_cell;
      contacts.push_back(
          static_cast<std::uint16_t>(std::isfinite(depth) ? std::clamp(std::round(depth), 0.0, kMostWord) : 0.0));
    }
    pair_begin.push_back(static_cast<std::uint32_t>(pairs.size() / 2));
    contact_begin.push_back(static_cast<std::uint32_t>(contacts.size() / 9));
  }
  Words shape_of_body;
  for (const std::uint32_t s : p.shape_of_body) shape_of_body.push_back(static_cast<std::uint16_t>(s));
  OrderedJson shapes = OrderedJson::array();
  for (const PlaybackShape& shape : p.shapes) shapes.push_back(to_json(shape));
  OrderedJson marks = OrderedJson::array();
  for (const PlaybackMark& mark : p.marks) {
    OrderedJson named = OrderedJson::array();
    for (const std::uint32_t body : mark.bodies) named.push_back(short_name(body, bodies));
    marks.push_back({{"text", printable(mark.text)}, {"step", mark.step}, {"bodies", std::move(named)}});
  }
  const auto corner = [](Vec3 v) {
    return OrderedJson{short_number(static_cast<double>(v.x)), short_number(static_cast<double>(v.y)),
                       short_number(static_cast<double>(v.z))};
  };
  return {{"name", printable(p.stamp.scene_name + ": " + p.stamp.label())},
          {"domain", {{"min", corner(p.domain.min)}, {"max", corner(p.domain.max)}}},
          {"up", corner(p.up)},
          {"dt_s", p.dt_s},
          {"last_step", p.last_step},
          {"bodies", bodies},
          {"shape_of_body", base64(shape_of_body)},
          {"shapes", std::move(shapes)},
          {"min", grid.min_json()},
          {"cell", grid.cell_json()},
          {"depth_cell_m", depth_cell},
          {"steps", std::move(steps)},
          {"positions", base64(positions)},
          {"turns", base64(turns)},
          {"pair_begin", base64(pair_begin)},
          {"pairs", base64(pairs)},
          {"contact_begin", base64(contact_begin)},
          {"contacts", base64(contacts)},
          {"marks", std::move(marks)}};
}

}  // namespace

std::uint64_t playback_bytes(const Playback& playback) {
  std::uint64_t bytes = 0;
  for (const PlaybackShape& shape : playback.shapes) {
    for (const auto& level : shape.levels) bytes += 12 * level.size();
    bytes += 6 * shape.vertices.size() + 6 * shape.triangles.size();
  }
  for (const PlaybackFrame& frame : playback.frames)
    bytes +=
        16 + 6 * frame.position.size() + 8 * frame.turn.size() + 4 * frame.pairs.size() + 18 * frame.contacts.size();
  return bytes * 4 / 3;  // base64
}

std::string playbacks_json(const std::vector<Playback>& playbacks) {
  OrderedJson all = OrderedJson::array();
  for (const Playback& playback : playbacks) all.push_back(to_json(playback));
  return script_safe(all.dump(-1, ' ', true, OrderedJson::error_handler_t::replace));
}

}  // namespace broadside::reports
