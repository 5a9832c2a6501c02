#include "datasets/scene_file/force_tables.hpp"

#include <array>
#include <string>
#include <string_view>

#include "core/nearest_name.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {

core::Spring read_spring_table(const Node& node, FileErrors& errors) {
  core::Spring spring;
  if (errors.first) return spring;
  TableReader table(node, "this spring", errors);
  const bool has_body = table.whole("body", 0U, kMaxBodies, spring.body);
  const bool has_anchor = table.vec3("anchor_m", spring.anchor);
  table.number("stiffness_n_m", spring.stiffness_n_m);
  table.number("damping_n_s_m", spring.damping_n_s_m);
  table.finish();
  if (!has_body || !has_anchor)
    errors.add(node.line, "the spring is not complete", "give body = 0, counted from 0, and anchor_m = [x, y, z]");
  return spring;
}

core::Wrench read_wrench_table(const Node& node, FileErrors& errors) {
  constexpr std::array<std::string_view, 2> kAxes{"world", "body"};
  core::Wrench wrench;
  if (errors.first) return wrench;
  TableReader table(node, "this wrench", errors);
  const bool has_body = table.whole("body", 0U, kMaxBodies, wrench.body);
  std::string axes(kAxes[0]);
  table.text("axes", axes);
  table.vec3("force_n", wrench.force_n);
  table.vec3("torque_n_m", wrench.torque_n_m);
  if (axes != kAxes[0] && axes != kAxes[1])
    table.fail("axes", "there are no axes '" + axes + "'", core::advise_name(axes, kAxes));
  wrench.axes = axes == kAxes[1] ? core::WrenchAxes::kBody : core::WrenchAxes::kWorld;
  table.finish();
  if (!has_body) errors.add(node.line, "the wrench has no body", "give body = 0, counted from 0");
  return wrench;
}

}  // namespace broadside::datasets
