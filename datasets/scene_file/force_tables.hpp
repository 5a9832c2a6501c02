// The tables of a scene file that describe forces on a body: [[spring]] and [[wrench]].
#pragma once

#include "core/scene/spring.hpp"
#include "core/scene/wrench.hpp"
#include "datasets/scene_file/document.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::datasets {

// core::check_scene checks whether the body exists and may be pulled. After an error both return what was read so far.
core::Spring read_spring_table(const Node& node, FileErrors& errors);
core::Wrench read_wrench_table(const Node& node, FileErrors& errors);

}  // namespace broadside::datasets
