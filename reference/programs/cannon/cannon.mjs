// cannon-es under Node: `cannon` in the list of engines.
//
// What is set: no damping, since scenes have none (the library's default is 0.01); a contact material for each pair of
// materials, with the geometric mean of frictions and the larger restitution; friction on (the library's default). The
// library rotates inertia by its diagonal alone: bodies are given in principal axes. It has no gyroscopic
// torque. Its friction is bounded by mu m g of a pair, not by a share of each point's impulse.
import * as CANNON from "cannon-es";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { FIRST_FACE, serve } from "../../../core/plugin/clients/broadside_engine.mjs";
import { add, centerOf, dot, facesOf, frictionOf, originOf, pointOf, principal, refuse, scaled, sub, times, turned, unit, wrenchesOf } from "../rigid_bodies.mjs";

const version = JSON.parse(readFileSync(createRequire(import.meta.url).resolve("cannon-es/package.json"))).version;
const SHAPES = { box: "moving", sphere: "moving", convex: "moving" };
const vec3 = ([x, y, z]) => new CANNON.Vec3(x, y, z);
const quat = ([w, x, y, z]) => new CANNON.Quaternion(x, y, z, w);
const list = (v) => [v.x, v.y, v.z];
const conjugate = ([w, x, y, z]) => [w, -x, -y, -z];

let iterations = 10;
let scene, world, bodies, axes;
let ids = new Map(), seconds = 0;  // of bodies and faces, by the library's number; the last step's length

function shapeOf(shape, mesh) {
  if (shape.kind === "box") return new CANNON.Box(vec3(shape.half_extents));
  if (shape.kind === "sphere") return new CANNON.Sphere(shape.radius);
  const vertices = [], triangles = [];
  for (let k = 0; k < mesh.vertices.length; k += 3) vertices.push(vec3(mesh.vertices.slice(k, k + 3)));
  for (let k = 0; k < mesh.triangles.length; k += 3) triangles.push([...mesh.triangles.slice(k, k + 3)]);
  return new CANNON.ConvexPolyhedron({ vertices, faces: polygonsOf(vertices, triangles) });
}

// The library clips a face by as many neighbors as the face has edges, taking the first ones that share a vertex with
// it. That is right for the four sides of a brick's face, and wrong for its two triangles, whose points then lie
// outside the body. So triangles of one plane are joined to one polygon here: the edges that have no reverse, one after
// another.
function polygonsOf(vertices, triangles) {
  const planes = [];
  for (const face of triangles) {
    const [a, b, c] = face.map((k) => vertices[k]);
    const normal = b.vsub(a).cross(c.vsub(a)).unit();
    const found = planes.find((p) => p.normal.dot(normal) > 1 - 1e-9 && Math.abs(p.normal.dot(a.vsub(p.point))) < 1e-6 * (a.length() + 1));
    if (found) found.faces.push(face);
    else planes.push({ normal, point: a, faces: [face] });
  }
  return planes.flatMap(({ faces }) => {
    const edges = new Set(faces.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]));
    const next = new Map([...edges].map((e) => e.split(" ").map(Number)).filter(([a, b]) => !edges.has(`${b} ${a}`)));
    const start = next.keys().next().value, polygon = [start];
    for (let k = next.get(start); k !== undefined && k !== start && polygon.length < next.size; k = next.get(k)) polygon.push(k);
    return polygon.length === next.size && next.get(polygon.at(-1)) === start ? [polygon] : faces;
  });
}

// One material for each pair of coefficients.
function materials() {
  const known = [];
  const of = (friction, restitution) => {
    let found = known.find((m) => m.friction_ === friction && m.restitution_ === restitution);
    if (!found) known.push(found = Object.assign(new CANNON.Material(), { friction_: friction, restitution_: restitution }));
    return found;
  };
  const join = () => known.forEach((a, i) => known.slice(i).forEach((b) => world.addContactMaterial(new CANNON.ContactMaterial(a, b,
    { friction: Math.sqrt(a.friction_ * b.friction_), restitution: Math.max(a.restitution_, b.restitution_) }))));
  return { of, join };
}

