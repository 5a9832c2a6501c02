// MuJoCo 3 under Node: `mujoco3` in the list of engines.
//
// What is set: the step, gravity, no air, the integrator and the tuning, which are settings; the rest is the default, the
// contact's time constant of 0.02 s and damping ratio of 1 too. A contact takes the larger friction of its two geoms, so the
// scenes of several frictions are refused. It has no coefficient of restitution.
import loadMujoco from "@mujoco/mujoco";
import { serve } from "../../../core/plugin/clients/broadside_engine.mjs";
import { add, cross, facesOf, frictionOf, refuse, scaled, turned, wrenchesOf } from "../rigid_bodies.mjs";

const mujoco = await loadMujoco();
const INTEGRATORS = ["Euler", "implicit", "RK4"];
const SHAPES = { box: "moving", sphere: "moving", capsule: "moving", cylinder: "moving", convex: "moving", mesh: "static" };
// Capsules and cylinders lie along z there; this turns z into the axis.
const AXIS = [[Math.SQRT1_2, 0, Math.SQRT1_2, 0], [Math.SQRT1_2, -Math.SQRT1_2, 0, 0], [1, 0, 0, 0]];
const text = (v) => v.map((x) => x.toPrecision(17)).join(" ");

let integrator = 0, isTuned = false;
let scene, model, data, moving;

function geomOf(b, k) {
  const shape = scene.shapes[b.mesh], h = shape.half_extents;
  const turn = ` quat="${text(AXIS[shape.axis])}"`;
  const size = { box: `type="box" size="${text(h)}"`, sphere: `type="sphere" size="${text([shape.radius])}"`,
    capsule: `type="capsule" size="${text([shape.radius, shape.half_length])}"${turn}`,
    cylinder: `type="cylinder" size="${text([shape.radius, shape.half_length])}"${turn}` }[shape.kind] ?? `type="mesh" mesh="m${b.mesh}"`;
  return `<geom name="g${k}" ${size} mass="0" friction="${text([frictionOf(b), 0, 0])}"/>`;
}

function bodyOf(b, k) {
  const pose = `name="b${k}" pos="${text(b.position)}" quat="${text(b.orientation)}"`;
  if (b.is_static) return `<body ${pose}>${geomOf(b, k)}</body>`;
  const [xx, yy, zz, xy, xz, yz] = scene.turns ? b.inertia : [1, 1, 1, 0, 0, 0];
  const joint = scene.turns ? "<freejoint/>" : ["1 0 0", "0 1 0", "0 0 1"].map((axis) => `<joint type="slide" axis="${axis}"/>`).join("");
  return `<body ${pose}>${joint}<inertial pos="${text(b.center_of_mass)}" mass="${text([b.mass])}" fullinertia="${text([xx, yy, zz, xy, xz, yz])}"/>${geomOf(b, k)}</body>`;
}

// Planes face along their own z.
function faceOf({ face, normal, point }) {
  const z = normal[2] > 0 ? [1, 0, 0, 0] : normal[2] < 0 ? [0, 1, 0, 0] : [Math.SQRT1_2, ...scaled(Math.SQRT1_2, cross([0, 0, 1], normal))];
  return `<geom name="f${face}" type="plane" size="0 0 1" pos="${text(point)}" quat="${text(z)}" friction="${text([scene.face_mu_kinetic, 0, 0])}"/>`;
}

function xml() {
  const meshes = scene.shapes.flatMap((shape, k) => ["convex", "mesh"].includes(shape.kind)
    ? [`<mesh name="m${k}" vertex="${text(scene.meshes[k].vertices)}" face="${scene.meshes[k].triangles.join(" ")}"/>`] : []);
  return `<mujoco><compiler angle="radian" inertiafromgeom="false" boundmass="0" boundinertia="0"/>
    <option timestep="${text([scene.dt])}" gravity="${text(scene.gravity)}" density="0" viscosity="0" integrator="${INTEGRATORS[integrator]}"${isTuned ? ' cone="elliptic" impratio="10"' : ""}>${isTuned ? '<flag multiccd="enable"/>' : ""}</option>
    <size memory="512M"/><asset>${meshes.join("")}</asset>
    <worldbody>${facesOf(scene).map(faceOf).join("")}${scene.bodies.map(bodyOf).join("")}</worldbody></mujoco>`;
}

