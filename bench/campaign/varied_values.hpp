// The table [vary] of a campaign file: names, each with a list of values as text.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datasets/scene_file/table_reader.hpp"

namespace broadside::bench::campaign {

using Values = std::map<std::string, std::vector<std::string>>;

// Null = there is no such table, so there are no values. Anything but a list of texts and whole numbers is added to the
// errors.
Values read_values(const datasets::Node* vary, datasets::FileErrors& errors);

}  // namespace broadside::bench::campaign
