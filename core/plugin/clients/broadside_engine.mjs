// An engine for Broadside in JavaScript: import { serve } and give it an object with the functions that you have. serve
// speaks the protocol of core/plugin/PROGRAMS.md over standard input and output, until its input ends.
//
//   serve({ id: "my-world", build: "mine 1.0, double", what: "one line",
//           declared: { motion: "rigid", contacts: "totals" },
//           begin(scene) {}, step(dt) {}, readStates() { return [...] }, readPoints() { return [...] } });
//
// Rows are objects with the names of broadside_engine_v2.h. When a function throws, the call fails with the message.
// With stepSeconds: true, step returns its own seconds, which are then the times; otherwise the times include the pipe.
import { readSync, writeSync } from "node:fs";

const MAGIC = "BROADSID",
  VERSION = 1,
  FIRST_FACE = 0xfffffff0;
const KINDS = ["", "box", "sphere", "capsule", "cylinder", "convex", "mesh"];

const vector = (name) => [name, "f64", 3];
const STATE = [vector("position"), ["orientation", "f64", 4], vector("velocity"), vector("angular_velocity")];
const BOX = [
  ["min", "f32", 3],
  ["max", "f32", 3],
];
const PAIR = [
  ["i", "u32"],
  ["j", "u32"],
];
const POSE = [
  ["position", "f32", 3],
  ["orientation", "f32", 4],
];
const SEPARATION = [
  ["distance_m", "f64"],
  ["normal", "f32", 3],
  ["witness_a", "f32", 3],
  ["witness_b", "f32", 3],
  ["is_touching", "u32"],
];
const POINT = [
  ["a", "u32"],
  ["b", "u32"],
  vector("point"),
  vector("normal"),
  ["gap", "f64"],
  vector("impulse"),
  ["feature", "u32"],
  ["reserved", "u32"],
];
const CONTACT = [
  ["a", "u32"],
  ["b", "u32"],
  ["depth_m", "f32"],
  ["normal", "f32", 3],
  ["normal_impulse", "f32"],
  ["tangent", "f32", 3],
  ["tangent_impulse", "f32"],
  ...["pre", "post"].flatMap((when) =>
    ["a", "b"].flatMap((who) => ["position", "velocity"].map((what) => [`${when}_${what}_${who}`, "f32", 3])),
  ),
];
const DETECTION = [
  vector("position"),
  ["orientation", "f64", 4],
  vector("velocity"),
  ["min", "f32", 3],
  ["max", "f32", 3],
];
const SHAPE = [["kind", "u32"], ["axis", "u32"], vector("half_extents"), ["radius", "f64"], ["half_length", "f64"]];
const BODY = [
  ["mesh", "u32"],
  ["is_static", "u32"],
  ...STATE,
  ["mass", "f64"],
  vector("center_of_mass"),
  ["inertia", "f64", 6],
  ["mu_static", "f64"],
  ["mu_kinetic", "f64"],
  ["restitution", "f64"],
];
const WRENCH = [["body", "u32"], ["axes", "u32"], vector("force"), vector("torque")];

const READ = {
  u32: (v, at) => v.getUint32(at, true),
  u64: (v, at) => Number(v.getBigUint64(at, true)),
  f32: (v, at) => v.getFloat32(at, true),
  f64: (v, at) => v.getFloat64(at, true),
};
const WRITE = {
  u32: (v, at, x) => v.setUint32(at, x, true),
  u64: (v, at, x) => v.setBigUint64(at, BigInt(x), true),
  f32: (v, at, x) => v.setFloat32(at, x, true),
  f64: (v, at, x) => v.setFloat64(at, x, true),
};
const SIZE = { u32: 4, u64: 8, f32: 4, f64: 8 };

class Reader {
  constructor(bytes) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    this.at = 0;
  }
  one(type) {
    const value = READ[type](this.view, this.at);
    this.at += SIZE[type];
    return value;
  }
  many(type, count) {
    return Array.from({ length: count }, () => this.one(type));
  }
  text() {
    const size = this.one("u32");
    const text = Buffer.from(this.view.buffer, this.view.byteOffset + this.at, size).toString();
    this.at += size;
    return text;
  }
  row(layout) {
    return Object.fromEntries(
      layout.map(([name, type, count]) => [name, count ? this.many(type, count) : this.one(type)]),
    );
  }
  rows(layout, count) {
    return Array.from({ length: count }, () => this.row(layout));
  }
}

class Writer {
  constructor() {
    this.parts = [];
  }
  one(type, value) {
    const part = Buffer.alloc(SIZE[type]);
    WRITE[type](new DataView(part.buffer, part.byteOffset), 0, value);
    this.parts.push(part);
    return this;
  }
  text(value) {
    const bytes = Buffer.from(value);
    this.one("u32", bytes.length);
    this.parts.push(bytes);
    return this;
  }
  rows(layout, rows) {
    const size = layout.reduce((sum, [, type, count]) => sum + SIZE[type] * (count ?? 1), 0);
    const part = Buffer.alloc(size * rows.length),
      view = new DataView(part.buffer, part.byteOffset);
    let at = 0;
    for (const row of rows)
      for (const [name, type, count] of layout)
        for (let k = 0; k < (count ?? 1); ++k, at += SIZE[type])
          WRITE[type](view, at, (count ? row[name][k] : row[name]) ?? 0);
    this.parts.push(part);
    return this;
  }
  bytes() {
    return Buffer.concat(this.parts);
  }
}

