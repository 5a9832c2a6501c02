#include "reference/vendor_defects.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace broadside::reference {
namespace {

constexpr std::string_view kBullet = "Bullet 3.24";
constexpr std::string_view kFcl = "FCL 0.7.0";
constexpr std::string_view kCcd = "libccd 2.1";
constexpr std::string_view kOde = "ODE 0.16.2";
constexpr std::string_view kMujoco = "MuJoCo 2.2.2";

constexpr std::array<DefectRow, 13> kRows{{
    {Defect::kBulletStalePairs, kBullet, "none known",
     "the dbvt broad phase reports a pair whose boxes do not overlap (fat leaves, pairs kept after they parted)",
     "filtered on the given boxes; raw and tight pairs are counted apart"},
    {Defect::kBulletNearNormal, kBullet, "bullet3#889",
     "bodies less than 1 mm apart, no margin: GJK gives way to btGjkEpaSolver2::Distance, whose normal stays in A's "
     "frame",
     "passed on as it is, right where A is not turned; the distance is right, and a margin avoids it"},
    {Defect::kFclMeshDepth, kFcl, "fcl#221, fcl#491", "overlapping meshes get no penetration depth",
     "reported as distance 0, touching taken from collide"},
    {Defect::kFclBoxAxis, kFcl, "none known",
     "box against box is deeper by its answer than the least depth (a factor of 1.05 favors faces)",
     "counted as depth off, outside the touching band"},
    {Defect::kFclConvexNormal, kFcl, "fcl#545",
     "convex bodies are deeper by its answer than the least depth, along another direction",
     "counted as depth off, outside the touching band"},
    {Defect::kFclAbort, kFcl, "fcl#322, fcl#578", "a query ends the process by a failed assertion",
     "queries run in a process of their own, which starts again after the pair"},
    {Defect::kFclThrow, kFcl, "fcl#319, fcl#415", "a query throws std::logic_error about a degenerate polytope",
     "caught, counted as exception"},
    {Defect::kFclHang, kFcl, "fcl#578, fcl#346", "a query does not return (round bodies with one center; others)",
     "ended after a time limit"},
    {Defect::kCcdGjkNan, kCcd, "libccd#25, libccd#68", "GJK's depth or direction is not a number where bodies overlap",
     "reported as touching with depth 0 and no normal"},
    {Defect::kCcdMprDepth, kCcd, "libccd#71", "MPR's depth, along the line of centers, is more than the least depth",
     "an upper bound of the depth"},
    {Defect::kCcdEpaHang, kCcd, "libccd#7, fcl#346",
     "EPA does not return for round bodies that overlap deeply: it refines a whole ball", "ended after a time limit"},
    {Defect::kOdeLcp, kOde, "none known",
     "a step of Dantzig's solver reports an LCP internal error and goes on with impulses that solve nothing",
     "counted by step; the trace shows what became of the bodies"},
    {Defect::kMujocoBoxDepth, kMujoco, "mujoco#3476",
     "two boxes have a contact that is deeper than they overlap along its own normal",
     "passed on: the step pushes with it, and a resting stack may explode"},
}};

}  // namespace

std::span<const DefectRow> vendor_defects() {
  return kRows;
}

const DefectRow& row_of(Defect defect) {
  return *std::find_if(kRows.begin(), kRows.end(), [&](const DefectRow& row) { return row.defect == defect; });
}

core::DefectHits DefectCounter::hits() const {
  const DefectRow& row = row_of(defect_);
  return {std::string(row.library), std::string(row.upstream), std::string(row.predicate), hits_, asked_};
}

}  // namespace broadside::reference
