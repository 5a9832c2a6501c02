// Jolt Physics under Node: `jolt` in the list of engines.
//
// What is set: no damping, since scenes have none (the library's default is 0.05/s); speeds without the default caps of
// 500 m/s and 47 rad/s; convex radius 0, so that corners are as the scene draws them; no sleeping; bounces above the
// scene's threshold (the library's is 1 m/s). The rest is the library's default, the gyroscopic torque (off) too, which
// is a setting. Jolt combines friction by the geometric mean and restitution by the maximum, as scenes do. Listeners are
// told of points before they are solved, and never of impulses, so contacts are declared as geometry. Telling them is
// inside the step's time.
import initJolt from "jolt-physics";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { FIRST_FACE, serve } from "../../../core/plugin/clients/broadside_engine.mjs";
import { add, dot, facesOf, frictionOf, pointOf, refuse, scaled, sub, wrenchesOf } from "../rigid_bodies.mjs";

// What the library prints goes to standard error: standard output carries the protocol.
const Jolt = await initJolt({ print: console.error, printErr: console.error });
const version = JSON.parse(readFileSync(createRequire(import.meta.url).resolve("jolt-physics/package.json"))).version;
const SHAPES = { box: "moving", sphere: "moving", capsule: "moving", cylinder: "moving", convex: "moving", mesh: "static" };
const STATIC = 0, MOVING = 1;
// Capsules and cylinders lie along y there; this turns y into the axis.
const AXIS = [[Math.SQRT1_2, 0, 0, -Math.SQRT1_2], [1, 0, 0, 0], [Math.SQRT1_2, Math.SQRT1_2, 0, 0]];

const vec3 = ([x, y, z]) => new Jolt.Vec3(x, y, z);
const rvec3 = ([x, y, z]) => new Jolt.RVec3(x, y, z);
const quat = ([w, x, y, z]) => new Jolt.Quat(x, y, z, w);
const list = (v) => [v.GetX(), v.GetY(), v.GetZ()];

let hasGyroscopic = false, isTuned = false;
let scene, jolt, bodies, bodyInterface;
let points = [], ids = new Map();  // of bodies and faces, by Jolt's number
// The binding reserves room for all contacts of a step in temporary memory of a fixed size: the library's own number fits.
const MOST_MANIFOLDS = 10240;
let manifolds = 0, mostManifolds = 0;

const numberOf = (body) => body.GetID().GetIndexAndSequenceNumber();

// A manifold's normal points from body 1 to body 2.
function note(body1, body2, manifold) {
  ++manifolds;
  const [one, two] = [body1, body2].map((pointer) => ids.get(numberOf(Jolt.wrapPointer(pointer, Jolt.Body))));
  const m = Jolt.wrapPointer(manifold, Jolt.ContactManifold), n = list(m.mWorldSpaceNormal);
  for (let k = 0; k < m.mRelativeContactPointsOn1.size(); ++k) {
    const p = list(m.GetWorldSpaceContactPointOn1(k)), q = list(m.GetWorldSpaceContactPointOn2(k));
    points.push(pointOf(one, two, { point: scaled(0.5, add(p, q)), normal: scaled(-1, n), gap: dot(sub(q, p), n) }));
  }
}

const listener = new Jolt.ContactListenerJS();
listener.OnContactValidate = () => Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
listener.OnContactAdded = listener.OnContactPersisted = note;
listener.OnContactRemoved = () => {};

function made(settings) {
  const result = settings.Create();
  if (result.HasError()) throw new Error(`Jolt refused a shape: ${result.GetError().c_str()}`);
  const shape = result.Get();
  shape.AddRef();  // the result that holds it is used again for the next shape
  return shape;
}

const along = (settings, axis) => axis === 1 ? settings : new Jolt.RotatedTranslatedShapeSettings(new Jolt.Vec3(0, 0, 0), quat(AXIS[axis]), settings);

