// Rapier under Node: `rapier` in the list of engines.
//
// What is set: the library's defaults. Friction: sqrt(mu) a collider under the rule Multiply, which is the geometric mean.
// Impulses of friction are not readable in this version (contactTangentImpulseX and Y are zero, also where a box is
// braked), so a report would not be the whole impulse: contacts are declared as geometry.
import RAPIER from "@dimforge/rapier3d-deterministic-compat";
import { FIRST_FACE, serve } from "../../../core/plugin/clients/broadside_engine.mjs";
import { add, dot, facesOf, frictionOf, pointOf, principal, refuse, scaled, sub, turned, wrenchesOf } from "../rigid_bodies.mjs";

await RAPIER.init();
const xyz = ([x, y, z]) => ({ x, y, z });
const wxyz = ([w, x, y, z]) => ({ w, x, y, z });
const list = (v) => [v.x, v.y, v.z];
const SHAPES = { box: "moving", sphere: "moving", capsule: "moving", cylinder: "moving", convex: "moving", mesh: "static" };
// Capsules and cylinders lie along y there; this turns y into the axis.
const AXIS = [[Math.SQRT1_2, 0, 0, -Math.SQRT1_2], [1, 0, 0, 0], [Math.SQRT1_2, Math.SQRT1_2, 0, 0]];

let world, scene, bodies;
let colliders = [], ids = new Map(), detected = new Map();  // ids and poses at detection by handle
let iterations = 4;

function colliderOf(shape, mesh) {
  const h = shape.half_extents;
  switch (shape.kind) {
    case "box": return RAPIER.ColliderDesc.cuboid(...h);
    case "sphere": return RAPIER.ColliderDesc.ball(shape.radius);
    case "capsule": return RAPIER.ColliderDesc.capsule(shape.half_length, shape.radius).setRotation(wxyz(AXIS[shape.axis]));
    case "cylinder": return RAPIER.ColliderDesc.cylinder(shape.half_length, shape.radius).setRotation(wxyz(AXIS[shape.axis]));
    case "convex": return RAPIER.ColliderDesc.convexHull(new Float32Array(mesh.vertices));
    default: return RAPIER.ColliderDesc.trimesh(new Float32Array(mesh.vertices), new Uint32Array(mesh.triangles));
  }
}

function dress(collider, friction, restitution) {
  return collider.setDensity(0).setFriction(Math.sqrt(friction)).setFrictionCombineRule(RAPIER.CoefficientCombineRule.Multiply)
    .setRestitution(restitution).setRestitutionCombineRule(RAPIER.CoefficientCombineRule.Max);
}

function note(collider, id) {
  colliders.push(collider), ids.set(collider.handle, id);
}

function begin(given) {
  scene = given;
  refuse(scene, { shapes: SHAPES, library: "Rapier" });
  world?.free();
  world = new RAPIER.World(xyz(scene.gravity));
  world.timestep = scene.dt;
  world.numSolverIterations = iterations;
  colliders = [], ids = new Map(), detected = new Map();
  bodies = scene.bodies.map((b, k) => {
    const desc = (b.is_static ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic())
      .setTranslation(...b.position).setRotation(wxyz(b.orientation)).setLinvel(...b.velocity).setAngvel(xyz(b.angular_velocity)).setCanSleep(false);
    if (!b.is_static) {
      const { moments, axes } = principal(b.inertia);
      if (!scene.turns) desc.lockRotations();
      desc.setAdditionalMassProperties(b.mass, xyz(b.center_of_mass), xyz(scene.turns ? moments : [1, 1, 1]), wxyz(axes));
    }
    const body = world.createRigidBody(desc);
    const collider = colliderOf(scene.shapes[b.mesh], scene.meshes[b.mesh]);
    if (!collider) throw new Error("unsupported: a convex mesh without volume");
    note(world.createCollider(dress(collider, frictionOf(b), b.restitution), body), k);
    return body;
  });
  for (const { face, normal, point } of facesOf(scene)) {
    const wall = world.createRigidBody(RAPIER.RigidBodyDesc.fixed().setTranslation(...point));
    note(world.createCollider(dress(new RAPIER.ColliderDesc(new RAPIER.HalfSpace(xyz(normal))), scene.face_mu_kinetic, scene.face_restitution), wall), FIRST_FACE + face);
  }
}

const quaternionOf = (c) => { const q = c.rotation(); return [q.w, q.x, q.y, q.z]; };
const orientationOf = (body) => { const q = body.rotation(); return [q.w, q.x, q.y, q.z]; };

function step(h) {
  world.timestep = h;
  for (const { body: k } of scene.wrenches) {
    const { force, torque } = wrenchesOf(scene, k, orientationOf(bodies[k]));
    bodies[k].resetForces(true), bodies[k].resetTorques(true);
    bodies[k].addForce(xyz(force), true), bodies[k].addTorque(xyz(torque), true);
  }
  for (const c of colliders) detected.set(c.handle, { x: list(c.translation()), q: quaternionOf(c) });
  const start = performance.now();
  world.step();
  return (performance.now() - start) / 1000;
}

// Points are kept in the axes of their shapes and are not found anew in every step. How far they are apart follows from
// their places at the step's start; contactDist does not give it. A manifold's normal points from the first shape.
function readPoints() {
  const points = [];
  const place = (handle, p) => add(detected.get(handle).x, turned(detected.get(handle).q, list(p)));
  for (const one of colliders)
    world.contactPairsWith(one, (two) => {
      if (ids.get(one.handle) > ids.get(two.handle)) return;  // each pair comes from both
      world.contactPair(one, two, (m, isFlipped) => {
        const [first, second] = isFlipped ? [two, one] : [one, two];
        const n = turned(detected.get(first.handle).q, list(m.localNormal1()));
        for (let k = 0; k < m.numContacts(); ++k) {
          const p = place(first.handle, m.localContactPoint1(k)), q = place(second.handle, m.localContactPoint2(k));
          points.push(pointOf(ids.get(first.handle), ids.get(second.handle), { point: scaled(0.5, add(p, q)), normal: scaled(-1, n), gap: dot(sub(q, p), n) }));
        }
      });
    });
  return points;
}

serve({
  id: "rapier", build: `Rapier ${RAPIER.version()}, float, WebAssembly, node ${process.versions.node}`, what: "Rapier 3-D, deterministic build, as a program under Node",
  settings: [{ key: "iterations", default: 4, what: "solver iterations, which are its substeps" }],
  declared: { motion: "rigid", detection_at: "start", contacts: "geometry", integrator: "semi-implicit Euler in substeps", substeps: "setting:iterations", iterations: 4,
    friction: "cone", contact_model: "rigid", correction: "velocity", precision: "f32" },
  stepSeconds: true, create: ([i]) => { iterations = i; }, begin, step, readPoints,
  readStates: () => bodies.map((body) => ({ position: list(body.translation()), orientation: orientationOf(body), velocity: list(body.linvel()), angular_velocity: list(body.angvel()) })),
});
