// Embree's bounding volume hierarchy collided with itself: rtcCollide over one user geometry whose primitives are the
// boxes. It was made for ray tracing, and is the strongest general-purpose tree for boxes on a CPU.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/loaded_library.hpp"
#include "reference/vendor_build.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Status;

constexpr std::string_view kId = "embree-collide";

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Scene = std::unique_ptr<RTCSceneTy, ReleaseScene>;
using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

void write_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& given = *static_cast<const GivenBoxes*>(arguments->geometryUserPtr);
  const core::Box& box = given.boxes()[arguments->primID];
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = box.min.x;
  bounds.lower_y = box.min.y;
  bounds.lower_z = box.min.z;
  bounds.upper_x = box.max.x;
  bounds.upper_y = box.max.y;
  bounds.upper_z = box.max.z;
}

// Embree calls back from its own threads, a batch at a time, and reports each pair in both orders.
using PairsOfThreads = tbb::enumerable_thread_specific<std::vector<core::Pair>>;

void collect(void* user, RTCCollision* collisions, unsigned int count) {
  std::vector<core::Pair>& pairs = static_cast<PairsOfThreads*>(user)->local();
  for (unsigned int k = 0; k < count; ++k)
    if (collisions[k].primID0 < collisions[k].primID1) pairs.push_back({collisions[k].primID0, collisions[k].primID1});
}

class EmbreeCollide final : public core::BroadPhase {
 public:
  EmbreeCollide(Device device, RTCBuildQuality quality) : device_(std::move(device)), quality_(quality) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override {
    return {.exact = true, .margin_m = 0.0, .keeps_stale_pairs = false};
  }

  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(kId, boxes, is_static); !status) return status;
    clear_found();
    scene_.reset();
    if (boxes.empty()) return core::Done{};  // rtcCollide refuses a scene without primitives
    geometry_.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryBuildQuality(geometry_.get(), quality_);
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), given_.count());
    rtcSetGeometryUserData(geometry_.get(), &given_);
    rtcSetGeometryBoundsFunction(
        geometry_.get(), [](const RTCBoundsFunctionArguments* arguments) { write_bounds(arguments); }, nullptr);
    rtcCommitGeometry(geometry_.get());
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneBuildQuality(scene_.get(), quality_);
    // Without this flag the hierarchy may be a compact one, whose boxes are rounded.
    rtcSetSceneFlags(scene_.get(), quality_ == RTC_BUILD_QUALITY_HIGH ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_DYNAMIC);
    rtcAttachGeometryByID(scene_.get(), geometry_.get(), 0);
    rtcCommitScene(scene_.get());
    return trouble("load");
  }

  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(kId, boxes); !status) return status;
    if (scene_ == nullptr) return core::Done{};
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
    return trouble("update");
  }

  Status find() override {
    clear_found();
    if (scene_ == nullptr) return core::Done{};
    rtcCollide(scene_.get(), scene_.get(), collect, &found_);
    return trouble("find");
  }

  core::Result<core::PairSet> read_back() override {
    std::vector<core::Pair> raw;
    for (const std::vector<core::Pair>& pairs : found_) raw.insert(raw.end(), pairs.begin(), pairs.end());
    return given_.tighten(std::move(raw));
  }

 private:
  // Keeps each thread's memory: the next frame needs about as much.
  void clear_found() {
    for (std::vector<core::Pair>& pairs : found_) pairs.clear();
  }

  [[nodiscard]] Status trouble(const char* stage) const {
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error == RTC_ERROR_NONE) return core::Done{};
    return core::Error{"Embree reports error " + std::to_string(error), std::string(kId) + ": " + stage,
                       error == RTC_ERROR_OUT_OF_MEMORY ? "run a smaller scene" : "see rtcore_device.h for its meaning",
                       core::Exit::kMissing};
  }

  Device device_;
  RTCBuildQuality quality_;
  GivenBoxes given_;
  Geometry geometry_;
  Scene scene_;
  PairsOfThreads found_;
};

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 2> kSettings{{
      threads_setting(),
      {"quality", "low", {"low", "medium", "high"}, "how carefully the hierarchy is built: Embree's build quality"},
  }};
  return kSettings;
}

RTCBuildQuality quality_of(const core::Settings& settings) {
  const std::string_view word = settings.text("quality");
  if (word == "high") return RTC_BUILD_QUALITY_HIGH;
  return word == "medium" ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW;
}

// The widest packets that this build of Embree supports on this processor.
std::string simd_of(RTCDevice device) {
  const auto has = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(device, property) != 0; };
  const char* lanes = has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)  ? "16"
                      : has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) ? "8"
                                                                       : "4";
  return std::string("picked by Embree for this processor, up to ") + lanes + " lanes";
}

core::EquivalenceCard card_of(RTCDevice device, const std::string& build, int threads, const std::string& quality) {
  core::EquivalenceCard card =
      library_card(build, reinterpret_cast<const void*>(&rtcCollide), "float32", simd_of(device), threads);
  card.push_back({"broad-phase margin", "none", ""});
  card.push_back({"hierarchy", "rebuilt each frame, quality " + quality, ""});
  card.push_back({"pairs", "each in both orders, one is kept", ""});
  return card;
}

std::string build_of(RTCDevice device) {
  const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);  // 31305 means 3.13.5
  return "Embree " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100) + " (" + loaded_library(reinterpret_cast<const void*>(&rtcCollide)) + "), float";
}

core::Result<core::Engine> create(const core::Settings& settings) {
  const int workers = worker_count(settings.number("threads"));
  const std::string config = "threads=" + std::to_string(workers);
  Device device(rtcNewDevice(config.c_str()));
  if (device == nullptr)
    return core::Error{"Embree cannot make a device: error " + std::to_string(rtcGetDeviceError(nullptr)),
                       std::string(kId), "its packages need a CPU with SSE2 at least", core::Exit::kMissing};
  core::Engine engine;
  engine.id = kId;
  engine.build = build_of(device.get());
  engine.settings = settings;
  // The card may be asked for after the device is gone, so its facts are read here.
  engine.equivalence = [card = card_of(device.get(), engine.build, workers, settings.text("quality"))](
                           const core::Scene&) { return card; };
  engine.broad_phase = std::make_unique<EmbreeCollide>(std::move(device), quality_of(settings));
  return engine;
}

}  // namespace

core::EngineRow embree_collide_row() {
  return {.id = kId,
          .capabilities = "broad",
          .what = "Embree's bounding volume hierarchy against itself (rtcCollide), on all threads",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
