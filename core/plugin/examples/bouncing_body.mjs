// One body that flies, turns and bounces off the faces of the domain, in JavaScript:
//
//   broadside run spinning_box.toml --engine 'node bouncing_body.mjs'
//
// A ball or a box is represented by one or eight small balls that touch a face. The state has the angular momentum,
// which includes the gyroscopic term. bouncing_body.c describes each step.
import { FIRST_FACE, serve } from "../clients/broadside_engine.mjs";

const SWEEPS = 100;
const add = (a, b) => a.map((x, k) => x + b[k]);
const scaled = (s, a) => a.map((x) => s * x);
const sub = (a, b) => a.map((x, k) => x - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const size = (a) => Math.sqrt(dot(a, a));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const axes = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
const unit = (q) => {
  const s = 1 / Math.hypot(...q);
  return q.map((x) => s * x);
};
const turned = (q, v) => {
  const u = q.slice(1),
    t = scaled(2, cross(u, v));
  return add(add(v, scaled(q[0], t)), cross(u, t));
};
const turnedBack = (q, v) => turned([q[0], -q[1], -q[2], -q[3]], v);

function inverse([xx, yy, zz, xy, xz, yz]) {
  const rows = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  const s = 1 / dot(rows[0], cross(rows[1], rows[2]));
  return [
    [1, 2],
    [2, 0],
    [0, 1],
  ].map(([i, j]) => scaled(s, cross(rows[i], rows[j])));
}

let body, points, seen, scene;

const spin = (q, momentum) => {
  const l = turnedBack(q, momentum);
  return turned(
    q,
    body.inverse.map((row) => dot(row, l)),
  );
};
const origin = () => sub(body.x, turned(body.q, body.center));
const speedAt = (at) => add(body.v, cross(spin(body.q, body.momentum), sub(at, body.x)));
const mobility = (at, d) => {
  const arm = cross(sub(at, body.x), d);
  return 1 / body.mass + dot(arm, spin(body.q, arm));
};

function push(at, impulse) {
  body.v = add(body.v, scaled(1 / body.mass, impulse));
  body.momentum = add(body.momentum, cross(sub(at, body.x), impulse));
}

function begin(given) {
  scene = given;
  const b = scene.bodies[0];
  if (scene.bodies.length !== 1 || b.is_static || !scene.turns)
    throw new Error("this example simulates one body that moves and turns");
  if (scene.wrenches.length > 0) throw new Error("unsupported: wrenches");
  const shape = scene.shapes[b.mesh],
    h = shape.half_extents;
  if (shape.kind !== "box" && shape.kind !== "sphere") throw new Error(`unsupported: ${shape.kind}`);
  const corners =
    shape.kind === "sphere"
      ? [[0, 0, 0]]
      : [...Array(8).keys()].map((k) => h.map((x, axis) => ((k >> axis) & 1 ? x : -x)));
  const q = b.orientation,
    i = b.inertia,
    w = turnedBack(q, b.angular_velocity);
  body = {
    mass: b.mass,
    inverse: inverse(i),
    center: b.center_of_mass,
    q,
    v: b.velocity,
    radius: shape.radius,
    corners: corners.map((c) => sub(c, b.center_of_mass)),
    x: add(b.position, turned(q, b.center_of_mass)),
    momentum: turned(q, [dot([i[0], i[3], i[4]], w), dot([i[3], i[1], i[5]], w), dot([i[4], i[5], i[2]], w)]),
    restitution: Math.max(b.restitution, scene.face_restitution),
    muStatic: Math.sqrt(b.mu_static * scene.face_mu_static),
    muKinetic: Math.sqrt(b.mu_kinetic * scene.face_mu_kinetic),
  };
  body.reach = Math.max(...body.corners.map(size)) + body.radius;
}

// Rounds to the next float32 outward, so that recorded boxes contain the shape.
function outward(x, side) {
  const near = Math.fround(x);
  return side * (near - x) > 0 ? near : Math.fround(near + side * Math.max(Math.abs(near) * 2 ** -23, 2 ** -126));
}

function see() {
  const places = body.corners.map((c) => add(body.x, turned(body.q, c)));
  const reach = (axis, side) =>
    outward(side * Math.max(...places.map((p) => side * p[axis])) + side * body.radius, side);
  seen = {
    position: origin(),
    orientation: body.q,
    velocity: body.v,
    min: [0, 1, 2].map((k) => reach(k, -1)),
    max: [0, 1, 2].map((k) => reach(k, 1)),
  };
}

function findPoints(h) {
  points = [];
  const near = h * (size(body.v) + size(spin(body.q, body.momentum)) * body.reach + h * size(scene.gravity));
  for (let face = 0; face < 6; ++face) {
    const axis = face >> 1,
      side = face % 2 === 0 ? 1 : -1,
      normal = scaled(side, axes[axis]);
    for (const corner of body.corners) {
      const at = sub(add(body.x, turned(body.q, corner)), scaled(body.radius, normal));
      const gap = side * (at[axis] - (side > 0 ? scene.domain_min : scene.domain_max)[axis]);
      if (gap <= near) points.push({ face, at, normal, gap, push: 0, drag: [0, 0, 0], total: [0, 0, 0] });
    }
  }
}

function solve(p) {
  const n = p.normal,
    before = p.push;
  p.push = Math.max(0, before + (p.leastSpeed - dot(speedAt(p.at), n)) / mobility(p.at, n));
  push(p.at, scaled(p.push - before, n));
  const v = speedAt(p.at),
    slip = sub(v, scaled(dot(v, n), n));
  const across = axes.filter((a) => dot(a, n) === 0); // both together are at least the mobility of any direction across
  let drag = sub(p.drag, scaled(1 / (mobility(p.at, across[0]) + mobility(p.at, across[1])), slip));
  if (size(drag) > body.muStatic * p.push) drag = scaled((body.muKinetic * p.push) / size(drag), drag);
  push(p.at, sub(drag, p.drag));
  p.drag = drag;
}

function solveAll(some) {
  for (let sweep = 0; sweep < SWEEPS; ++sweep) some.forEach(solve);
  for (const p of some) {
    p.total = add(p.total, add(scaled(p.push, p.normal), p.drag));
    p.push = 0;
    p.drag = [0, 0, 0];
  }
}

// The classical Runge-Kutta method on dq/dt = (0, w) q / 2.
function turn(h) {
  const rate = (q) => {
    const w = spin(unit(q), body.momentum),
      u = q.slice(1);
    return scaled(0.5, [-dot(w, u), ...add(scaled(q[0], w), cross(w, u))]);
  };
  const q = body.q,
    k1 = rate(q),
    k2 = rate(add(q, scaled(h / 2, k1))),
    k3 = rate(add(q, scaled(h / 2, k2))),
    k4 = rate(add(q, scaled(h, k3)));
  body.q = unit(q.map((x, k) => x + (h / 6) * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k])));
}

