// Simulates the scene that arrives on standard input with Rapier, and prints a line of JSON a step: the states of the
// bodies. rapier_recorder.py starts it; the first argument is the folder that has the package.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const require = createRequire(pathToFileURL(process.argv[2] + "/").href);
const RAPIER = require("@dimforge/rapier3d-deterministic-compat");
await RAPIER.init();

const scene = JSON.parse(readFileSync(0, "utf8"));
const xyz = ([x, y, z]) => ({ x, y, z });
const list = (v) => [v.x, v.y, v.z];

const world = new RAPIER.World(xyz([0, 0, scene.gravity]));
world.timestep = scene.dt;
const surface = (shape) => shape.setFriction(scene.friction).setRestitution(0);
world.createCollider(surface(new RAPIER.ColliderDesc(new RAPIER.HalfSpace(xyz([0, 0, 1])))));
const bodies = scene.places.map((place) => {
  const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(...place).setCanSleep(false));
  world.createCollider(surface(RAPIER.ColliderDesc.cuboid(...scene.half)).setMass(scene.mass), body);
  return body;
});

for (let step = 0; step < scene.frames; ++step) {
  world.step();
  const states = { position: [], orientation: [], velocity: [], angular_velocity: [] };
  for (const body of bodies) {
    const q = body.rotation();
    states.position.push(list(body.translation()));
    states.orientation.push([q.w, q.x, q.y, q.z]);
    states.velocity.push(list(body.linvel()));
    states.angular_velocity.push(list(body.angvel()));
  }
  console.log(JSON.stringify(states));
}
