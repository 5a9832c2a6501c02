#include "bench/shrink/trace_start.hpp"

#include <algorithm>

#include "bench/shrink/engine_stream.hpp"
#include "core/trace/trace_reader.hpp"
#include "validation/judge.hpp"

namespace broadside::bench {

core::Result<std::optional<core::Scene>> start_before_fault(const std::string& trace, const Question& question,
                                                            const Oracle& oracle) {
  const std::optional<core::Scene> none;
  auto opened = core::TraceReader::open(trace);
  if (!opened) return opened.error();
  const core::TraceReader& reader = opened.value();
  auto verdicts = validation::judge(reader, nullptr, {{question.validator}, {}});
  if (!verdicts) return verdicts.error();
  const core::Verdict& verdict = verdicts.value().front();
  constexpr std::uint32_t kBodies = core::bit(core::Group::kBodies);
  if (verdict.outcome != core::Outcome::kFail || verdict.worst.step < 2 || (reader.header().groups & kBodies) == 0)
    return none;
  const auto before = static_cast<std::uint64_t>(verdict.worst.step) - 1;
  const auto& steps = reader.steps();
  const auto at = std::lower_bound(steps.begin(), steps.end(), before);
  if (at == steps.end() || *at != before) return none;
  auto frame = reader.read(static_cast<std::uint64_t>(at - steps.begin()), kBodies);
  if (!frame) return frame.error();
  core::Scene scene = reader.header().scene;
  set_states(scene.bodies, frame.value());
  scene.frames = 1;
  if (!core::check_scene(scene)) return none;
  const auto answer = oracle(scene);
  if (!answer || answer.value().verdict.outcome != core::Outcome::kFail) return none;
  return std::optional<core::Scene>(std::move(scene));
}

}  // namespace broadside::bench