function step(h) {
  const start = performance.now();
  see();
  findPoints(h);
  for (const p of points) {
    p.approach = -dot(speedAt(p.at), p.normal);
    p.leastSpeed = body.restitution * p.approach;
  }
  solveAll(
    points.filter(
      (p) => p.approach > scene.v_threshold && p.gap < h * (p.approach - h * dot(scene.gravity, p.normal)),
    ),
  );
  const before = body.v;
  body.v = add(body.v, scaled(h, scene.gravity));
  const free = body.v;
  for (const p of points) p.leastSpeed = -Math.max(0, p.gap) / h;
  solveAll(points);
  const isFree = body.v.every((x, k) => x === free[k]);
  body.x = add(body.x, isFree ? scaled(h / 2, add(before, body.v)) : scaled(h, body.v));
  turn(h);
  return (performance.now() - start) / 1000;
}

serve({
  id: "example-bouncing-node",
  build: `example 1.0, double, node ${process.versions.node}`,
  what: "an example in JavaScript: one body that turns and bounces",
  declared: {
    motion: "rigid",
    detection_at: "start",
    contacts: "totals",
    integrator: "semi-implicit Euler, Runge-Kutta 4 for the orientation",
    iterations: SWEEPS,
    friction: "cone",
    contact_model: "rigid",
    correction: "none",
    precision: "f64",
  },
  stepSeconds: true,
  begin,
  step,
  readStates: () => [
    { position: origin(), orientation: body.q, velocity: body.v, angular_velocity: spin(body.q, body.momentum) },
  ],
  readPoints: () =>
    points
      .filter((p) => size(p.total) > 0 || p.gap <= 0)
      .map((p) => ({
        a: 0,
        b: FIRST_FACE + p.face,
        point: p.at,
        normal: p.normal,
        gap: p.gap,
        impulse: p.total,
        feature: 0,
      })),
  readDetection: () => [seen],
});
