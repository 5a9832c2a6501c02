// PhysX 5 under Node: `physx` in the list of engines.
//
// What is set: no damping, no caps of speed, no sleep, and bounces above the scene's threshold; the rest is the library's
// default, the gyroscopic torque (off) too, which is a setting. Materials combine by multiplying square roots of
// frictions (the geometric mean) and by the larger restitution. Reports of contact hold impulses along normals alone, not
// those of friction, so contacts are declared as geometry. Reporting is inside the step's time.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { FIRST_FACE, serve } from "../../../core/plugin/clients/broadside_engine.mjs";
import { facesOf, frictionOf, pointOf, principal, refuse, wrenchesOf } from "../rigid_bodies.mjs";

const require = createRequire(import.meta.url);
const packageFile = require.resolve("physx-js-webidl/package.json");
const version = JSON.parse(readFileSync(packageFile)).version;
// The loader is made for browsers. Node's version is hidden while it loads, so that it behaves as in a worker; it is
// given the code itself.
const node = process.versions.node;
Object.defineProperty(process.versions, "node", { value: undefined, configurable: true });
globalThis.WorkerGlobalScope ??= Object;
globalThis.self ??= globalThis;
globalThis.location ??= { href: import.meta.url };
const { default: load } = await import("physx-js-webidl");
const P = await load({ wasmBinary: readFileSync(packageFile.replace("package.json", "physx-js-webidl.wasm")) });
Object.defineProperty(process.versions, "node", { value: node, configurable: true });

const SHAPES = { box: "moving", sphere: "moving", capsule: "moving", convex: "moving", mesh: "static" };
// Capsules lie along x there; this turns x into the axis.
const AXIS = [[1, 0, 0, 0], [Math.SQRT1_2, 0, 0, Math.SQRT1_2], [Math.SQRT1_2, 0, -Math.SQRT1_2, 0]];
const vec3 = ([x, y, z]) => new P.PxVec3(x, y, z);
const quat = ([w, x, y, z]) => new P.PxQuat(x, y, z, w);
const pose = (at, q) => new P.PxTransform(vec3(at), quat(q));
const list = (v) => [v.x, v.y, v.z];

