#include "bench/shrink/trial.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "bench/engines.hpp"
#include "bench/process/child.hpp"
#include "bench/process/scratch_folder.hpp"
#include "bench/record/record.hpp"
#include "bench/shrink/engine_stream.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "validation/judge.hpp"

namespace broadside::bench {
namespace {

// Time limit of one run in a child process: the shrinker makes hundreds of trials, so it cannot wait longer for one.
constexpr double kChildLimit_s = 30.0;

core::Result<const validation::ValidatorRow*> find_validator(const std::string& name) {
  const auto rows = validation::validators();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
  if (row != rows.end()) return &*row;
  // Validators are listed in several tables; judge()'s error names all of them.
  const core::TraceHeader nothing;
  const validation::FrameSource none{nothing, {}, {}};
  return validation::judge(none, nullptr, {{name}, {}}).error();
}

core::Result<core::Verdict> only_verdict(core::Result<std::vector<core::Verdict>> verdicts) {
  if (!verdicts) return verdicts.error();
  return std::move(verdicts.value().front());
}

core::Result<TrialAnswer> ask_here(const Question& question, const validation::ValidatorRow& validator,
                                   const core::Scene& scene) {
  auto subject = EngineStream::start(scene, question.engine);
  if (!subject) return subject.error();
  std::unique_ptr<EngineStream> baseline;
  const bool is_alone_enough = validator.why_not({subject.value()->header(), nullptr, scene.frames}).empty();
  if (question.against || !is_alone_enough) {
    auto other = EngineStream::start(scene, question.against.value_or(question.engine));
    if (!other) return other.error();
    baseline = std::move(other).value();
  }
  const validation::FrameSource source = subject.value()->source();
  validation::FrameSource other = baseline ? baseline->source() : source;
  auto verdict = only_verdict(validation::judge(source, baseline ? &other : nullptr, {{question.validator}, {}}));
  if (!verdict) return verdict.error();
  return TrialAnswer{std::move(verdict).value(), subject.value()->bodies()};
}

// A trace without frames carries a scene to another process, bit for bit.
core::Status write_scene_trace(const core::Scene& scene, const std::filesystem::path& file) {
  core::TraceHeader header;
  header.scene = scene;
  header.stamp.scene_digest = core::scene_digest(scene);
  auto writer = core::TraceWriter::create(file, header);
  if (!writer) return writer.error();
  return writer.value().finish();
}

core::Result<std::filesystem::path> record_one(const core::Scene& scene, const CellSpec& spec,
                                               const std::filesystem::path& folder,
                                               const std::filesystem::path& driver) {
  const std::filesystem::path carrier = folder / "scene.h5";
  CellRequest request;
  request.source.spec = carrier.string();
  request.scene = &scene;
  request.row = spec.row;
  request.settings = spec.settings;
  request.frames = scene.frames;
  request.folder = folder;
  request.driver_trace = driver;
  auto cell = spec.row->runs_in_child ? record_cell_in_child(request, {kChildLimit_s}) : record_cell(request);
  if (!cell) return cell.error();
  if (cell.value().state != core::CellState::kRecorded)
    return core::Error{std::string(core::cell_state_word(cell.value().state)) + ": " + cell.value().reason,
                       std::string(spec.row->id), "", core::Exit::kMissing};
  return folder / cell.value().trace_file;
}

core::Result<TrialAnswer> ask_child(const Question& question, const core::Scene& scene) {
  const ScratchFolder scratch;
  if (scratch.path().empty())
    return core::Error{"no folder for temporary files", std::filesystem::temp_directory_path().string(),
                       "set TMPDIR to a folder that can be written"};
  if (core::Status s = write_scene_trace(scene, scratch.path() / "scene.h5"); !s) return s.error();
  const auto simulates = [](const CellSpec& spec) { return offers(*spec.row, "dynamics"); };
  // Engines that do not simulate need a driver. Others get none, because it may not support what the scene asks for.
  std::filesystem::path driver;
  if (!simulates(question.engine) || (question.against && !simulates(*question.against))) {
    auto recorded = record_one(scene, {find_engine("octree-cpu").value(), {}}, scratch.path(), {});
    if (!recorded) return recorded.error();
    driver = std::move(recorded).value();
  }
  auto file = record_one(scene, question.engine, scratch.path(), driver);
  if (!file) return file.error();
  auto subject = core::TraceReader::open(file.value());
  if (!subject) return subject.error();
  std::optional<core::TraceReader> baseline;
  if (question.against) {
    auto other = record_one(scene, *question.against, scratch.path(), driver);
    if (!other) return other.error();
    auto opened = core::TraceReader::open(other.value());
    if (!opened) return opened.error();
    baseline = std::move(opened).value();
  }
  auto verdict =
      only_verdict(validation::judge(subject.value(), baseline ? &*baseline : nullptr, {{question.validator}, {}}));
  if (!verdict) return verdict.error();

  TrialAnswer answer{std::move(verdict).value(), scene.bodies};
  auto states = core::TraceReader::open(simulates(question.engine) ? file.value() : driver);
  if (!states) return states.error();
  if (states.value().frame_count() == 0) return answer;
  auto last = states.value().read(states.value().frame_count() - 1, core::bit(core::Group::kBodies));
  if (!last) return last.error();
  set_states(answer.end, last.value());
  return answer;
}

}  // namespace

core::Result<TrialAnswer> ask(const Question& question, const core::Scene& scene) {
  const auto validator = find_validator(question.validator);
  if (!validator) return validator.error();
  const bool is_foreign =
      question.engine.row->runs_in_child || (question.against && question.against->row->runs_in_child);
  return is_foreign ? ask_child(question, scene) : ask_here(question, *validator.value(), scene);
}

core::Result<core::Verdict> judge_engine(const core::Scene& scene, std::string_view engine, std::string_view validator,
                                         std::string_view against) {
  auto spec = parse_cell_spec(engine);
  if (!spec) return spec.error();
  Question question{std::string(validator), std::move(spec).value(), {}};
  if (!against.empty()) {
    auto other = parse_cell_spec(against);
    if (!other) return other.error();
    question.against = std::move(other).value();
  }
  auto answer = ask(question, scene);
  if (!answer) return answer.error();
  return std::move(answer.value().verdict);
}

}  // namespace broadside::bench
