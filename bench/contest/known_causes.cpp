#include "bench/contest/known_causes.hpp"

#include <array>

#include "bench/contest/blamed_law.hpp"

namespace broadside::bench::contest {
namespace {

struct Row : BlamedLaw {
  std::string_view cause;
};

constexpr std::string_view kDiscrete =
    "detection at steps alone, as the library ships: a fast body passes between two steps";
constexpr std::string_view kNoGyroscopic = "the gyroscopic torque is left out, as the library ships";
constexpr std::string_view kFewIterations = "ten iterations do not balance five books: with 500 they stand";
constexpr std::string_view kBulletPoints =
    "a box on a plane gets one more contact point each step, so it tips at first";
constexpr std::string_view kBulletEarly =
    "contacts push before bodies touch, and the speed that remains gets no restitution";
constexpr std::string_view kOneCorner =
    "an edge first gets one contact point, at a corner, which spins the rod about its axis";
constexpr std::string_view kTwoCorners =
    "the two corners of an edge are solved one after another, which spins the rod about its axis";
constexpr std::string_view kBulletRebound = "the correction of depth is added to the rebound (findings/head_on.toml)";
constexpr std::string_view kPyramid = "friction is a pyramid along two directions of the world, as declared";
constexpr std::string_view kExpMap = "rotations below 0.001 rad use a truncated series (findings/dart_small_turn.toml)";
constexpr std::string_view kFclMeshes =
    "FCL on meshes: balls are polyhedra; boxes get horizontal normals and points far away";
constexpr std::string_view kNoRestitution = "contacts are springs without a coefficient of restitution, as declared";
constexpr std::string_view kCreep = "sticking bodies creep: friction is regularized, as declared";
constexpr std::string_view kSinks = "a contact's spring must be compressed before it carries or gives friction";
constexpr std::string_view kMujocoArch =
    "springs give way by more than the spare millimeter, and as shipped a pair of convex meshes has one point: tuned, "
    "an arch of seven stands at 1.1 times the least thickness, with MuJoCo 3.14 at 1.3 times";
constexpr std::string_view kTwoStepsAtOwn =
    "springs with a time constant of two steps, the least at 1/60 s, let twenty cubes fall: at 1/240 s they stand";
constexpr std::string_view kConvexCone = "friction solved as a convex problem throws up fast sliding bodies";
constexpr std::string_view kMujocoBoxes =
    "boxes get half the true depth, and points far away (findings/mujoco_half_depth.toml, mujoco_far_point.toml)";
constexpr std::string_view kMujocoNewton = "Newton's iteration stops before accelerations and forces balance";
constexpr std::string_view kCannonFriction =
    "friction impulses are bounded by a force, which is 1 / h times too large (findings/cannon_friction.toml)";
constexpr std::string_view kDampedSprings = "contacts are damped springs, as declared";
constexpr std::string_view kKept =
    "manifolds are kept over steps: points and normals lag behind bodies that slide or turn";
constexpr std::string_view kRapierThree =
    "contacts push before bodies touch, so three balls end with more energy than they began with "
    "(findings/three_balls.toml): with a prediction distance of zero they do not";
constexpr std::string_view kDantzigRow = "a row of balls gets no impulses (findings/cradle.toml)";
constexpr std::string_view kLastSweep = "the solver bounds friction by normal impulses that it changes afterwards";

constexpr std::string_view kFallsFlat =
    "it falls flat, by more than its thickness of 2 cm in a step: at 1/960 s it does not sink";
constexpr std::string_view kMujocoImpact = "springs: in an impact a body sinks in by its speed times 0.02 s";
constexpr std::string_view kOdeFar = "in single steps box against box gives a point outside the box";
constexpr std::string_view kOdeLcp =
    "dWorldStep reports LCP internal errors in many steps, and goes on with impulses that are no solution";
constexpr std::string_view kTentOfDantzig =
    "the bound of friction is set before friction acts, but only friction presses the cards of a tent together";
constexpr std::string_view kOwnPoints = "a contact has a point on each body, and the two are apart by the depth";
constexpr std::string_view kJoltBooks = "ten velocity iterations do not balance five books: with 200 they stand";
constexpr std::string_view kPhysxBooks =
    "four position iterations and one of velocity do not balance five books: with 50 of each they stand";
constexpr std::string_view kShippedSimbody = "Simbody's accuracy as shipped is too low; at 1e-8 the law holds";

constexpr std::string_view kMassRatio =
    "its iterations do not carry a mass ratio of 1,000: with more of them, or at 1/240 s, it creeps less";
constexpr std::string_view kJoltRatio =
    "ten velocity iterations do not carry a mass ratio of 1,000: with 1,000 of them the cubes stand";
constexpr std::string_view kBulletArch =
    "friction along the slip alone, as the library ships: with two directions and 500 iterations an arch 1.1 times as "
    "thick (25 stones: 1.3) stands, but no thinner one, as normals of hulls that just touch differ from the joint's";
constexpr std::string_view kOdeOnePoint =
    "two convex bodies have one contact point, which jumps along their joint from step to step: an arch of 1.3 times "
    "the least thickness falls too";
constexpr std::string_view kOdeTent =
    "two convex bodies have one contact point, at either end of the cards' edge: it twists the cards, which uses up "
    "friction";
constexpr std::string_view kRapierTouch =
    "hulls that touch exactly get a normal that lies in the face: with stones 10 um apart at the start, an arch of "
    "seven, a tenth thicker, stands";
constexpr std::string_view kPhysxArch =
    "one velocity iteration leaves some speed: with 50, at 1/960 s, an arch of seven stands";
constexpr std::string_view kPhysxLongArch =
    "one velocity iteration leaves some speed, and a manifold keeps four points: 25 stones of 1.3 times the least "
    "thickness stand with 50 iterations and without PCM, and fall with only one of the two changes";
constexpr std::string_view kJoltArch = "ten velocity iterations are too few: with 200 the stones stand";
constexpr std::string_view kJoltLongArch =
    "ten velocity iterations are too few: with 1,000, and no penetration allowed (instead of 0.02 m), the stones stand";
constexpr std::string_view kPredicted =
    "contacts push before bodies touch: with a prediction distance of zero the law holds";
constexpr std::string_view kEtgsRebound =
    "eTGS loses a rebound, depending on where in a step bodies touch (findings/no_rebound.toml)";
constexpr std::string_view kForeseenSlip =
    "elliptic cones oppose slip and acceleration together, so friction at single points is not opposite to their "
    "slip: half as far off with a contact time constant of 10 ms instead of 20";
constexpr std::string_view kFadingSlip =
    "slip within the cone decays at a set rate, the contacts' time constant, by an impulse that inertia turns away "
    "from the slip's direction";
constexpr std::string_view kDepthToSpeed =
    "the correction of depth leaves speed behind: one velocity iteration is too few (findings/depth_to_speed.toml)";
constexpr std::string_view kPhysxRebound =
    "four iterations do not spread the rebound over a pile: without restitution it sinks 0.1 m and gains no energy";
constexpr std::string_view kJoltWarm =
    "ten iterations do not undo the impulses of warm starting: with 200, or without warm starting, the law holds";
constexpr std::string_view kJoltEdge =
    "where an edge touches the slab, for one step the normal is along the slab and the depth 5 m "
    "(findings/jolt_normal.toml)";

constexpr std::string_view kStackAtStep = "five cubes creep at 1/60 s; at 1/240 s they stand";
constexpr std::string_view kTallStack =
    "twenty cubes shear apart at 1/60 s: with ten to fifty times the iterations, or at 1/240 s, more slowly";
constexpr std::string_view kTallCreep = "twenty cubes creep at 1/60 s, and as much with 200 iterations or at 1/240 s";

constexpr std::array kRows{
    Row{"", "penetration", "rigid:two-spheres:fast", kDiscrete},
    Row{"", "closed-form", "rigid:two-spheres:fast", kDiscrete},
    Row{"", "penetration", "rigid:needle-through-plate", kDiscrete},
    Row{"", "passage", "rigid:", kDiscrete},
    Row{"", "closed-form", "rigid:needle-through-plate", kDiscrete},
    Row{"bullet-world", "closed-form", "rigid:bounce", kBulletEarly},
    Row{"bullet-world", "closed-form", "rigid:sphere:oblique", kBulletEarly},
    Row{"bullet-world", "closed-form", "rigid:rod:end-impact", kOneCorner},
    Row{"bullet-world", "energy-growth", "rigid:billiards:", kBulletRebound},
    Row{"bullet-world", "closed-form", "rigid:billiards:", kBulletRebound},
    Row{"bullet-world", "closed-form", "rigid:slide:", kBulletPoints},
    Row{"bullet-world", "rest", "rigid:tip:", kBulletPoints},
    Row{"bullet-world", "closed-form", "rigid:tip:push-slides", kBulletPoints},
    Row{"bullet-world", "rest", "rigid:overhang:", kFewIterations},
    Row{"bullet-world", "penetration", "rigid:painleve:", kFallsFlat},
    Row{"bullet-world", "rest", "rigid:card-tent:stands",
        "friction along the slip alone, as the library ships: with two directions and 500 iterations it stands"},
    Row{"bullet-world", "rest", "rigid:stack:1000-on-1", kMassRatio},
    Row{"bullet-world", "penetration", "rigid:stack:1000-on-1", kMassRatio},
    Row{"bullet-world", "rest", "rigid:arch:", kBulletArch},
    Row{"bullet-world", "rest", "rigid:stack:5",
        "friction along the slip alone and ten iterations, as the library ships: with two directions and 500 they stand"},
    Row{"bullet-world", "rest", "rigid:stack:20", kTallStack},
    Row{"bullet-world", "friction-cone", "", "friction is not updated in sweeps where the normal impulse is zero"},
    Row{"bullet-world", "contact-truth", "", "points are kept over steps, with their old normal"},
    Row{"bullet-world", "angular-momentum", "", "a contact has a point on each body, and the two slide apart"},
    Row{"ode-world[solver=dantzig", "penetration", "rigid:billiards:cradle", kDantzigRow},
    Row{"ode-world[solver=dantzig", "penetration", "rigid:painleve:", kFallsFlat},
    Row{"ode-world[solver=dantzig", "rest", "rigid:card-tent:", kTentOfDantzig},
    Row{"ode-world[solver=dantzig", "rest", "rigid:overhang:", kOdeLcp},
    Row{"ode-world[solver=dantzig", "penetration", "rigid:overhang:", kOdeLcp},
    Row{"ode-world[solver=dantzig", "energy-growth", "rigid:overhang:", kOdeLcp},
    Row{"ode-world", "rest", "rigid:card-tent:", kOdeTent},
    Row{"ode-world", "rest", "rigid:overhang:",
        "twenty iterations are too few at 1/240 s: with 500, the surface layer and 1/960 s the books stand"},
    Row{"ode-world", "rest", "rigid:tip:incline-stands", "twenty iterations are too few: with 500 the box stands"},
    Row{"ode-world[tuning=recommended", "penetration", "rigid:painleve:", kFallsFlat},
    Row{"ode-world", "rest", "rigid:stack:1000-on-1", kMassRatio},
    Row{"ode-world", "penetration", "rigid:stack:1000-on-1", kMassRatio},
    Row{"ode-world", "rest", "rigid:arch:", kOdeOnePoint},
    Row{"ode-world[solver=dantzig", "rest", "rigid:stack:5", kStackAtStep},
    Row{"ode-world", "rest", "rigid:stack:5",
        "five cubes creep at 1/60 s, with 500 iterations too; six times less at 1/240 s"},
    Row{"ode-world[solver=dantzig", "rest", "rigid:stack:20", kOdeLcp},
    Row{"ode-world[solver=dantzig", "penetration", "rigid:stack:20", kOdeLcp},
    Row{"ode-world", "rest", "rigid:stack:20", kTallStack},
    Row{"ode-world", "friction-cone", "", kLastSweep},
    Row{"ode-world", "closed-form", "rigid:slide:", kPyramid},
    Row{"ode-world", "rest", "rigid:tip:push-stands", "twenty iterations are too few: with 500 the box stands"},
    Row{"ode-world", "energy-growth", "rigid:rod:end-impact",
        "rounding of a thin rod's inverse inertia, which the law does not allow for"},
    Row{"ode-world", "contact-truth", "", kOdeFar},
    Row{"dart-world", "friction-cone", "", kLastSweep},
    Row{"dart-world", "closed-form", "rigid:slide:", kPyramid},
    Row{"dart-world", "ballistic", "", kExpMap},
    Row{"dart-world", "turning", "", kExpMap},
    Row{"dart-world", "momentum", "", kExpMap},
    Row{"dart-world", "energy-growth", "", kExpMap},
    Row{"dart-world", "gyroscopic", "", kExpMap},
    Row{"dart-world", "angular-momentum", "", kExpMap},
    Row{"dart-world", "contact-truth", "", kFclMeshes},
    Row{"dart-world", "closed-form", "rigid:sphere:", kFclMeshes},
    Row{"dart-world", "closed-form", "rigid:billiards:", kFclMeshes},
    Row{"dart-world", "penetration", "rigid:painleve:", kFallsFlat},
    Row{"dart-world", "closed-form", "rigid:tip:push-slides", kFclMeshes},
    Row{"dart-world", "rest", "rigid:stack:", kFclMeshes},
    Row{"dart-world", "rest", "rigid:overhang:", kFclMeshes},
    Row{"dart-world", "penetration", "rigid:overhang:", kFclMeshes},
    Row{"mujoco", "closed-form", "rigid:bounce", kNoRestitution},
    Row{"mujoco", "closed-form", "rigid:billiards:", kNoRestitution},
    Row{"mujoco", "closed-form", "rigid:rod:", kNoRestitution},
    Row{"mujoco", "closed-form", "rigid:sphere:oblique", kNoRestitution},
    Row{"mujoco", "closed-form", "rigid:sphere:slip-to-roll", kSinks},
    Row{"mujoco-world[tuning", "closed-form", "rigid:slide:", kConvexCone},
    Row{"mujoco3[tuning", "closed-form", "rigid:slide:", kConvexCone},
    // Along the pyramid's own directions.
    Row{"mujoco", "closed-form", "rigid:slide:heading-0", kConvexCone},
    Row{"mujoco", "closed-form", "rigid:slide:heading-4", kConvexCone},
    Row{"mujoco", "closed-form", "rigid:slide:heading-8", kConvexCone},
    Row{"mujoco", "closed-form", "rigid:slide:heading-12", kConvexCone},
    Row{"mujoco", "closed-form", "rigid:slide:", "friction pyramids lie inside the cone, as the library ships"},
    Row{"mujoco", "rest", "rigid:arch:", kMujocoArch},
    Row{"mujoco3", "rest", "rigid:stack:20", kTwoStepsAtOwn},
    Row{"mujoco-world[tuning", "rest", "rigid:stack:20",
        "springs with a time constant of two steps, the least at 1/60 s, yield by 0.1 m in all, and the column "
        "buckles, twice as far every second: at 1/240 s it stands"},
    Row{"mujoco", "rest", "", kCreep},
    Row{"mujoco-world", "contact-truth", "", kMujocoBoxes},
    Row{"mujoco-world[tuning", "friction-cone", "rigid:slide:", kForeseenSlip},
    Row{"mujoco-world[tuning", "friction-cone", "rigid:disk:", kForeseenSlip},
    Row{"mujoco-world[tuning", "friction-cone", "", kFadingSlip},
    Row{"mujoco-world", "friction-cone", "", "friction goes along the edges of pyramids, as the library ships"},
    Row{"mujoco", "penetration", "rigid:ladder", kMujocoImpact},
    Row{"mujoco", "penetration", "rigid:painleve:", kMujocoImpact},
    Row{"mujoco-world", "penetration",
        "rigid:arch:", "one point per pair of convex meshes, as it ships: with several (multiccd) stones sink less"},
    Row{"mujoco", "momentum", "", kMujocoNewton},
    Row{"mujoco", "angular-momentum", "", kMujocoNewton},
    Row{"simbody-world", "closed-form", "rigid:bounce", "damping takes the place of restitution, equal to first order"},
    Row{"simbody-world", "closed-form", "rigid:billiards:", "springs: an impact takes a few steps"},
    Row{"simbody-world", "closed-form", "rigid:sphere:slip-to-roll", kSinks},
    Row{"simbody-world", "rest", "rigid:tip:", "springs tilt a tall box by more than the scene's 1 %"},
    Row{"simbody-world[tuning=shipped", "closed-form", "rigid:rod:end-impact", kShippedSimbody},
    Row{"simbody-world[tuning=shipped", "closed-form", "rigid:tip:push-slides",
        "friction fades at slips below 1 cm/s, as Simbody ships; with 1 mm/s the law holds"},
    Row{"jolt", "contact-truth", "rigid:tip:incline", kJoltEdge},
    Row{"jolt", "energy-growth", "rigid:tip:incline", kJoltEdge},
    Row{"jolt", "contact-truth", "rigid:arch:25",
        "for one step the normal is along faces, so that stones are 0.2 m deep (findings/jolt_normal.toml is similar)"},
    Row{"jolt", "energy-growth", "rigid:arch:25", kJoltWarm},
    Row{"jolt", "energy-growth", "freefall:", kJoltWarm},
    Row{"jolt", "contact-truth", "freefall:", "for one step the normal is along faces, so that bodies are deep"},
    Row{"jolt", "rest", "rigid:overhang:", kJoltBooks},
    Row{"jolt", "penetration", "rigid:disk:euler", "bodies may sink 0.02 m (mPenetrationSlop): half of this coin"},
    Row{"jolt", "rest", "rigid:arch:7", kJoltArch},
    Row{"jolt", "rest", "rigid:stack:20",
        "ten velocity iterations are too few for twenty cubes at 1/60 s: with 3,000 they stand"},
    Row{"jolt", "rest", "rigid:stack:1000-on-1", kJoltRatio},
    Row{"jolt", "penetration", "rigid:stack:1000-on-1", kJoltRatio},
    Row{"jolt", "rest", "rigid:arch:25", kJoltLongArch},
    Row{"jolt", "gyroscopic", "", kNoGyroscopic},
    Row{"jolt", "closed-form", "rigid:torque-free:", kNoGyroscopic},
    Row{"physx", "rest", "rigid:incline:stick",
        "a body within 1 % of sliding creeps: a quarter as fast with 50 iterations of both kinds, a third with eTGS"},
    Row{"physx", "rest", "rigid:card-tent:stands",
        "a body within 1 % of sliding creeps: with 50 iterations of both kinds it stands"},
    Row{"physx", "closed-form", "rigid:card-tent:falls",
        "the tent creeps by 1.7 cm in 3 s and does not slip; with eTGS it falls"},
    Row{"physx", "rest", "rigid:overhang:", kPhysxBooks},
    Row{"physx", "contact-truth", "", kKept},
    Row{"physx", "rest", "rigid:arch:7", kPhysxArch},
    Row{"physx[tuning", "closed-form", "rigid:sphere:oblique", kEtgsRebound},
    Row{"physx[tuning", "closed-form", "rigid:bounce", kEtgsRebound},
    Row{"physx[tuning", "closed-form", "rigid:rod:", kEtgsRebound},
    Row{"physx[tuning", "closed-form", "rigid:billiards:", kEtgsRebound},
    Row{"physx[tuning", "state-sanity", "",
        "quaternions are up to 4 % further from unit length than float32 rounding explains"},
    Row{"physx[tuning", "energy-growth", "", kDepthToSpeed},
    Row{"physx", "energy-growth", "freefall:", kPhysxRebound},
    Row{"physx", "penetration", "freefall:", kPhysxRebound},
    Row{"physx", "rest", "rigid:stack:5",
        "four position iterations and one of velocity are too few at 1/60 s: with 50 of each they stand"},
    Row{"physx", "rest", "rigid:stack:20", kTallStack},
    Row{"physx", "rest", "rigid:stack:1000-on-1", kMassRatio},
    Row{"physx", "penetration", "rigid:stack:1000-on-1", kMassRatio},
    Row{"physx", "rest", "rigid:arch:25", kPhysxLongArch},
    Row{"physx", "gyroscopic", "", kNoGyroscopic},
    Row{"physx", "closed-form", "rigid:torque-free:", kNoGyroscopic},
    Row{"cannon", "gyroscopic", "", kNoGyroscopic},
    Row{"cannon", "closed-form", "rigid:torque-free:", kNoGyroscopic},
    Row{"cannon", "rest", "rigid:stack:1000-on-1", kMassRatio},
    Row{"cannon", "penetration", "rigid:stack:1000-on-1", kMassRatio},
    Row{"cannon", "rest", "rigid:stack:5", "five cubes creep: ten times less with 50 or 500 iterations"},
    Row{"cannon", "rest", "rigid:stack:20",
        "twenty cubes shear apart at 1/60 s with 50 iterations; at 1/240 s they creep, by 1 cm/s"},
    Row{"cannon", "rest", "rigid:arch:7", "ten to fifty iterations are too few: with 500 the stones stand"},
    Row{"cannon", "rest", "rigid:arch:25",
        "ten to fifty iterations are too few: an arch of seven stands with 500, one of 25 falls with 500 too"},
    Row{"cannon", "angular-momentum", "", kOwnPoints},
    Row{"cannon", "penetration", "rigid:painleve:", kFallsFlat},
    Row{"cannon", "friction-cone", "", kCannonFriction},
    Row{"cannon", "closed-form", "rigid:slide:", kCannonFriction},
    Row{"cannon", "closed-form", "rigid:incline:slide", kCannonFriction},
    Row{"cannon", "closed-form", "rigid:sphere:", kCannonFriction},
    Row{"cannon", "closed-form", "rigid:tip:push-slides", kCannonFriction},
    Row{"cannon", "rest", "rigid:overhang:", kFewIterations},
    Row{"cannon", "closed-form", "rigid:card-tent:falls", kCannonFriction},
    Row{"cannon", "closed-form", "rigid:bounce", kDampedSprings},
    Row{"cannon", "closed-form", "rigid:billiards:", kDampedSprings},
    Row{"rapier", "contact-truth", "rigid:arch:", kRapierTouch},
    Row{"rapier", "contact-truth", "", kKept},
    Row{"rapier", "momentum", "freefall:",
        "a cube is stopped by one that it never reaches: contacts push before bodies touch, millimeters apart here"},
    Row{"rapier", "rest", "rigid:card-tent:", "four iterations are too few: with 200 the tent stands"},
    Row{"rapier", "rest",
        "rigid:overhang:", "four iterations at 1/240 s are too few: with 200 at 1/960 s the books stand"},
    Row{"rapier", "energy-growth",
        "rigid:tip:", "four iterations are too few when it slams down flat: with 200 no energy is gained"},
    Row{"rapier", "closed-form", "rigid:billiards:off-center", kPredicted},
    Row{"rapier", "rest", "rigid:stack:1000-on-1", kMassRatio},
    Row{"rapier", "rest", "rigid:stack:20", kTallCreep},
    Row{"rapier", "rest", "rigid:arch:", kRapierTouch},
    Row{"rapier", "closed-form", "rigid:rod:end-impact", kTwoCorners},
    Row{"rapier", "energy-growth", "rigid:billiards:three", kRapierThree},
    Row{"rapier", "closed-form", "rigid:billiards:three", kRapierThree},
};

}  // namespace

std::string_view known_cause(std::string_view engine, std::string_view law, std::string_view scene) {
  if (const std::string_view cause = known_cause_at_step(engine, law, scene); !cause.empty()) return cause;
  for (const Row& row : kRows)
    if (row.covers(engine, law, scene)) return row.cause;
  return {};
}

}  // namespace broadside::bench::contest