const foundation = P.CreateFoundation(P.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
const scale = new P.PxTolerancesScale();
const physics = P.CreatePhysics(P.PHYSICS_VERSION, foundation, scale);
const cooking = new P.PxCookingParams(scale);

// PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, which the binding's enumeration lacks.
const GYROSCOPIC = 1 << 10;

let hasGyroscopic = false, isTuned = false;
let scene, world, bodies;
let points = [], ids = new Map();  // of bodies and faces, by address

// Pairs report their points while they touch: the third word of the filter data holds the flags that a pair raises in
// addition to contact.
const REPORTS = P.PxPairFlagEnum.eNOTIFY_TOUCH_FOUND | P.PxPairFlagEnum.eNOTIFY_TOUCH_PERSISTS | P.PxPairFlagEnum.eNOTIFY_CONTACT_POINTS;
const MOST_POINTS = 256;
const found = new P.PxArray_PxContactPairPoint(MOST_POINTS);
const reports = new P.PxSimulationEventCallbackImpl();
reports.onConstraintBreak = reports.onWake = reports.onSleep = reports.onTrigger = () => {};
reports.onContact = (header, pairs, count) => {
  const actors = P.wrapPointer(header, P.PxContactPairHeader);
  const [one, two] = [0, 1].map((k) => ids.get(P.getPointer(actors.get_actors(k))));
  for (let k = 0; k < count; ++k) {
    const pair = P.NativeArrayHelpers.prototype.getContactPairAt(P.wrapPointer(pairs, P.PxContactPair), k);
    const n = pair.extractContacts(found.begin(), MOST_POINTS);
    for (let i = 0; i < n; ++i) {
      const p = found.get(i);
      points.push(pointOf(one, two, { point: list(p.position), normal: list(p.normal), gap: p.separation }));
    }
  }
};

function materialOf(friction, restitution) {
  const material = physics.createMaterial(Math.sqrt(friction), Math.sqrt(friction), restitution);
  material.setFrictionCombineMode(P.PxCombineModeEnum.eMULTIPLY);
  material.setRestitutionCombineMode(P.PxCombineModeEnum.eMAX);
  return material;
}

function pointsInto(desc, vertices) {
  const data = new P.PxArray_PxVec3(vertices.length / 3);
  for (let k = 0; k < vertices.length; k += 3) data.set(k / 3, vec3(vertices.slice(k, k + 3)));
  desc.points.count = vertices.length / 3, desc.points.stride = 12, desc.points.data = data.begin();
}

function geometryOf(shape, mesh) {
  switch (shape.kind) {
    case "box": return new P.PxBoxGeometry(...shape.half_extents);
    case "sphere": return new P.PxSphereGeometry(shape.radius);
    case "capsule": return new P.PxCapsuleGeometry(shape.radius, shape.half_length);
    case "convex": {
      const desc = new P.PxConvexMeshDesc();
      desc.flags = new P.PxConvexFlags(P.PxConvexFlagEnum.eCOMPUTE_CONVEX);
      pointsInto(desc, mesh.vertices);
      return new P.PxConvexMeshGeometry(P.PxTopLevelFunctions.prototype.CreateConvexMesh(cooking, desc));
    }
    default: {
      const desc = new P.PxTriangleMeshDesc(), corners = new P.PxArray_PxU32(mesh.triangles.length);
      pointsInto(desc, mesh.vertices);
      mesh.triangles.forEach((corner, k) => corners.set(k, corner));
      desc.triangles.count = mesh.triangles.length / 3, desc.triangles.stride = 12, desc.triangles.data = corners.begin();
      return new P.PxTriangleMeshGeometry(P.PxTopLevelFunctions.prototype.CreateTriangleMesh(cooking, desc));
    }
  }
}

function shapeInto(actor, geometry, material, at, q) {
  const shape = physics.createShape(geometry, material, true, new P.PxShapeFlags(P.PxShapeFlagEnum.eSIMULATION_SHAPE));
  shape.setSimulationFilterData(new P.PxFilterData(1, 1, REPORTS, 0));
  shape.setLocalPose(pose(at, q));
  actor.attachShape(shape);
}

function bodyOf(b) {
  const drawn = scene.shapes[b.mesh];
  const at = pose(b.position, b.orientation);
  const actor = b.is_static ? physics.createRigidStatic(at) : physics.createRigidDynamic(at);
  shapeInto(actor, geometryOf(drawn, scene.meshes[b.mesh]), materialOf(frictionOf(b), b.restitution), [0, 0, 0], drawn.kind === "capsule" ? AXIS[drawn.axis] : [1, 0, 0, 0]);
  if (!b.is_static) {
    const { moments, axes } = principal(scene.turns ? b.inertia : [1, 1, 1, 0, 0, 0]);
    actor.setMass(b.mass), actor.setCMassLocalPose(pose(b.center_of_mass, axes)), actor.setMassSpaceInertiaTensor(vec3(moments));
    actor.setLinearDamping(0), actor.setAngularDamping(0), actor.setMaxLinearVelocity(1e8), actor.setMaxAngularVelocity(1e8), actor.setSleepThreshold(0);
    if (hasGyroscopic) actor.setRigidBodyFlag(GYROSCOPIC, true);
    if (!scene.turns) for (const flag of ["X", "Y", "Z"]) actor.setRigidDynamicLockFlag(P.PxRigidDynamicLockFlagEnum[`eLOCK_ANGULAR_${flag}`], true);
    actor.setLinearVelocity(vec3(b.velocity)), actor.setAngularVelocity(vec3(b.angular_velocity));
  }
  world.addActor(actor);
  return actor;
}

function begin(given) {
  scene = given;
  refuse(scene, { shapes: SHAPES, library: "PhysX" });
  const desc = new P.PxSceneDesc(scale);
  desc.gravity = vec3(scene.gravity);
  desc.cpuDispatcher = P.DefaultCpuDispatcherCreate(0);
  desc.filterShader = P.DefaultFilterShader();
  desc.bounceThresholdVelocity = Math.max(scene.v_threshold, 1e-6);
  desc.simulationEventCallback = reports;
  if (isTuned) desc.solverType = P.PxSolverTypeEnum.eTGS;
  world = physics.createScene(desc);
  points = [], bodies = scene.bodies.map(bodyOf);
  ids = new Map(bodies.map((body, k) => [P.getPointer(body), k]));
  const material = materialOf(scene.face_mu_kinetic, scene.face_restitution);
  for (const { face, normal, point } of facesOf(scene)) {
    // Planes face along their own x.
    const q = normal[0] > 0 ? [1, 0, 0, 0] : normal[0] < 0 ? [0, 0, 0, 1] : normal[1] !== 0 ? [Math.SQRT1_2, 0, 0, normal[1] * Math.SQRT1_2] : [Math.SQRT1_2, 0, -normal[2] * Math.SQRT1_2, 0];
    const wall = physics.createRigidStatic(pose(point, q));
    shapeInto(wall, new P.PxPlaneGeometry(), material, [0, 0, 0], [1, 0, 0, 0]);
    ids.set(P.getPointer(wall), FIRST_FACE + face);
    world.addActor(wall);
  }
}

const orientationOf = (body) => { const q = body.getGlobalPose().q; return [q.w, q.x, q.y, q.z]; };

function step(h) {
  for (const { body: k } of scene.wrenches) {
    const { force, torque } = wrenchesOf(scene, k, orientationOf(bodies[k]));
    bodies[k].addForce(vec3(force), P.PxForceModeEnum.eFORCE, true), bodies[k].addTorque(vec3(torque), P.PxForceModeEnum.eFORCE, true);
  }
  points = [];
  const start = performance.now();
  world.simulate(h);
  world.fetchResults(true);
  return (performance.now() - start) / 1000;
}

function stateOf(body, k) {
  const b = scene.bodies[k];
  if (b.is_static) return { position: b.position, orientation: b.orientation, velocity: [0, 0, 0], angular_velocity: [0, 0, 0] };
  return { position: list(body.getGlobalPose().p), orientation: orientationOf(body), velocity: list(body.getLinearVelocity()), angular_velocity: list(body.getAngularVelocity()) };
}

serve({
  id: "physx", build: `PhysX 5.6.1 (physx-js-webidl ${version}), float, WebAssembly, node ${node}`, what: "PhysX 5 as a program under Node",
  settings: [{ key: "tuning", default: 0, what: "1 = the solver eTGS, which its manual calls better with large mass ratios" },
    { key: "gyroscopic", default: 0, what: "1 = with the gyroscopic torque, which the library leaves out by default" }],
  declared: { motion: "rigid", detection_at: "start", contacts: "geometry", integrator: "semi-implicit Euler", iterations: 4, friction: "pyramid",
    contact_model: "rigid", contact_margin_m: "0.02", correction: "position", precision: "f32" },
  stepSeconds: true, create: ([tuning, gyroscopic]) => { isTuned = tuning === 1, hasGyroscopic = gyroscopic === 1; }, begin, step, readPoints: () => points,
  readStates: () => bodies.map(stateOf),
});
