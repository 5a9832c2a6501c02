#include "bench/shrink/shrink_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "bench/process/interrupt.hpp"
#include "bench/shrink/minimal_subset.hpp"
#include "bench/shrink/simpler_scene.hpp"
#include "core/contact.hpp"
#include "core/mesh/clean_mesh.hpp"

namespace broadside::bench {
namespace {

using core::Scene;

// The longest piece of a run between two checks of the verdict.
constexpr std::uint32_t kLongestPiece = 64;
// Pieces stop growing once a piece takes 1 / kPiecesInTime of the time limit.
constexpr double kPiecesInTime = 40.0;
// With more numbers than this in a scene, digits are removed from all numbers together and not one by one.
constexpr std::uint64_t kManyNumbers = 2000;

std::uint64_t triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const auto& mesh : scene.meshes) count += mesh->triangles.size();
  return count;
}

bool has_clean_meshes(const Scene& scene) {
  return std::all_of(scene.meshes.begin(), scene.meshes.end(), [](const auto& mesh) {
    core::Mesh copy = *mesh;
    return core::clean_mesh(copy).is_nothing();
  });
}

class SceneShrinker {
 public:
  SceneShrinker(const Oracle& oracle, const ShrinkLimits& limits) : oracle_(oracle), limits_(limits) {}

