// Functions that every program of this folder needs before it calls its library: vectors, turns, principal axes, and
// states of the center of mass. Arrays of numbers; quaternions are w x y z as in broadside_engine_v2.h.

export const add = (a, b) => a.map((x, k) => x + b[k]);
export const sub = (a, b) => a.map((x, k) => x - b[k]);
export const scaled = (s, a) => a.map((x) => s * x);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const size = (a) => Math.sqrt(dot(a, a));
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const unit = (q) => { const s = 1 / Math.hypot(...q); return q.map((x) => s * x); };
export const turned = (q, v) => { const u = q.slice(1), t = scaled(2, cross(u, v)); return add(add(v, scaled(q[0], t)), cross(u, t)); };
export const times = (p, q) => {
  const a = p.slice(1), b = q.slice(1);
  return [p[0] * q[0] - dot(a, b), ...add(add(scaled(p[0], b), scaled(q[0], a)), cross(a, b))];
};

// The center of mass in the world, m.
export const centerOf = (body) => add(body.position, turned(body.orientation, body.center_of_mass));
// Where the mesh's origin is when the center of mass is at x, m.
export const originOf = (body, x, q) => sub(x, turned(q, body.center_of_mass));

// The six faces of the domain as half-spaces: a point of the plane and its inward normal, in the order -x +x -y +y -z +z.
export function facesOf(scene) {
  return [0, 1, 2, 3, 4, 5].map((face) => {
    const axis = face >> 1, isUpper = face % 2 === 1, normal = [0, 0, 0], point = [0, 0, 0];
    normal[axis] = isUpper ? -1 : 1;
    point[axis] = (isUpper ? scene.domain_max : scene.domain_min)[axis];
    return { face, axis, normal, point };
  });
}

// Throws for a scene that the library cannot represent as it is: no other shape is used silently.
export function refuse(scene, { shapes, library }) {
  for (const body of scene.bodies) {
    const kind = scene.shapes[body.mesh].kind;
    const known = shapes[kind];
    if (!known || (known === "static" && !body.is_static)) throw new Error(`unsupported: ${kind}${known ? " that moves" : ""} (${library})`);
  }
}

// Principal moments and the axes they belong to, by Jacobi rotations: { moments, axes } with axes a unit quaternion that
// turns principal axes into the mesh's. inertia: xx yy zz xy xz yz.
export function principal([xx, yy, zz, xy, xz, yz]) {
  const a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
  let q = [1, 0, 0, 0];
  const scale = Math.abs(xx) + Math.abs(yy) + Math.abs(zz);
  for (let sweep = 0; sweep < 64; ++sweep) {
    let [p, r] = [0, 1];
    for (const [i, j] of [[0, 2], [1, 2]]) if (Math.abs(a[i][j]) > Math.abs(a[p][r])) [p, r] = [i, j];
    if (Math.abs(a[p][r]) <= 2 ** -52 * scale) break;
    const angle = 0.5 * Math.atan2(2 * a[p][r], a[r][r] - a[p][p]), c = Math.cos(angle), s = Math.sin(angle);
    const turn = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    turn[p][p] = turn[r][r] = c, turn[p][r] = s, turn[r][p] = -s;
    const left = turn.map((_, i) => [0, 1, 2].map((j) => [0, 1, 2].reduce((sum, k) => sum + turn[k][i] * a[k][j], 0)));
    for (let i = 0; i < 3; ++i)
      for (let j = 0; j < 3; ++j) a[i][j] = [0, 1, 2].reduce((sum, k) => sum + left[i][k] * turn[k][j], 0);
    // turn as a quaternion: about the third axis, from p to r where the axes are in cyclic order.
    const third = 3 - p - r, sign = (p + 1) % 3 === r ? -1 : 1, step = [Math.cos(angle / 2), 0, 0, 0];
    step[1 + third] = sign * Math.sin(angle / 2);
    q = unit(times(q, step));
  }
  return { moments: [a[0][0], a[1][1], a[2][2]], axes: q };
}

// A row of contact for `readPoints`, ordered so that a is the lower body: the normal points from b to a, the impulse (N
// s) acts on a. Libraries that do not give impulses leave it out, and declare contacts = geometry.
export function pointOf(a, b, { point, normal, gap, impulse = [0, 0, 0] }) {
  const isTurned = a > b, sign = isTurned ? -1 : 1;
  return { a: isTurned ? b : a, b: isTurned ? a : b, point, normal: scaled(sign, normal), gap, impulse: scaled(sign, impulse), feature: 0, reserved: 0 };
}

// The friction coefficient for libraries that have only one: that of sliding.
export const frictionOf = (body) => body.mu_kinetic;
export const wrenchesOf = (scene, body, q) => {
  const sum = { force: [0, 0, 0], torque: [0, 0, 0] };
  for (const w of scene.wrenches) {
    if (w.body !== body) continue;
    sum.force = add(sum.force, w.axes === 1 ? turned(q, w.force) : w.force);
    sum.torque = add(sum.torque, w.axes === 1 ? turned(q, w.torque) : w.torque);
  }
  return sum;
};
