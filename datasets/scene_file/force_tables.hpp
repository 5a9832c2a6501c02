// The tables of a scene file that say what pulls a body: [[spring]] and [[wrench]].
#pragma once

#include "core/scene/spring.hpp"
#include "core/scene/wrench.hpp"
#include "datasets/scene_file/document.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::datasets {

// Whether the body exists and may be pulled is core::check_scene's to say. After an error both return what is there.
core::Spring read_spring_table(const Node& node, FileErrors& errors);
core::Wrench read_wrench_table(const Node& node, FileErrors& errors);

}  // namespace broadside::datasets
