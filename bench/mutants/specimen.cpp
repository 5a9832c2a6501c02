#include "bench/mutants/specimen.hpp"

#include <optional>
#include <utility>

#include "core/method/rigid/point_digest.hpp"
#include "core/scene/scene.hpp"
#include "reference/octree_cpu/rigid/rigid_declaration.hpp"
#include "reference/octree_cpu/rigid/rigid_pipeline.hpp"
#include "reference/plain_rigid/engine.hpp"
#include "validation/judge.hpp"

namespace broadside::bench {
namespace {

std::vector<std::uint64_t> steps_of(const Specimen& specimen) {
  std::vector<std::uint64_t> steps;
  for (const core::FrameRecord& frame : specimen.frames) steps.push_back(frame.step);
  return steps;
}

validation::FrameSource source_of(const Specimen& specimen, const std::vector<std::uint64_t>& steps) {
  return {specimen.header, steps,
          [&specimen](std::uint64_t index, std::uint32_t) {
            return core::Result<core::FrameRecord>(specimen.frames[index]);
          },
          specimen.statistics};
}

struct Recorder {
  std::string_view engine;
  std::string_view settings;
  core::Declaration declaration;
};

core::Result<Specimen> record(const core::Scene& scene, core::Dynamics& dynamics, const Recorder& by) {
  Specimen specimen;
  specimen.header.scene = scene;
  core::Stamp& stamp = specimen.header.stamp;
  stamp.scene_name = scene.name;
  stamp.scene_digest = core::scene_digest(scene);
  stamp.engine = by.engine;
  stamp.settings = by.settings;
  specimen.header.declaration = by.declaration;
  specimen.header.groups = dynamics.groups();
  if (core::Status s = dynamics.load(specimen.header.scene); !s) return s.error();
  core::PenetrationCounter counter(scene.parameters.delta_m);
  const auto keep = [&specimen](const std::optional<core::PenetrationStatistics>& row) {
    if (row) specimen.statistics.push_back(*row);
  };
  for (std::uint32_t step = 0; step < scene.frames; ++step) {
    if (core::Status s = dynamics.step(scene.dt_s); !s) return s.error();
    core::FrameRecord frame;
    if (core::Status s = dynamics.read_back(frame, core::RecordLevel::kFull); !s) return s.error();
    keep(counter.add(frame.step, frame.contacts));
    specimen.frames.push_back(std::move(frame));
  }
  keep(counter.rest());
  return specimen;
}

}  // namespace

core::Result<Specimen> record_specimen(const core::Scene& scene, core::Dynamics& dynamics, std::string_view settings) {
  return record(scene, dynamics, {"octree-cpu", settings, core::method_declaration()});
}

core::Result<Specimen> record_rigid_specimen(const core::Scene& scene, core::Dynamics& dynamics) {
  return record(scene, dynamics, {"plain-rigid", "", reference::plain::declaration({})});
}

core::Result<Specimen> record_turning_specimen(const core::Scene& scene, core::Dynamics& dynamics) {
  const auto* pipeline = dynamic_cast<const reference::RigidPipeline*>(&dynamics);
  auto specimen =
      record(scene, dynamics,
             {"octree-cpu", "",
              pipeline != nullptr ? pipeline->declaration_for(scene) : reference::rigid_declaration({}, scene)});
  if (specimen) specimen.value().header.notes["digest"] = core::kDigestWithPoints;
  return specimen;
}

core::Result<std::vector<core::Verdict>> judge_specimen(const Specimen& subject, const Specimen* baseline,
                                                        std::vector<std::string> only) {
  validation::JudgeOptions options;
  options.only = std::move(only);
  const auto steps = steps_of(subject);
  const validation::FrameSource source = source_of(subject, steps);
  if (baseline == nullptr) return validation::judge(source, nullptr, options);
  const auto baseline_steps = steps_of(*baseline);
  const validation::FrameSource other = source_of(*baseline, baseline_steps);
  return validation::judge(source, &other, options);
}

}  // namespace broadside::bench
