// A recorded run as the page holds it: whole numbers in base64, unpacked frame by frame (reports/playback.hpp).

function bytes_of(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; ++k) bytes[k] = raw.charCodeAt(k);
  return bytes.buffer;
}
const words = (text) => new Uint16Array(bytes_of(text));
const longs = (text) => new Uint32Array(bytes_of(text));

const face_names = ["-x", "+x", "-y", "+y", "-z", "+z"];
// Faces of the domain are numbered after the last body.
export const body_name = (playback, k) => (k < playback.bodies ? `body ${k}` : `face ${face_names[k - playback.bodies]}`);

export class Playback {
  constructor(data) {
    for (const key of ["name", "domain", "up", "dt_s", "last_step", "bodies", "min", "cell", "depth_cell_m", "steps", "marks"]) this[key] = data[key];
    this.shape_of_body = words(data.shape_of_body);
    this.places = words(data.positions);
    this.turns = words(data.turns);
    this.pair_begin = longs(data.pair_begin);
    this.pair_words = words(data.pairs);
    this.contact_begin = longs(data.contact_begin);
    this.contact_words = words(data.contacts);
    this.shapes = data.shapes.map((shape) => ({
      levels: shape.levels.map((level) => this.#unpacked(words(level), shape.min, shape.cell)),
      vertices: this.#unpacked(words(shape.vertices), shape.min, shape.cell),
      triangles: words(shape.triangles),
    }));
  }

  get frame_count() { return this.steps.length; }

  #unpacked(packed, min, cell) {
    return Float32Array.from(packed, (word, k) => min[k % 3] + word * cell[k % 3]);
  }

  #point(packed, at) {
    return [0, 1, 2].map((axis) => this.min[axis] + packed[at + axis] * this.cell[axis]);
  }

  position(frame, body) {
    return this.#point(this.places, 3 * (frame * this.bodies + body));
  }

  // The unit quaternion x y z w that turns the body from its first orientation.
  turn(frame, body) {
    const at = 4 * (frame * this.bodies + body);
    if (at >= this.turns.length) return [0, 0, 0, 1];
    const [w, x, y, z] = [0, 1, 2, 3].map((k) => this.turns[at + k] / 32767.5 - 1);
    const length = Math.hypot(w, x, y, z);
    return [x / length, y / length, z / length, w / length];
  }

  pairs(frame) {
    const found = [];
    for (let k = this.pair_begin[frame]; k < this.pair_begin[frame + 1]; ++k) found.push([this.pair_words[2 * k], this.pair_words[2 * k + 1]]);
    return found;
  }

  // 16-bit numbers of a contact: a, b, point (3), normal (3, from -1 to 1), depth.
  contacts(frame) {
    const found = [];
    for (let k = this.contact_begin[frame]; k < this.contact_begin[frame + 1]; ++k) {
      const at = 9 * k;
      const w = this.contact_words;
      found.push({
        a: w[at], b: w[at + 1], point: this.#point(w, at + 2),
        normal: [0, 1, 2].map((axis) => w[at + 5 + axis] / 32767.5 - 1),
        depth_m: w[at + 8] * this.depth_cell_m,
      });
    }
    return found;
  }

  // The recorded frame whose step is nearest.
  frame_of(step) {
    let best = 0;
    for (let k = 1; k < this.frame_count; ++k) if (Math.abs(this.steps[k] - step) < Math.abs(this.steps[best] - step)) best = k;
    return best;
  }
}