function begin(given) {
  scene = given;
  refuse(scene, { shapes: SHAPES, library: "MuJoCo" });
  const all = [scene.face_mu_kinetic, ...scene.bodies.map(frictionOf)];
  if (all.some((mu) => mu !== all[0])) throw new Error("unsupported: materials of different friction (MuJoCo takes the larger, scenes the geometric mean)");
  data?.delete(), model?.delete();
  model = mujoco.MjModel.from_xml_string(xml());
  data = new mujoco.MjData(model);
  let dof = 0;
  moving = scene.bodies.map((b) => {
    const at = dof;
    dof += b.is_static ? 0 : scene.turns ? 6 : 3;
    return at;
  });
  const qvel = data.qvel;
  scene.bodies.forEach((b, k) => {
    if (b.is_static) return;
    // A free joint's velocity is that of the body's origin; its rotation is in body axes.
    const [w, x, y, z] = b.orientation, spin = b.angular_velocity;
    const arm = turned(b.orientation, b.center_of_mass);
    const origin = add(b.velocity, scaled(-1, cross(spin, arm)));
    origin.forEach((v, j) => { qvel[moving[k] + j] = v; });
    if (scene.turns) turned([w, -x, -y, -z], spin).forEach((v, j) => { qvel[moving[k] + 3 + j] = v; });
  });
  mujoco.mj_forward(model, data);
}

function stateOf(b, k) {
  if (b.is_static) return { position: b.position, orientation: b.orientation, velocity: [0, 0, 0], angular_velocity: [0, 0, 0] };
  const n = scene.bodies.slice(0, k).reduce((sum, o) => sum + (o.is_static ? 0 : scene.turns ? 7 : 3), 0);
  const qpos = data.qpos, qvel = data.qvel, v = [0, 1, 2].map((j) => qvel[moving[k] + j]);
  if (!scene.turns) return { position: [0, 1, 2].map((j) => b.position[j] + turned(b.orientation, [0, 1, 2].map((i) => qpos[n + i]))[j]), orientation: b.orientation, velocity: turned(b.orientation, v), angular_velocity: [0, 0, 0] };
  const q = [3, 4, 5, 6].map((j) => qpos[n + j]);
  const spin = turned(q, [3, 4, 5].map((j) => qvel[moving[k] + j]));
  return { position: [0, 1, 2].map((j) => qpos[n + j]), orientation: q, velocity: add(v, cross(spin, turned(q, b.center_of_mass))), angular_velocity: spin };
}

function step(h) {
  const start = performance.now();
  if (scene.wrenches.length > 0) {
    const applied = data.xfrc_applied;
    for (const { body: k } of scene.wrenches) {
      const { force, torque } = wrenchesOf(scene, k, stateOf(scene.bodies[k], k).orientation);
      [...force, ...torque].forEach((x, j) => { applied[6 * (k + 1) + j] = x; });
    }
  }
  mujoco.mj_step(model, data);
  return (performance.now() - start) / 1000;
}

serve({
  id: "mujoco3", build: `MuJoCo ${mujoco.mj_versionString?.() ?? "3"}, double, WebAssembly, node ${process.versions.node}`, what: "MuJoCo 3 as a program under Node",
  settings: [{ key: "tuning", default: 0, what: "1 = elliptic cones, impratio 10 and multiccd, as its manual recommends" },
    { key: "integrator", default: 0, what: "0 = Euler, 1 = implicit, 2 = RK4" }],
  declared: { motion: "rigid", detection_at: "start", contacts: "none", integrator: "semi-implicit Euler, implicit or Runge-Kutta 4, as set", iterations: 100,
    friction: "regularized", contact_model: "compliant", contact_time_s: "0.02", correction: "none", precision: "f64" },
  stepSeconds: true, create: ([tuning, i]) => { if (!(i < 3)) throw new Error("integrator is 0, 1 or 2"); isTuned = tuning === 1, integrator = i; }, begin, step,
  readStates: () => scene.bodies.map(stateOf),
});