function begin(given) {
  scene = given;
  refuse(scene, { shapes: SHAPES, library: "cannon-es" });
  world = new CANNON.World({ gravity: vec3(scene.gravity), allowSleep: false });
  world.broadphase = new CANNON.SAPBroadphase(world);
  world.solver.iterations = iterations;
  const { of, join } = materials();
  axes = [], ids = new Map();
  bodies = scene.bodies.map((b, index) => {
    const p = b.is_static ? { moments: [1, 1, 1], axes: [1, 0, 0, 0] } : principal(b.inertia);
    axes[index] = p.axes;
    const q = times(b.orientation, p.axes);
    const body = new CANNON.Body({ mass: b.is_static ? 0 : b.mass, position: vec3(centerOf(b)), quaternion: quat(q), velocity: vec3(b.velocity),
      angularVelocity: vec3(b.angular_velocity), material: of(frictionOf(b), b.restitution), linearDamping: 0, angularDamping: 0 });
    const back = conjugate(p.axes);
    body.addShape(shapeOf(scene.shapes[b.mesh], scene.meshes[b.mesh]), vec3(turned(back, scaled(-1, b.center_of_mass))), quat(back));
    if (!b.is_static) {
      body.updateMassProperties = () => {};  // the scene's inertia, not that of the shape's box
      body.inertia = vec3(p.moments), body.invInertia = vec3(p.moments.map((m) => 1 / m));
      body.fixedRotation = !scene.turns;
      if (!scene.turns) body.invInertia = vec3([0, 0, 0]);
      body.invInertiaSolve.copy(body.invInertia);
      body.updateInertiaWorld(true);
    }
    world.addBody(body);
    ids.set(body.id, index);
    return body;
  });
  for (const { face, normal, point, axis } of facesOf(scene)) {
    const body = new CANNON.Body({ mass: 0, position: vec3(point), shape: new CANNON.Plane(), material: of(scene.face_mu_kinetic, scene.face_restitution) });
    body.quaternion.setFromVectors(vec3([0, 0, 1]), vec3(normal));
    if (axis === 2 && normal[2] < 0) body.quaternion.setFromAxisAngle(vec3([1, 0, 0]), Math.PI);
    world.addBody(body);
    ids.set(body.id, FIRST_FACE + face);
  }
  join();
}

const orientationOf = (k) => { const q = bodies[k].quaternion; return unit(times([q.w, q.x, q.y, q.z], conjugate(axes[k]))); };

function step(h) {
  for (const { body: k } of scene.wrenches) {
    const { force, torque } = wrenchesOf(scene, k, orientationOf(k));
    bodies[k].force.copy(vec3(force)), bodies[k].torque.copy(vec3(torque));
  }
  seconds = h;
  const start = performance.now();
  world.step(h);
  return (performance.now() - start) / 1000;
}

// The equations of the last step: multipliers are forces on the second body, along the normal and along two tangents.
// They belong to the poses at the step's start. Points at one place share their friction: the first of them has all of
// it.
function readPoints() {
  const key = (e) => [e.bi.id, e.bj.id, ...list(e.ri), ...list(e.rj)].join(" ");
  const center = (body) => list(body.type === CANNON.Body.STATIC ? body.position : body.previousPosition);
  const friction = new Map();
  for (const e of world.frictionEquations) friction.set(key(e), add(friction.get(key(e)) ?? [0, 0, 0], scaled(seconds * e.multiplier, list(e.t))));
  return world.contacts.map((e) => {
    const n = list(e.ni), p = add(center(e.bi), list(e.ri)), q = add(center(e.bj), list(e.rj));
    const onSecond = add(scaled(seconds * e.multiplier, n), friction.get(key(e)) ?? [0, 0, 0]);
    friction.delete(key(e));
    return pointOf(ids.get(e.bi.id), ids.get(e.bj.id), { point: scaled(0.5, add(p, q)), normal: scaled(-1, n), gap: dot(sub(q, p), n), impulse: scaled(-1, onSecond) });
  });
}

serve({
  id: "cannon", build: `cannon-es ${version}, double, node ${process.versions.node}`, what: "cannon-es as a program under Node",
  settings: [{ key: "iterations", default: 10, what: "iterations of the Gauss-Seidel solver" }],
  declared: { motion: "rigid", detection_at: "start", contacts: "totals", integrator: "semi-implicit Euler", iterations: "setting:iterations", friction: "pyramid",
    contact_model: "compliant", contact_time_s: "0.05", correction: "velocity", precision: "f64" },
  stepSeconds: true, create: ([i]) => { iterations = i; }, begin, step, readPoints,
  readStates: () => bodies.map((body, k) => ({ position: originOf(scene.bodies[k], list(body.position), orientationOf(k)), orientation: orientationOf(k),
    velocity: list(body.velocity), angular_velocity: list(body.angularVelocity) })),
});