function readScene(r) {
  const scene = {
    name: r.text(),
    turns: r.one("u32") === 1,
    frames: r.one("u32"),
    seed: r.one("u64"),
    dt: r.one("f64"),
  };
  for (const name of ["gravity", "domain_min", "domain_max"]) scene[name] = r.many("f64", 3);
  for (const name of [
    "face_mu_static",
    "face_mu_kinetic",
    "face_restitution",
    "delta",
    "v_threshold",
    "v_max",
    "theta",
  ])
    scene[name] = r.one("f64");
  const meshes = r.one("u32"),
    bodies = r.one("u32"),
    wrenches = r.one("u32");
  scene.shapes = r.rows(SHAPE, meshes).map((shape) => ({ ...shape, kind: KINDS[shape.kind] ?? "unknown" }));
  scene.bodies = r.rows(BODY, bodies);
  scene.wrenches = r.rows(WRENCH, wrenches);
  scene.meshes = Array.from({ length: meshes }, () => {
    const vertices = r.one("u64"),
      triangles = r.one("u64");
    return { vertices: r.many("f32", 3 * vertices), triangles: r.many("u32", 3 * triangles) };
  });
  return scene;
}

function helloOf(e) {
  const has = ["findPairs", "measure", "step", "readPoints", "readContacts", "readDetection", "readStepPairs"].map(
    (name) => Boolean(e[name]),
  );
  const offers = [...has, Boolean(e.stepSeconds)].reduce((bits, is, k) => bits | (is ? 1 << k : 0), 0);
  const w = new Writer();
  w.parts.push(Buffer.from(MAGIC));
  w.one("u32", VERSION)
    .one("u32", offers)
    .one("u32", e.isExact === false ? 0 : 1)
    .one("f64", e.marginM ?? 0);
  w.text(e.id).text(e.build).text(e.what);
  const settings = e.settings ?? [],
    declared = Object.entries(e.declared ?? {});
  w.one("u32", settings.length);
  for (const s of settings) w.text(s.key).one("u64", s.default).text(s.what);
  w.one("u32", declared.length);
  for (const [key, value] of declared) w.text(key).text(String(value));
  return w;
}

// Answers by call number. A list of rows is cut to the requested room; the caller then calls again with more room.
function listed(layout, rows, r) {
  const room = r.one("u64");
  return new Writer().one("u64", rows.length).rows(layout, rows.slice(0, room));
}
const CALLS = {
  1: (e) => helloOf(e),
  2: (e, r) => {
    e.create?.(r.many("u64", r.one("u32")));
  },
  3: (e, r) => {
    const n = r.one("u32");
    e.loadBoxes(
      r.rows(BOX, n),
      Array.from({ length: n }, () => r.view.getUint8(r.at++) !== 0),
    );
  },
  4: (e, r) => {
    e.updateBoxes(r.rows(BOX, r.one("u32")));
  },
  5: (e) => {
    e.findPairs();
  },
  6: (e, r) => listed(PAIR, e.readPairs(), r),
  7: (e, r) => {
    e.loadScene(readScene(r));
  },
  8: (e, r) => {
    const pairs = r.one("u64"),
      bodies = r.one("u32");
    e.measure(r.rows(PAIR, pairs), r.rows(POSE, bodies));
  },
  9: (e, r) => listed(SEPARATION, e.readSeparations(), r),
  10: (e, r) => {
    e.begin(readScene(r));
  },
  11: (e, r) => {
    const seconds = e.step(r.one("f64"));
    if (e.stepSeconds) return new Writer().one("f64", seconds);
  },
  12: (e, r) => listed(STATE, e.readStates(), r),
  13: (e, r) => listed(POINT, e.readPoints(), r),
  14: (e, r) => listed(CONTACT, e.readContacts(), r),
  15: (e, r) => listed(DETECTION, e.readDetection(), r),
  16: (e, r) => listed(PAIR, e.readStepPairs(), r),
  17: (e) => {
    e.end?.();
  },
};

// Fills the buffer; false at the end of the input.
function receive(buffer) {
  for (let have = 0; have < buffer.length;) {
    const got = readSync(0, buffer, have, buffer.length - have, null);
    if (got === 0) return false;
    have += got;
  }
  return true;
}

function send(status, payload) {
  const head = Buffer.alloc(8);
  head.writeUInt32LE(payload.length + 4, 0);
  head.writeUInt32LE(status, 4);
  const frame = Buffer.concat([head, payload]);
  for (let sent = 0; sent < frame.length;) sent += writeSync(1, frame, sent);
}

export function serve(engine) {
  console.log = console.info = console.error; // standard output carries only the protocol
  const head = Buffer.alloc(4);
  while (receive(head)) {
    const message = Buffer.alloc(head.readUInt32LE(0));
    if (!receive(message)) return;
    const call = message.readUInt32LE(0);
    try {
      if (!CALLS[call]) throw new Error(`there is no call ${call}`);
      const answer = CALLS[call](engine, new Reader(message.subarray(4)));
      send(0, answer ? answer.bytes() : Buffer.alloc(0));
    } catch (error) {
      send(1, new Writer().text(String(error.message ?? error).slice(0, 1000)).bytes());
    }
  }
}

export { FIRST_FACE };
