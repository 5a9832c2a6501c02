#include "datasets/box_streams/broadmark_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"

namespace broadside::datasets {
namespace {

constexpr double kStep_s = 1.0 / 30.0;
constexpr std::uint32_t kBroadmarkFrames = 300;
constexpr double kGravity_m_s2 = 9.81;
constexpr double kGravityScale = 4.0;
// Cosine and sine of 360 / 30 / 6.2 degrees, as literals, because libraries differ in the last bit of both.
constexpr double kCos = 0.999429490929718;
constexpr double kSin = 0.03377414188346815;

Triple in_ball(RandomStream& random, double radius) {
  const RandomStream::Direction d = random.direction();
  const double r = radius * cube_root(random.unit());
  return {r * d.x, r * d.y, r * d.z};
}

// v rotated about the unit axis u by the angle above (Rodrigues).
Triple turned(const Triple& v, const Triple& u) {
  const double along = (v[0] * u[0] + v[1] * u[1] + v[2] * u[2]) * (1.0 - kCos);
  return {v[0] * kCos + (u[1] * v[2] - u[2] * v[1]) * kSin + u[0] * along,
          v[1] * kCos + (u[2] * v[0] - u[0] * v[2]) * kSin + u[1] * along,
          v[2] * kCos + (u[0] * v[1] - u[1] * v[0]) * kSin + u[2] * along};
}

// A quaternion w x y z.
using TurnParts = std::array<double, 4>;

TurnParts normalized(TurnParts q) {
  const double norm = std::sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
  for (double& c : q) c /= norm;
  return q;
}

TurnParts product(const TurnParts& p, const TurnParts& q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

// Sides of the box around a unit cube that is rotated by q: the sums of magnitudes in the rows of the rotation matrix.
Triple sides_of_turned_cube(const TurnParts& q) {
  const auto [w, x, y, z] = q;
  return {std::abs(1.0 - 2.0 * (y * y + z * z)) + std::abs(2.0 * (x * y - w * z)) + std::abs(2.0 * (x * z + w * y)),
          std::abs(2.0 * (x * y + w * z)) + std::abs(1.0 - 2.0 * (x * x + z * z)) + std::abs(2.0 * (y * z - w * x)),
          std::abs(2.0 * (x * z - w * y)) + std::abs(2.0 * (y * z + w * x)) + std::abs(1.0 - 2.0 * (x * x + y * y))};
}

class BroadmarkWorld {
 public:
  BroadmarkWorld(BroadmarkScene scene, BroadmarkObjects objects, std::uint32_t n, std::uint64_t seed)
      : scene_(scene), random_(seed), width_(cube_root(n / 0.1)), top_speed_(0.75 * width_) {
    const double half = 0.5 * width_;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Triple from_middle = in_ball(random_, 0.45 * width_);
      centers_.push_back({half + from_middle[0], half + from_middle[1], half + from_middle[2]});
      velocities_.push_back(in_ball(random_, top_speed_));
      if (objects == BroadmarkObjects::kAssorted)
        sides_.push_back(drawn(random_, 0.1, 1.9));
      else
        sides_.push_back({1.0, 1.0, 1.0});
      if (objects != BroadmarkObjects::kCubes) continue;
      turns_.push_back({1.0, 0.0, 0.0, 0.0});
      const Triple spin = in_ball(random_, 1.0);
      spins_.push_back(normalized({1.0, 0.5 * kStep_s * spin[0], 0.5 * kStep_s * spin[1], 0.5 * kStep_s * spin[2]}));
    }
    is_resting_.assign(n, false);
    if (scene == BroadmarkScene::kFreefall) {
      cells_ = static_cast<std::size_t>(width_) + 1;
      heights_.assign(cells_ * cells_, 0.0);
    }
  }

  std::vector<core::Box> boxes() const {
    std::vector<core::Box> boxes;
    boxes.reserve(centers_.size());
    for (std::size_t i = 0; i < centers_.size(); ++i) boxes.push_back(box_of(centers_[i], sides_[i]));
    return boxes;
  }

  void advance(std::vector<core::Box>& boxes) {
    if (scene_ == BroadmarkScene::kBrownian) stir();
    if (scene_ == BroadmarkScene::kTurningGravity) {
      axis_ = turned(axis_, {0.0, 0.0, 1.0});
      down_ = turned(down_, axis_);
    }
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (is_resting_[i]) continue;
      fly(i);
      boxes[i] = box_of(centers_[i], sides_[i]);
    }
  }

 private:
  void stir() {
    const std::size_t n = centers_.size();
    for (std::size_t k = 0; k < (n + 99) / 100; ++k) {
      velocities_[next_] = in_ball(random_, top_speed_);
      next_ = (next_ + 1) % n;
    }
  }

  Triple acceleration() const {
    if (scene_ == BroadmarkScene::kBrownian) return {0.0, 0.0, 0.0};
    if (scene_ == BroadmarkScene::kFreefall) return {0.0, -kGravity_m_s2, 0.0};
    const double g = kGravityScale * kGravity_m_s2;
    return {g * down_[0], g * down_[1], g * down_[2]};
  }

  void fly(std::size_t i) {
    const Triple a = acceleration();
    for (int k = 0; k < 3; ++k) {
      double& v = velocities_[i][k];
      double& x = centers_[i][k];
      v = std::clamp(v + kStep_s * a[k], -top_speed_, top_speed_);
      x += kStep_s * v;
      // Reflected at the wall; a step is at most a fortieth of the width.
      if (x < 0.0) x = -x, v = -v;
      if (x > width_) x = 2.0 * width_ - x, v = -v;
    }
    if (!turns_.empty()) {
      turns_[i] = normalized(product(spins_[i], turns_[i]));
      sides_[i] = sides_of_turned_cube(turns_[i]);
    }
    if (scene_ == BroadmarkScene::kFreefall) land(i);
  }

  void land(std::size_t i) {
    double& height =
        heights_[static_cast<std::size_t>(centers_[i][0]) * cells_ + static_cast<std::size_t>(centers_[i][2])];
    const double half = 0.5 * sides_[i][1];
    if (velocities_[i][1] > 0.0 || centers_[i][1] - half > height) return;
    centers_[i][1] = height + half;
    height += sides_[i][1];
    is_resting_[i] = true;
  }

  BroadmarkScene scene_;
  RandomStream random_;
  double width_;
  double top_speed_;
  std::vector<Triple> centers_;
  std::vector<Triple> velocities_;
  std::vector<Triple> sides_;
  std::vector<TurnParts> turns_;  // orientations of tumbling cubes, and their rotation per step
  std::vector<TurnParts> spins_;
  std::vector<bool> is_resting_;
  std::vector<double> heights_;  // the height of the pile over each unit square of ground
  std::size_t cells_ = 0;
  std::size_t next_ = 0;  // the next object that gets a new velocity
  Triple axis_{0.0, 1.0, 0.0};
  Triple down_{-1.0, 0.0, 0.0};
};

}  // namespace

BoxStream broadmark_boxes(BroadmarkScene scene, BroadmarkObjects objects, std::uint32_t n, std::uint64_t seed) {
  auto world = std::make_shared<BroadmarkWorld>(scene, objects, n, seed);
  BoxStream stream;
  stream.frames = kBroadmarkFrames;
  stream.boxes = world->boxes();
  stream.advance = [world](std::vector<core::Box>& boxes) {
    world->advance(boxes);
    return core::Status(core::Done{});
  };
  return stream;
}

}  // namespace broadside::datasets