  core::Result<ShrunkScene> run(const Scene& scene) {
    if (core::Status s = find_fault(scene); !s) return s.error();
    is_clean_ = has_clean_meshes(scene);
    tell();
    for (std::uint64_t before = ~std::uint64_t{0}; before != changes_ && !is_spent();) {
      before = changes_;
      drop_frames();
      drop_bodies();
      drop_springs();
      simplify_meshes();
      make_plainer();
      drop_digits();
    }
    return ShrunkScene{std::move(best_), std::move(verdict_), trials_, elapsed_s(), is_spent()};
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool is_spent() const { return elapsed_s() > limits_.time_s || is_interrupted(); }

  // Runs a scene. An error of a smaller scene only means that this scene does not show the fault.
  std::optional<TrialAnswer> ask(const Scene& scene) {
    ++trials_;
    auto answer = oracle_(scene);
    if (!answer) {
      last_error_ = answer.error();
      return std::nullopt;
    }
    return std::move(answer).value();
  }

  // Takes the scene when it still gets the verdict. Meshes that were clean must stay clean: otherwise the reader of the
  // scene's file would clean them and load different meshes.
  bool take(const Scene& scene) {
    if (!core::check_scene(scene) || (is_clean_ && !has_clean_meshes(scene))) return false;
    auto answer = ask(scene);
    if (!answer || answer->verdict.outcome != wanted_) return false;
    accept(scene, std::move(*answer));
    return true;
  }

  void accept(const Scene& scene, TrialAnswer answer) {
    best_ = scene;
    verdict_ = std::move(answer.verdict);
    ++changes_;
  }

  // Tells each new size once.
  void tell() {
    const std::string size =
        fmt::format("{} bodies, {} frames, {} triangles", best_.body_count(), best_.frames, triangle_count(best_));
    if (!limits_.tell || size == told_) return;
    told_ = size;
    limits_.tell(fmt::format("{} ({} runs, {:.1f} s)", size, trials_, elapsed_s()));
  }

  // Runs the scene piece by piece, each piece from the end of the one before, until a piece gets the verdict. An engine
  // with more state than its bodies' may need all frames from the start; then the whole scene is run.
  core::Status find_fault(const Scene& scene) {
    Scene piece = scene;
    std::uint32_t length = 1;
    for (std::uint32_t done = 0; done < scene.frames;) {
      if (is_spent())
        return core::Error{fmt::format("no fault was found in the first {} of {} frames within {:.0f} s", done,
                                       scene.frames, limits_.time_s),
                           scene.name, "give more time (--time-limit), or the trace that shows the fault",
                           core::Exit::kMissing};
      piece.frames = std::min(length, scene.frames - done);
      const double began_s = elapsed_s();
      auto answer = ask(piece);
      if (!answer) return *last_error_;
      // A piece may be inconclusive where the whole run is not, so only a fail counts here.
      if (answer->verdict.outcome == core::Outcome::kFail) {
        wanted_ = answer->verdict.outcome;
        accept(piece, std::move(*answer));
        return core::Done{};
      }
      piece.bodies = std::move(answer->end);
      done += piece.frames;
      // A longer piece wastes more: the frames after the fault in it, and the time that is left.
      if (elapsed_s() - began_s < limits_.time_s / kPiecesInTime) length = std::min(2 * length, kLongestPiece);
    }
    auto answer = ask(scene);
    if (!answer) return *last_error_;
    if (answer->verdict.outcome != core::Outcome::kFail && answer->verdict.outcome != core::Outcome::kInconclusive)
      return core::Error{fmt::format("the verdict is {}: {}", core::outcome_word(answer->verdict.outcome),
                                     answer->verdict.explanation),
                         scene.name, "there is nothing to shrink; name a validator that fails"};
    wanted_ = answer->verdict.outcome;
    accept(scene, std::move(*answer));
    return core::Done{};
  }

  // Tries one frame from the state just before the worst place. If that does not fail, takes the shortest run from the
  // start that shows the fault, and then starts it as late as possible.
  void drop_frames() {
    if (best_.frames <= 1 || is_spent()) return;
    const std::int64_t worst = verdict_.worst.step;
    if (worst > 1 && start_at(static_cast<std::uint32_t>(worst - 1), 1)) return tell();
    std::uint32_t low = 1;
    std::uint32_t high = best_.frames;
    while (low < high && !is_spent()) {
      const std::uint32_t middle = low + (high - low) / 2;
      Scene shorter = best_;
      shorter.frames = middle;
      if (take(shorter))
        high = middle;
      else
        low = middle + 1;
    }
    const std::uint32_t all = best_.frames;
    for (std::uint32_t left = 1; left < all && !is_spent(); left *= 2)
      if (start_at(all - left, left)) break;
    tell();
  }

  // The state after `skipped` frames becomes the start, and `frames` are run from there.
  bool start_at(std::uint32_t skipped, std::uint32_t frames) {
    Scene before = best_;
    before.frames = skipped;
    const auto answer = ask(before);
    if (!answer) return false;
    Scene later = best_;
    later.bodies = answer->end;
    later.frames = frames;
    return take(later);
  }

  // Faults are local, so first the bodies that the verdict names and those around them are tried, then any subset.
  void drop_bodies() {
    if (best_.body_count() <= 1 || is_spent()) return;
    const Scene whole = best_;
    std::vector<std::uint32_t> named;
    for (const std::uint32_t b : verdict_.worst.bodies)
      if (!core::is_face(b) && b < whole.body_count()) named.push_back(b);
    std::vector<std::uint32_t> kept(whole.body_count());
    std::iota(kept.begin(), kept.end(), 0U);
    if (!named.empty()) {
      const std::vector<std::uint32_t> order = by_distance(whole, named);
      for (std::size_t count = named.size(); count < order.size() && !is_spent(); count *= 4) {
        const std::vector<std::uint32_t> near(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
        if (!take(with_bodies(whole, near))) continue;
        kept = near;
        std::sort(kept.begin(), kept.end());
        tell();
        break;
      }
    }
    minimal_subset(
        std::move(kept), [&](const std::vector<std::uint32_t>& part) { return take(with_bodies(whole, part)); },
        [&] { return is_spent(); });
    tell();
  }

  void drop_springs() {
    if (best_.springs.empty() || is_spent()) return;
    if (take(with_springs(best_, {}))) return;
    const Scene whole = best_;
    std::vector<std::uint32_t> springs(whole.springs.size());
    std::iota(springs.begin(), springs.end(), 0U);
    minimal_subset(
        std::move(springs), [&](const std::vector<std::uint32_t>& part) { return take(with_springs(whole, part)); },
        [&] { return is_spent(); });
  }

  void simplify_meshes() {
    for (std::size_t m = 0; m < best_.meshes.size() && !is_spent(); ++m) {
      if (const auto boxed = with_box_mesh(best_, m)) take(*boxed);
      const Scene whole = best_;
      std::vector<std::uint32_t> triangles(whole.meshes[m]->triangles.size());
      std::iota(triangles.begin(), triangles.end(), 0U);
      minimal_subset(
          std::move(triangles),
          [&](const std::vector<std::uint32_t>& part) {
            const auto fewer = with_triangles(whole, m, part);
            return fewer && take(*fewer);
          },
          [&] { return is_spent(); });
    }
    tell();
  }

  bool take_if_other(const Scene& scene) {
    return core::scene_digest(scene) != core::scene_digest(best_) && take(scene);
  }

  // Each edit is taken at most once: rounding digits could undo another edit, and the two would alternate forever.
  void make_plainer() {
    for (int k = 0; k < kPlainerCount && !is_spent(); ++k)
      if (!is_plain_[k]) is_plain_[k] = take_if_other(made_plainer(best_, static_cast<Plainer>(k)));
  }

  void drop_digits() {
    for (int digits = 1; digits < kAllDigits && !is_spent(); ++digits) {
      if (take_if_other(with_digits_everywhere(best_, digits))) break;
    }
    if (digit_count(best_) > kManyNumbers) return tell();
    for (std::uint64_t k = 0; k < digit_count(best_) && !is_spent(); ++k)
      for (int digits = 0; digits < kAllDigits && !is_spent(); ++digits) {
        const Scene rounded = with_digits(best_, k, digits);
        if (core::scene_digest(rounded) == core::scene_digest(best_)) break;
        if (take(rounded)) break;
      }
    tell();
  }

  const Oracle& oracle_;
  const ShrinkLimits& limits_;
  Clock::time_point start_ = Clock::now();
  std::uint64_t trials_ = 0;
  std::uint64_t changes_ = 0;
  core::Outcome wanted_ = core::Outcome::kFail;
  bool is_clean_ = false;
  std::array<bool, kPlainerCount> is_plain_{};
  Scene best_;
  core::Verdict verdict_;
  std::string told_;
  std::optional<core::Error> last_error_;
};

}  // namespace

core::Result<ShrunkScene> shrink_scene(const Scene& scene, const Oracle& oracle, const ShrinkLimits& limits) {
  return SceneShrinker(oracle, limits).run(scene);
}

}  // namespace broadside::bench
