// The picture of one frame: bodies, their octree boxes, candidate pairs, contacts. Draws only when something changed.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, InstancedMesh,
  LineBasicMaterial, LineSegments, Matrix4, MeshLambertMaterial, PerspectiveCamera, Quaternion, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { css_color, reduced_motion } from "./colors.js";

const kMostTriangles = 4e6; // above that, level-2 boxes stand in for meshes
const kMostLevelLines = 4e6; // floats
const kUnitScale = new Vector3(1, 1, 1);

// Corner k of a box, bits of k choose min or max; the twelve edges and the triangles of the six sides.
const corner = (box, k) => [0, 1, 2].map((axis) => box[(k >> axis) & 1 ? 3 + axis : axis]);
const edges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
const sides = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]];

function boxes_of(level) {
  const boxes = [];
  for (let k = 0; k < level.length; k += 6) boxes.push(level.subarray(k, k + 6));
  return boxes;
}
const edge_points = (boxes) => boxes.flatMap((box) => edges.flat().flatMap((k) => corner(box, k)));

function geometry(points, indices) {
  const g = new BufferGeometry();
  g.setAttribute("position", new BufferAttribute(Float32Array.from(points), 3));
  if (indices) g.setIndex(Array.from(indices));
  return g;
}

export class Stage {
  constructor(canvas, playback) {
    this.canvas = canvas;
    this.playback = playback;
    this.shown = { bodies: true, level0: false, level1: false, level2: false, pairs: true, contacts: true };
    this.frame = 0;
    this.marked = [];
    // The drawing buffer is kept, so that the page can be copied and printed as it looks.
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.01, 1000);
    this.camera.up.set(...playback.up);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(new AmbientLight(0xffffff, 1.6));
    const sun = new DirectionalLight(0xffffff, 1.8);
    sun.position.set(1, 2, 3);
    this.camera.add(sun);
    this.scene.add(this.camera);
    this.#build();
    this.recolor();
    this.home();
  }

  #build() {
    const { playback } = this;
    const triangles = Array.from(playback.shape_of_body, (s) => playback.shapes[s].triangles.length / 3).reduce((a, b) => a + b, 0);
    this.body_material = new MeshLambertMaterial({ side: DoubleSide, transparent: true });
    this.meshes = playback.shapes.map((shape, s) => {
      const members = [];
      playback.shape_of_body.forEach((own, body) => { if (own === s) members.push(body); });
      const boxes = boxes_of(shape.levels[shape.levels.length - 1]);
      const solid = shape.triangles.length && triangles <= kMostTriangles
        ? geometry(shape.vertices, shape.triangles)
        : geometry(boxes.flatMap((box) => [...Array(8).keys()].flatMap((k) => corner(box, k))),
          boxes.flatMap((_, n) => sides.flat().map((k) => 8 * n + k)));
      const flat = solid.toNonIndexed();
      flat.computeVertexNormals();
      const mesh = new InstancedMesh(flat, this.body_material, Math.max(1, members.length));
      mesh.count = members.length;
      mesh.frustumCulled = false;
      mesh.userData.members = members;
      this.scene.add(mesh);
      return mesh;
    });
    const lines = (opacity) => {
      const object = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: opacity < 1, opacity }));
      object.frustumCulled = false;
      this.scene.add(object);
      return object;
    };
    this.level_lines = [lines(1), lines(0.9), lines(0.7)];
    this.level_points = this.playback.shapes.map((shape) => shape.levels.map((level) => edge_points(boxes_of(level))));
    this.pair_lines = lines(0.8);
    this.contact_lines = lines(1);
    this.mark_lines = lines(1);
    // Things inside bodies are drawn after them and as transparent, so that they show through.
    for (const object of [this.pair_lines, this.contact_lines, this.mark_lines]) {
      object.material.depthTest = false;
      object.material.transparent = true;
      object.renderOrder = 2;
    }
    this.domain_lines = lines(0.6);
    this.#set_lines(this.domain_lines, edge_points([[...playback.domain.min, ...playback.domain.max]]));
  }

  recolor() {
    this.scene.background = new Color(css_color("--stage") || "#ffffff");
    this.base = new Color(css_color("--s1"));
    this.mark = new Color(css_color("--fail"));
    for (const lines of this.level_lines) lines.material.color.set("#e01818");
    this.pair_lines.material.color.set(css_color("--s0"));
    this.contact_lines.material.color.set(css_color("--s2"));
    this.mark_lines.material.color.set(css_color("--fail"));
    this.domain_lines.material.color.set(css_color("--faint"));
    this.show(this.frame);
  }

  #set_lines(object, points) {
    object.geometry.dispose();
    object.geometry = geometry(points);
    object.visible = points.length > 0;
  }

  // From the coordinates of the body's shape to the world, in the frame that is shown.
  #pose(body) {
    const { playback, frame } = this;
    return new Matrix4().compose(new Vector3(...playback.position(frame, body)), new Quaternion(...playback.turn(frame, body)), kUnitScale);
  }

  // The boxes of the bodies, in the frame that is shown.
  #moved(bodies, level) {
    const out = [];
    const point = new Vector3();
    for (const body of bodies) {
      const pose = this.#pose(body);
      const points = this.level_points[this.playback.shape_of_body[body]][level] ?? [];
      for (let k = 0; k < points.length; k += 3) {
        point.set(points[k], points[k + 1], points[k + 2]).applyMatrix4(pose);
        out.push(point.x, point.y, point.z);
      }
      if (out.length > kMostLevelLines) break;
    }
    return out;
  }

  center_of(body) {
    const shape = this.playback.shapes[this.playback.shape_of_body[body]];
    const box = shape.levels[0];
    return new Vector3(...[0, 1, 2].map((axis) => (box[axis] + box[3 + axis]) / 2)).applyMatrix4(this.#pose(body)).toArray();
  }

  size_of(body) {
    const box = this.playback.shapes[this.playback.shape_of_body[body]].levels[0];
    return Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
  }

  show(frame) {
    this.frame = frame;
    const { playback, shown } = this;
    const marked = new Set(this.marked);
    for (const mesh of this.meshes) {
      mesh.visible = shown.bodies;
      mesh.userData.members.forEach((body, k) => {
        mesh.setMatrixAt(k, this.#pose(body));
        mesh.setColorAt(k, marked.has(body) ? this.mark : this.base);
      });
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    const boxes_shown = shown.level0 || shown.level1 || shown.level2;
    this.body_material.opacity = boxes_shown ? 0.3 : 1;
    this.body_material.depthWrite = !boxes_shown;
    const everyone = [...Array(playback.bodies).keys()];
    this.level_lines.forEach((lines, level) => this.#set_lines(lines, shown[`level${level}`] ? this.#moved(everyone, level) : []));
    const pairs = playback.pairs(frame);
    this.#set_lines(this.pair_lines, shown.pairs ? pairs.flatMap(([i, j]) => [...this.center_of(i), ...this.center_of(j)]) : []);
    const contacts = playback.contacts(frame);
    this.#set_lines(this.contact_lines, shown.contacts ? contacts.flatMap((c) => this.#arrow(c)) : []);
    this.#set_lines(this.mark_lines, this.#moved(this.marked.filter((b) => b < playback.bodies), 0));
    this.draw();
    return { pairs, contacts };
  }

  // A contact: a small cross at its point and an arrow along its normal, from B to A.
  #arrow(contact) {
    const size = 0.35 * this.size_of(contact.a);
    const at = new Vector3(...contact.point);
    const normal = new Vector3(...contact.normal);
    const tip = at.clone().addScaledVector(normal, size);
    const across = new Vector3(normal.y, normal.z, normal.x).cross(normal).normalize();
    const out = [at, tip];
    for (const turn of [1, -1]) out.push(tip, tip.clone().addScaledVector(normal, -0.25 * size).addScaledVector(across, 0.12 * size * turn));
    for (const axis of [[1, 0, 0], [0, 1, 0], [0, 0, 1]]) {
      const arm = new Vector3(...axis).multiplyScalar(0.06 * size);
      out.push(at.clone().sub(arm), at.clone().add(arm));
    }
    return out.flatMap((p) => p.toArray());
  }

  look_from(target, distance) {
    const up = new Vector3(...this.playback.up);
    const side = new Vector3(up.y, up.z, up.x);
    const front = up.clone().cross(side);
    const direction = front.multiplyScalar(1).addScaledVector(side, 0.55).addScaledVector(up, 0.45).normalize();
    return target.clone().addScaledVector(direction, distance);
  }

  home() {
    const all = [...Array(this.playback.bodies).keys()].map((b) => new Vector3(...this.center_of(b)));
    const low = all.reduce((m, p) => m.min(p), all[0]?.clone() ?? new Vector3());
    const high = all.reduce((m, p) => m.max(p), all[0]?.clone() ?? new Vector3());
    const reach = low.distanceTo(high) + Math.max(...[...Array(Math.min(this.playback.bodies, 50)).keys()].map((b) => this.size_of(b)), 0.01);
    this.#scale_camera(reach);
    this.fly(low.add(high).multiplyScalar(0.5), 1.3 * reach, 0);
  }

  #scale_camera(reach) {
    this.camera.near = reach * 1e-3;
    this.camera.far = reach * 100;
    this.camera.updateProjectionMatrix();
  }

  // Moves the camera to the marked bodies; it jumps when the reader asked for less motion.
  fly_to(bodies) {
    const own = bodies.filter((b) => b < this.playback.bodies);
    if (!own.length) return;
    const target = own.map((b) => new Vector3(...this.center_of(b))).reduce((sum, p) => sum.add(p)).divideScalar(own.length);
    const spread = Math.max(...own.map((b) => this.size_of(b) + 2 * target.distanceTo(new Vector3(...this.center_of(b)))));
    this.fly(target, 1.9 * spread, reduced_motion() ? 0 : 700);
  }

  fly(target, distance, milliseconds) {
    const from = { eye: this.camera.position.clone(), target: this.controls.target.clone() };
    const to = { eye: this.look_from(target, distance), target };
    const start = performance.now();
    const move = (now) => {
      const t = milliseconds ? Math.min(1, (now - start) / milliseconds) : 1;
      const eased = t * t * (3 - 2 * t);
      this.camera.position.lerpVectors(from.eye, to.eye, eased);
      this.controls.target.lerpVectors(from.target, to.target, eased);
      this.controls.update();
      this.draw();
      if (t < 1) requestAnimationFrame(move);
    };
    move(start);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }

  dispose() {
    this.controls.dispose();
    for (const mesh of this.meshes) mesh.geometry.dispose();
    this.scene.traverse((object) => object.geometry?.dispose());
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
