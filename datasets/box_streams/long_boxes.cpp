#include "datasets/box_streams/long_boxes.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace broadside::datasets {

std::string long_boxes_remark(std::span<const core::Box> boxes) {
  if (boxes.empty()) return {};
  std::vector<double> lengths;
  lengths.reserve(boxes.size());
  for (const core::Box& b : boxes) {
    double longest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      longest = std::max(longest, static_cast<double>(b.max[axis]) - static_cast<double>(b.min[axis]));
    lengths.push_back(longest);
  }
  const double most = *std::max_element(lengths.begin(), lengths.end());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const double median = *middle;
  const auto longer =
      std::count_if(lengths.begin(), lengths.end(), [median](double l) { return l > kFarLonger * median; });
  if (median == 0.0 || longer == 0) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "%td of %zu boxes %s up to %.0e times longer than the median: engines that sort boxes into cells "
                "(octree, hash) can be slow on such sets",
                longer, lengths.size(), longer == 1 ? "is" : "are", most / median);
  return text;
}

}  // namespace broadside::datasets