function settingsOf(shape, mesh) {
  const point = (k) => mesh.vertices.slice(3 * k, 3 * k + 3);
  switch (shape.kind) {
    case "box": return new Jolt.BoxShapeSettings(vec3(shape.half_extents), 0);
    case "sphere": return new Jolt.SphereShapeSettings(shape.radius);
    case "capsule": return along(new Jolt.CapsuleShapeSettings(shape.half_length, shape.radius), shape.axis);
    case "cylinder": return along(new Jolt.CylinderShapeSettings(shape.half_length, shape.radius, 0), shape.axis);
    case "convex": {
      const settings = new Jolt.ConvexHullShapeSettings();
      settings.mMaxConvexRadius = 0;
      for (let k = 0; k < mesh.vertices.length / 3; ++k) settings.mPoints.push_back(vec3(point(k)));
      return settings;
    }
    default: {
      const triangles = new Jolt.TriangleList();
      triangles.resize(mesh.triangles.length / 3);
      for (let t = 0; t < mesh.triangles.length / 3; ++t)
        for (let k = 0; k < 3; ++k) {
          const [x, y, z] = point(mesh.triangles[3 * t + k]), corner = triangles.at(t).get_mV(k);
          corner.x = x, corner.y = y, corner.z = z;
        }
      return new Jolt.MeshShapeSettings(triangles);
    }
  }
}

function worldFor(count) {
  const settings = new Jolt.JoltSettings();
  settings.mMaxBodies = count + 16;
  settings.mMaxBodyPairs = Math.max(1024, 32 * count);
  settings.mMaxContactConstraints = mostManifolds = Math.min(MOST_MANIFOLDS, Math.max(1024, 32 * count));
  const pairs = new Jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(STATIC, MOVING), pairs.EnableCollision(MOVING, MOVING);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
  layers.MapObjectToBroadPhaseLayer(STATIC, new Jolt.BroadPhaseLayer(0));
  layers.MapObjectToBroadPhaseLayer(MOVING, new Jolt.BroadPhaseLayer(1));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
  return new Jolt.JoltInterface(settings);
}

function inertiaOf([xx, yy, zz, xy, xz, yz]) {
  const matrix = Jolt.Mat44.prototype.sIdentity();
  const columns = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
  columns.forEach((column, k) => matrix.SetColumn4(k, new Jolt.Vec4(...column, 0)));
  return matrix;
}

function bodyOf(b) {
  const drawn = settingsOf(scene.shapes[b.mesh], scene.meshes[b.mesh]);
  let shape = made(drawn);
  const offset = sub(b.center_of_mass, list(shape.GetCenterOfMass()));
  if (!b.is_static && offset.some((x) => x !== 0)) shape = made(new Jolt.OffsetCenterOfMassShapeSettings(vec3(offset), drawn));
  const settings = new Jolt.BodyCreationSettings(shape, rvec3(b.position), quat(b.orientation),
    b.is_static ? Jolt.EMotionType_Static : Jolt.EMotionType_Dynamic, b.is_static ? STATIC : MOVING);
  settings.mFriction = frictionOf(b), settings.mRestitution = b.restitution;
  if (!b.is_static) {
    settings.mLinearVelocity = vec3(b.velocity), settings.mAngularVelocity = vec3(b.angular_velocity);
    settings.mLinearDamping = settings.mAngularDamping = 0;
    settings.mMaxLinearVelocity = settings.mMaxAngularVelocity = 1e6;
    settings.mAllowSleeping = false;
    settings.mApplyGyroscopicForce = hasGyroscopic;
    if (!scene.turns) settings.mAllowedDOFs = Jolt.EAllowedDOFs_TranslationX | Jolt.EAllowedDOFs_TranslationY | Jolt.EAllowedDOFs_TranslationZ;
    settings.mOverrideMassProperties = Jolt.EOverrideMassProperties_MassAndInertiaProvided;
    const mass = new Jolt.MassProperties();
    mass.mMass = b.mass, mass.mInertia = inertiaOf(scene.turns ? b.inertia : [1, 1, 1, 0, 0, 0]);
    settings.mMassPropertiesOverride = mass;
  }
  const body = bodyInterface.CreateBody(settings);
  bodyInterface.AddBody(body.GetID(), b.is_static ? Jolt.EActivation_DontActivate : Jolt.EActivation_Activate);
  return body;
}

