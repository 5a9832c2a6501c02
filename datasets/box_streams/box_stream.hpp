// Scenes that consist of boxes alone, for broad phases on precomputed inputs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::datasets {

// Frames are made one after another, because a hundred frames of a million boxes would take 2.4 GB. All boxes are
// finite, min <= max.
struct BoxStream {
  std::string name;  // "boxes:uniform:100000", or the file's name
  std::string what;
  std::uint32_t frames = 1;
  std::vector<core::Box> boxes;  // frame 0
  // Turns the boxes of one frame into those of the next. It keeps state of its own, so it must be called in order, from
  // frame 0, once for each further frame. Empty when there is one frame. Only a stream from a file can fail.
  std::function<core::Status(std::vector<core::Box>&)> advance;
};

struct BoxStreamRow {
  std::string_view pattern;  // "boxes:uniform:N"
  std::string_view example;
  std::string_view what;
  bool is_seeded = true;   // another seed gives other boxes
  bool is_counted = true;  // what follows the prefix is the number of boxes

  // "boxes:uniform:"
  [[nodiscard]] std::string_view prefix() const { return pattern.substr(0, pattern.rfind(':', pattern.find('[')) + 1); }
};

std::vector<BoxStreamRow> box_stream_table();

// `spec` is a name of the table, the path of a raw box file (it ends in .boxes or .bin), or the path of an HDF5 file
// (.h5, .h5.part): a stream of boxes, or a trace, whose detection boxes are then the stream. Errors: an unknown name
// (the error suggests a similar one); N outside 0 to the set's maximum; a file that cannot be read; and the first box
// that is NaN, infinite, or has min above max, by frame, number and axis.
core::Result<BoxStream> make_box_stream(const std::string& spec, std::optional<std::uint64_t> seed = {});

// Whether `spec` names boxes of a known kind, without making any: for a check before other arguments are examined.
core::Status check_boxes_name(const std::string& spec);

}  // namespace broadside::datasets
