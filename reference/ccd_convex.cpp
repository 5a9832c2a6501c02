// libccd on convex bodies: whether the hull of A's vertices, or the primitive that they draw, meets B's, how deep, and
// along which direction. It gives no distance for bodies that are apart.
#include <ccd/ccd.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/scene/primitive.hpp"
#include "reference/engines.hpp"
#include "reference/pair_check.hpp"
#include "reference/turned_shapes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/vendor_defects.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;
using core::Vec3;

constexpr std::string_view kId = "ccd";
// The tolerance at which EPA and MPR stop refining, m: ten times the rounding of a float coordinate of 1 m, so that the
// library does not compute digits that the poses lack. Its default, 1e-4, is a tenth of the method's slop.
constexpr ccd_real_t kTolerance = 1e-6;
// EPA compares its tolerance with squares: of the distance of a new point from the face that it would split, and of
// distances from the origin. 1e-6 would leave the depth of round bodies off by a millimeter.
constexpr ccd_real_t kEpaTolerance = kTolerance * kTolerance;
// GJK on polytopes ends after a few tens of steps; libccd's default is 2^64 - 1, so a cycle would never end.
constexpr unsigned long kMostIterations = 1000;

// A convex body: the points whose hull it is, turned already, in float as the pipeline turns them, with a ball of this
// radius around each (METHOD has no such radius; a sphere is one point, a capsule two).
struct Points {
  std::vector<Vec3> points;
  double radius_m = 0.0;
  ccd_vec3_t middle;  // inside the hull, before the move

  explicit Points(std::vector<Vec3> turned, double radius = 0.0) : points(std::move(turned)), radius_m(radius) {
    ccdVec3Set(&middle, 0, 0, 0);
    for (const Vec3 p : points) {
      const ccd_vec3_t v{{p.x, p.y, p.z}};
      ccdVec3Add(&middle, &v);
    }
    ccdVec3Scale(&middle, CCD_ONE / static_cast<ccd_real_t>(points.size()));
  }
};

struct Placed {
  const Points* shape;
  Vec3 x;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const auto& body = *static_cast<const Placed*>(object);
  ccd_real_t most = -std::numeric_limits<ccd_real_t>::infinity();
  Vec3 farthest;
  for (const Vec3 p : body.shape->points) {
    const ccd_real_t along = p.x * direction->v[0] + p.y * direction->v[1] + p.z * direction->v[2];
    if (along > most) {
      most = along;
      farthest = p;
    }
  }
  const Vec3 placed = farthest + body.x;
  ccdVec3Set(out, placed.x, placed.y, placed.z);
  if (body.shape->radius_m == 0.0) return;
  const ccd_real_t size = std::sqrt(ccdVec3Len2(direction));
  if (!(size > 0.0)) return;
  ccd_vec3_t ball = *direction;
  ccdVec3Scale(&ball, body.shape->radius_m / size);
  ccdVec3Add(out, &ball);
}

void middle(const void* object, ccd_vec3_t* out) {
  const auto& body = *static_cast<const Placed*>(object);
  ccdVec3Copy(out, &body.shape->middle);
  const ccd_vec3_t x{{body.x.x, body.x.y, body.x.z}};
  ccdVec3Add(out, &x);
}

Vec3 to_core(const ccd_vec3_t& v) {
  return {static_cast<float>(v.v[0]), static_cast<float>(v.v[1]), static_cast<float>(v.v[2])};
}

bool is_finite(const ccd_vec3_t& v) {
  return std::isfinite(v.v[0]) && std::isfinite(v.v[1]) && std::isfinite(v.v[2]);
}

Separation measure_one(const Placed& a, const Placed& b, bool is_mpr, DefectCounter& not_numbers) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.center1 = ccd.center2 = middle;
  ccd.max_iterations = kMostIterations;
  ccd.epa_tolerance = kEpaTolerance;
  ccd.mpr_tolerance = ccd.dist_tolerance = kTolerance;
  ccd_real_t depth = 0;
  ccd_vec3_t direction{};
  ccd_vec3_t at{};
  const int outcome = is_mpr ? ccdMPRPenetration(&a, &b, &ccd, &depth, &direction, &at)
                             : ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &at);
  if (outcome == -2) throw std::bad_alloc();
  Separation out;
  if (outcome != 0) {
    out.distance_m = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  out.is_touching = true;
  // GJK is known to give NaN (issue 25 of libccd): then it is only known that the bodies meet.
  const bool is_number = std::isfinite(depth) && is_finite(direction) && is_finite(at);
  not_numbers.note(is_number ? 0 : 1, 1);
  if (!is_number) return out;
  out.distance_m = -static_cast<double>(depth);
  // libccd's direction moves B away from A: ours points from B to A.
  ccdVec3Scale(&direction, -CCD_ONE);
  out.normal = to_core(direction);
  // libccd gives one point only: it stands for both witnesses.
  out.witness_a = out.witness_b = to_core(at);
  return out;
}

