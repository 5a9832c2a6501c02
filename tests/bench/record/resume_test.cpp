// A run goes on only from a trace that the very same run left.
#include "bench/record/resume.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/trace/trace_writer.hpp"
#include "datasets/scenes.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

// The header of the recorded trace: two steps of three.
core::TraceHeader header_of(const core::Scene& scene) {
  core::TraceHeader header;
  header.scene = scene;
  header.stamp = {.scene_name = scene.name,
                  .scene_digest = core::scene_digest(scene),
                  .engine = "octree-cpu",
                  .settings = "broad=tree",
                  .engine_build = "tbb 1",
                  .broadside_build = "abc",
                  .machine = "this machine"};
  header.groups = core::bit(core::Group::kBodies);
  return header;
}

void leave_trace(const std::filesystem::path& path, const core::TraceHeader& header) {
  auto writer = core::TraceWriter::create(path, header);
  ASSERT_TRUE(writer.ok()) << writer.error().line();
  for (std::uint64_t step = 1; step <= 2; ++step) {
    core::FrameRecord frame;
    frame.step = step;
    frame.time_s = static_cast<double>(step) * header.scene.dt_s;
    for (const core::Body& body : header.scene.bodies) {
      frame.position.push_back(body.position);
      frame.velocity.push_back(body.velocity);
      frame.orientation.push_back(body.orientation);
      frame.angular_velocity.push_back(body.angular_velocity);
    }
    ASSERT_TRUE(writer.value().append(frame).ok());
  }
  ASSERT_TRUE(writer.value().finish().ok());
}

TEST(Resume, GoesOnFromTheSameRunAloneWhateverDiffers) {
  const ScratchFolder folder;
  auto scene = datasets::make_scene("two-body:apart");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  bench::CellRequest request;
  request.scene = &scene.value();
  request.frames = 3;
  request.folder = folder / "";
  const core::TraceHeader recorded = header_of(scene.value());
  leave_trace(folder / "octree-cpu.h5", recorded);
  const auto same = bench::find_resume_point(request, recorded);
  ASSERT_TRUE(same.ok()) << same.error().line();
  ASSERT_TRUE(same.value().has_value());
  EXPECT_EQ(same.value()->step, 2U);
  EXPECT_FALSE(same.value()->is_complete);

  struct Change {
    const char* what;
    void (*apply)(core::TraceHeader&);
  };
  for (const Change& change : {
           Change{"scene", [](core::TraceHeader& h) { ++h.stamp.scene_digest; }},
           Change{"settings", [](core::TraceHeader& h) { h.stamp.settings = "broad=octree"; }},
           Change{"build of the engine", [](core::TraceHeader& h) { h.stamp.engine_build = "tbb 2"; }},
           Change{"build of Broadside", [](core::TraceHeader& h) { h.stamp.broadside_build = "def"; }},
           Change{"machine", [](core::TraceHeader& h) { h.stamp.machine = "another machine"; }},
           Change{"steps", [](core::TraceHeader& h) { h.every = 2; }},
           Change{"steps", [](core::TraceHeader& h) { h.notes["windows of steps"] = "1:2"; }},
       }) {
    core::TraceHeader wanted = recorded;
    change.apply(wanted);
    const auto other = bench::find_resume_point(request, wanted);
    ASSERT_FALSE(other.ok()) << change.what;
    EXPECT_NE(other.error().line().find(change.what), std::string::npos) << other.error().line();
  }
}

}  // namespace
}  // namespace broadside::tests