function begin(given) {
  scene = given;
  refuse(scene, { shapes: SHAPES, library: "Jolt" });
  if (jolt) Jolt.destroy(jolt);
  jolt = worldFor(scene.bodies.length + 6);
  const system = jolt.GetPhysicsSystem();
  system.SetGravity(vec3(scene.gravity));
  const physics = system.GetPhysicsSettings();
  physics.mMinVelocityForRestitution = scene.v_threshold;
  system.SetPhysicsSettings(physics);
  bodyInterface = system.GetBodyInterface();
  system.SetContactListener(listener);
  points = [], bodies = scene.bodies.map(bodyOf);
  ids = new Map(bodies.map((body, k) => [numberOf(body), k]));
  const extent = Math.max(...sub(scene.domain_max, scene.domain_min)) * 2 + 1;
  for (const { face, normal, point } of facesOf(scene)) {
    const plane = new Jolt.Plane(vec3(normal), 0);
    const settings = new Jolt.BodyCreationSettings(made(new Jolt.PlaneShapeSettings(plane, null, extent)), rvec3(point), quat([1, 0, 0, 0]), Jolt.EMotionType_Static, STATIC);
    settings.mFriction = scene.face_mu_kinetic, settings.mRestitution = scene.face_restitution;
    const wall = bodyInterface.CreateBody(settings);
    ids.set(numberOf(wall), FIRST_FACE + face);
    bodyInterface.AddBody(wall.GetID(), Jolt.EActivation_DontActivate);
  }
  system.OptimizeBroadPhase();
}

const orientationOf = (body) => { const q = body.GetRotation(); return [q.GetW(), q.GetX(), q.GetY(), q.GetZ()]; };

function step(h) {
  for (const { body: k } of scene.wrenches) {
    const { force, torque } = wrenchesOf(scene, k, orientationOf(bodies[k]));
    bodies[k].AddForce(vec3(force)), bodies[k].AddTorque(vec3(torque));
  }
  points = [], manifolds = 0;
  // As a float, a step of 1/60 s is a little longer than 1/60.
  const collisionSteps = isTuned ? Math.max(1, Math.ceil(60 * h - 1e-6)) : 1;
  const start = performance.now();
  jolt.Step(h, collisionSteps);
  const end = performance.now();
  if (manifolds > collisionSteps * mostManifolds) throw new Error(`Jolt has room for ${mostManifolds} contacts of a step, and met ${manifolds}`);
  return (end - start) / 1000;
}

serve({
  id: "jolt", build: `jolt-physics ${version}, float, WebAssembly, node ${process.versions.node}`, what: "Jolt Physics as a program under Node",
  settings: [{ key: "tuning", default: 0, what: "1 = a collision step for each 1/60 s of a step, as its manual recommends" },
    { key: "gyroscopic", default: 0, what: "1 = with the gyroscopic torque, which the library leaves out by default" }],
  declared: { motion: "rigid", detection_at: "start", contacts: "geometry", integrator: "semi-implicit Euler", iterations: 10, friction: "cone",
    contact_model: "rigid", contact_margin_m: "0.02", correction: "position", correction_rate: "0.2", precision: "f32" },
  stepSeconds: true, create: ([tuning, gyroscopic]) => { isTuned = tuning === 1, hasGyroscopic = gyroscopic === 1; }, begin, step, readPoints: () => points,
  readStates: () => bodies.map((body) => ({ position: list(body.GetPosition()), orientation: orientationOf(body), velocity: list(body.GetLinearVelocity()), angular_velocity: list(body.GetAngularVelocity()) })),
});
