#include "bench/contest/known_causes.hpp"

#include <array>

#include "bench/contest/blamed_law.hpp"

namespace broadside::bench::contest {
namespace {

struct Row : BlamedLaw {
  std::string_view cause;
};

constexpr std::string_view kDiscrete =
    "detection at steps alone, as the library ships: what is fast passes between two";
constexpr std::string_view kNoGyroscopic = "the gyroscopic torque is left out, as the library ships";
constexpr std::string_view kFewIterations = "ten iterations do not balance five books: with 500 they stand";
constexpr std::string_view kBulletPoints = "a box gets one more point against a plane each step, so it tips first";
constexpr std::string_view kBulletEarly =
    "contacts push before bodies touch, and what is left of the speed has no restitution";
constexpr std::string_view kOneCorner =
    "an edge gets one corner as its point first, which spins the rod about its axis";
constexpr std::string_view kTwoCorners =
    "the two corners of an edge are solved one after another, which spins the rod about its axis";
constexpr std::string_view kBulletRebound = "the correction of depth is added to the rebound (findings/head_on.toml)";
constexpr std::string_view kPyramid = "friction is a pyramid along two directions of the world, as declared";
constexpr std::string_view kExpMap = "rotations below 0.001 rad are a series cut short (findings/dart_small_turn.toml)";
constexpr std::string_view kFclMeshes =
    "FCL on meshes: polyhedra for balls, horizontal normals and far points between boxes";
constexpr std::string_view kNoRestitution = "contacts are springs without a coefficient of restitution, as declared";
constexpr std::string_view kCreep = "what sticks creeps: friction is regularized, as declared";
constexpr std::string_view kSinks = "a spring must be pressed in before it carries, and its friction with it";
constexpr std::string_view kMujocoArch =
    "springs give way by more than the millimeter to spare, and as it ships convex meshes have one point a pair: tuned, an "
    "arch of seven stands at 1.1 times the least thickness, in 3.14 at 1.3 times";
constexpr std::string_view kTwoStepsAtOwn =
    "springs of two steps a time constant, as 1/60 s asks for, let twenty cubes fall: at 1/240 s they stand";
constexpr std::string_view kConvexCone = "friction as a convex problem throws up what slides fast";
constexpr std::string_view kMujocoBoxes =
    "boxes: half the depth, and points far away (findings/mujoco_half_depth.toml, mujoco_far_point.toml)";
constexpr std::string_view kMujocoNewton = "Newton's iteration stops before accelerations and forces balance";
constexpr std::string_view kCannonFriction =
    "an impulse of friction is bounded by a force, 1 / h times too much (findings/cannon_friction.toml)";
constexpr std::string_view kDampedSprings = "contacts are springs that are damped, as declared";
constexpr std::string_view kKept = "manifolds are kept over steps: points and normals lag behind what slides or turns";
constexpr std::string_view kRapierThree =
    "contacts push before bodies touch, so three balls end with more energy than two brought "
    "(findings/three_balls.toml): with a prediction distance of zero they do not";
constexpr std::string_view kDantzigRow = "no impulses in a row of balls (findings/cradle.toml)";
constexpr std::string_view kLastSweep = "the solver bounds friction by normal impulses that it changes afterwards";

constexpr std::string_view kFallsFlat = "it falls flat by more than its 2 cm a step: at 1/960 s it does not sink";
constexpr std::string_view kMujocoImpact = "springs: an impact presses in by its speed times 0.02 s";
constexpr std::string_view kOdeFar = "box against box gives a point outside of the box for single steps";
constexpr std::string_view kOdeLcp =
    "dWorldStep reports LCP internal errors in many steps, and goes on with impulses that solve nothing";
constexpr std::string_view kTentOfDantzig =
    "friction is bounded before it acts, and cards of a tent press on each other by friction alone";
constexpr std::string_view kOwnPoints = "each body has a point of its own, and the two lie apart by the depth";
constexpr std::string_view kJoltBooks = "ten velocity iterations do not balance five books: with 200 they stand";
constexpr std::string_view kPhysxBooks =
    "four position iterations and one of velocity do not balance five books: with 50 of each they stand";
constexpr std::string_view kShippedSimbody = "the accuracy that Simbody ships; at 1e-8 it holds";

constexpr std::string_view kMassRatio =
    "its iterations do not carry a mass ratio of 1,000: with more of them, or at 1/240 s, it creeps less";
constexpr std::string_view kJoltRatio =
    "ten velocity iterations do not carry a mass ratio of 1,000: with 1,000 of them the cubes stand";
constexpr std::string_view kBulletArch =
    "friction along the slip alone, as the library ships: 1.1 times as thick (25 stones: 1.3) it stands with two directions "
    "and 500 iterations, thinner not, as normals lie beside the joint's where hulls just touch";
constexpr std::string_view kOdeOnePoint =
    "two convex bodies have one point, which jumps along their joint from step to step: an arch of 1.3 times the least "
    "thickness falls too";
constexpr std::string_view kOdeTent =
    "two convex bodies have one point, at one end of the cards' edge or the other: it twists them, which takes friction";
constexpr std::string_view kRapierTouch =
    "hulls that touch exactly get a normal that lies in the face: begun 10 um apart, an arch of seven a tenth thicker "
    "stands";
constexpr std::string_view kPhysxArch =
    "one velocity iteration leaves speed: with 50, at 1/960 s, an arch of seven stands";
constexpr std::string_view kPhysxLongArch =
    "one velocity iteration leaves speed, and a manifold keeps four points: 25 stones of 1.3 times the least thickness "
    "stand with 50 iterations and without PCM, and fall with either alone";
constexpr std::string_view kJoltArch = "ten velocity iterations are too few: with 200 the stones stand";
constexpr std::string_view kJoltLongArch =
    "ten velocity iterations are too few: with 1,000, and none of the 0.02 m that bodies may sink, the stones stand";
constexpr std::string_view kPredicted =
    "contacts push before bodies touch: with a prediction distance of zero it holds";
constexpr std::string_view kEtgsRebound =
    "eTGS loses a rebound, depending on where in a step bodies touch (findings/no_rebound.toml)";
constexpr std::string_view kForeseenSlip =
    "elliptic cones oppose slip and acceleration together, so single points push aside from their slip: half as far with "
    "a time constant of contacts of 10 ms instead of 20";
constexpr std::string_view kFadingSlip =
    "what slips within its cone loses its slip at a set rate, the contacts' time constant, by an impulse that inertia "
    "turns aside from it";
constexpr std::string_view kDepthToSpeed =
    "the correction of depth stays behind as speed: one velocity iteration is too few (findings/depth_to_speed.toml)";
constexpr std::string_view kPhysxRebound =
    "four iterations do not share out the rebound of a pile: without restitution it sinks 0.1 m and gains nothing";
constexpr std::string_view kJoltWarm =
    "ten iterations do not take back what warm starting put in: with 200, or without warm starting, it holds";
constexpr std::string_view kJoltEdge =
    "for a step the normal is along the slab, 5 m deep, where an edge touches it (findings/jolt_normal.toml)";

constexpr std::string_view kStackAtStep = "five cubes creep at 1/60 s; at 1/240 s they stand";
constexpr std::string_view kTallStack =
    "twenty cubes shear apart at 1/60 s: with ten to fifty times the iterations, or at 1/240 s, more slowly";
constexpr std::string_view kTallCreep = "twenty cubes creep at 1/60 s, by as much with 200 iterations and at 1/240 s";

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
    Row{"bullet-world", "friction-cone", "", "friction stays as it was in sweeps where the normal impulse is zero"},
    Row{"bullet-world", "contact-truth", "", "points are kept over steps, with the normal that they had"},
    Row{"bullet-world", "angular-momentum", "", "each body has a point of its own, and the two slide apart"},
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
        "rounding of a thin rod's inverse inertia, which the law does not count"},
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
    Row{"mujoco", "closed-form", "rigid:slide:", "pyramids inside the cone, as the library ships"},
    Row{"mujoco", "rest", "rigid:arch:", kMujocoArch},
    Row{"mujoco3", "rest", "rigid:stack:20", kTwoStepsAtOwn},
    Row{"mujoco-world[tuning", "rest", "rigid:stack:20",
        "springs of two steps a time constant, as 1/60 s asks for, give by 0.1 m in all and the column buckles, twice "
        "as far every second: at 1/240 s it stands"},
    Row{"mujoco", "rest", "", kCreep},
    Row{"mujoco-world", "contact-truth", "", kMujocoBoxes},
    Row{"mujoco-world[tuning", "friction-cone", "rigid:slide:", kForeseenSlip},
    Row{"mujoco-world[tuning", "friction-cone", "rigid:disk:", kForeseenSlip},
    Row{"mujoco-world[tuning", "friction-cone", "", kFadingSlip},
    Row{"mujoco-world", "friction-cone", "", "friction goes along the edges of pyramids, as the library ships"},
    Row{"mujoco", "penetration", "rigid:ladder", kMujocoImpact},
    Row{"mujoco", "penetration", "rigid:painleve:", kMujocoImpact},
    Row{"mujoco-world", "penetration", "rigid:arch:",
        "one point a pair of convex meshes, as it ships: with several (multiccd) stones do not sink as deep"},
    Row{"mujoco", "momentum", "", kMujocoNewton},
    Row{"mujoco", "angular-momentum", "", kMujocoNewton},
    Row{"simbody-world", "closed-form", "rigid:bounce", "a dissipation stands for restitution, to first order"},
    Row{"simbody-world", "closed-form", "rigid:billiards:", "springs: the exchange takes a few steps"},
    Row{"simbody-world", "closed-form", "rigid:sphere:slip-to-roll", kSinks},
    Row{"simbody-world", "rest", "rigid:tip:", "springs tilt a tall box by more than the scene's 1 %"},
    Row{"simbody-world[tuning=shipped", "closed-form", "rigid:rod:end-impact", kShippedSimbody},
    Row{"simbody-world[tuning=shipped", "closed-form", "rigid:tip:push-slides",
        "friction fades below the 1 cm/s of slip that Simbody ships; with 1 mm/s it holds"},
    Row{"jolt", "contact-truth", "rigid:tip:incline", kJoltEdge},
    Row{"jolt", "energy-growth", "rigid:tip:incline", kJoltEdge},
    Row{"jolt", "contact-truth", "rigid:arch:25",
        "for a step the normal is along faces that are 0.2 m deep there (findings/jolt_normal.toml shows another)"},
    Row{"jolt", "energy-growth", "rigid:arch:25", kJoltWarm},
    Row{"jolt", "energy-growth", "freefall:", kJoltWarm},
    Row{"jolt", "contact-truth", "freefall:", "for a step the normal is along faces that are deep there"},
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
        "what sticks within 1 % of its friction creeps: a quarter as fast with 50 iterations of both kinds, a third with eTGS"},
    Row{"physx", "rest", "rigid:card-tent:stands",
        "what sticks within 1 % of its friction creeps: with 50 iterations of both kinds it stands"},
    Row{"physx", "closed-form", "rigid:card-tent:falls",
        "it creeps by 1.7 cm in 3 s and does not let go; with eTGS it falls"},
    Row{"physx", "rest", "rigid:overhang:", kPhysxBooks},
    Row{"physx", "contact-truth", "", kKept},
    Row{"physx", "rest", "rigid:arch:7", kPhysxArch},
    Row{"physx[tuning", "closed-form", "rigid:sphere:oblique", kEtgsRebound},
    Row{"physx[tuning", "closed-form", "rigid:bounce", kEtgsRebound},
    Row{"physx[tuning", "closed-form", "rigid:rod:", kEtgsRebound},
    Row{"physx[tuning", "closed-form", "rigid:billiards:", kEtgsRebound},
    Row{"physx[tuning", "state-sanity", "",
        "quaternions are up to 4 % further from unit length than rounding of float32"},
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
        "rigid:tip:", "four iterations are too few as it slams flat: with 200 no energy is gained"},
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