std::vector<Vec3> turned(const core::Mesh& mesh, core::Quat orientation) {
  std::vector<Vec3> points = mesh.vertices;
  for (Vec3& p : points) p = core::rotate(orientation, p);
  return points;
}

std::vector<Vec3> corners_of(const core::Box& box) {
  std::vector<Vec3> points;
  points.reserve(8);
  for (int corner = 0; corner < 8; ++corner) {
    points.push_back({(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                      (corner & 4) != 0 ? box.max.z : box.min.z});
  }
  return points;
}

enum class ShapeChoice { kHull, kBox, kPrimitive };

// The primitive that the mesh draws, or its hull where it draws none.
std::unique_ptr<Points> primitive_points(const core::Mesh& mesh, core::Quat q) {
  const auto primitive = core::primitive_of(mesh);
  if (!primitive) return std::make_unique<Points>(turned(mesh, q));
  if (primitive->kind == core::PrimitiveKind::kSphere)
    return std::make_unique<Points>(std::vector<Vec3>{{}}, primitive->radius_m);
  if (primitive->kind == core::PrimitiveKind::kCapsule) {
    const Vec3 end = core::rotate(q, core::axis_vector(primitive->axis, primitive->half_length_m()));
    return std::make_unique<Points>(std::vector<Vec3>{-1.0F * end, end}, primitive->radius_m);
  }
  std::vector<Vec3> corners = corners_of({-1.0F * primitive->half_extents, primitive->half_extents});
  for (Vec3& p : corners) p = core::rotate(q, p);
  return std::make_unique<Points>(std::move(corners));
}

std::unique_ptr<Points> points_of(ShapeChoice choice, const core::Mesh& mesh, core::Quat q) {
  if (choice == ShapeChoice::kPrimitive) return primitive_points(mesh, q);
  return std::make_unique<Points>(choice == ShapeChoice::kBox ? corners_of(turned_bounds(mesh, q)) : turned(mesh, q));
}

class CcdConvex final : public core::NarrowPhase {
 public:
  CcdConvex(bool is_mpr, ShapeChoice choice, int workers, SharedDefectCounter not_numbers)
      : is_mpr_(is_mpr),
        choice_(choice),
        arena_(workers),
        not_numbers_(std::move(not_numbers)),
        shapes_([choice](const core::Mesh& mesh, core::Quat q) { return points_of(choice, mesh, q); }) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("ccd: load", [&]() -> Status {
      if (choice_ == ShapeChoice::kPrimitive)
        for (const auto& mesh : scene.meshes)
          if (Status status = refuse_cylinder(kId, *mesh); !status) return status;
      shapes_.load(scene);
      return core::Done{};
    });
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kId, pairs, poses, shapes_.body_count()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("ccd: measure", [&]() -> Status {
      const std::vector<const Points*> shapes = shapes_.of(pairs, poses);
      arena_.execute([&] {
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
          const auto [i, j] = pairs[k];
          separations_[k] =
              measure_one({shapes[i], poses[i].position}, {shapes[j], poses[j].position}, is_mpr_, *not_numbers_);
        });
      });
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  bool is_mpr_;
  ShapeChoice choice_;
  tbb::task_arena arena_;
  SharedDefectCounter not_numbers_;
  TurnedShapes<Points> shapes_;
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 3> kSettings{{
      {"algorithm",
       "gjk",
       {"gjk", "mpr"},
       "GJK with EPA: the least depth; or Minkowski portal refinement: a depth along the line of centers, not the "
       "least"},
      {"shape",
       "hull",
       {"hull", "box", "primitive"},
       "the hull of a body's vertices, its axis-aligned box, or the box, sphere or capsule that its mesh draws"},
      threads_setting(),
  }};
  return kSettings;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kId;
  engine.build = ccd_build();
  engine.settings = settings;
  const std::string& shape = settings.text("shape");
  const ShapeChoice choice = shape == "box"         ? ShapeChoice::kBox
                             : shape == "primitive" ? ShapeChoice::kPrimitive
                                                    : ShapeChoice::kHull;
  const int workers = worker_count(settings.number("threads"));
  const auto not_numbers = std::make_shared<DefectCounter>(Defect::kCcdGjkNan);
  engine.narrow_phase = std::make_unique<CcdConvex>(settings.text("algorithm") == "mpr", choice, workers, not_numbers);
  engine.equivalence = [workers, shape](const core::Scene&) {
    core::EquivalenceCard card = ccd_card(workers);
    card.push_back({"shape margin", "none", ""});
    card.push_back({"iterations", std::to_string(kMostIterations) + " at most of GJK; EPA has no limit", ""});
    card.push_back({"tolerance", "1e-6 m, where EPA and MPR stop", "none"});
    card.push_back({"shape", shape, shape == "primitive" ? "" : "triangle surfaces"});
    return card;
  };
  engine.defects = defects_of(not_numbers);
  return engine;
}

}  // namespace

core::EngineRow ccd_row() {
  return {.id = kId,
          .capabilities = "narrow",
          .what = "libccd on the hulls or boxes of bodies: touching, depth and direction; no distance when apart",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
