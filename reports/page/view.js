// The 3-D view's controls: which run, which frame, what is shown; and the links from verdicts to their places.
import { on_scheme_change } from "./colors.js";
import { body_name, Playback } from "./playback.js";
import { Stage } from "./stage.js";

const element = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};

const layers = [
  ["bodies", "bodies"], ["level0", "boxes, level 0"], ["level1", "boxes, level 1"], ["level2", "boxes, level 2"],
  ["pairs", "candidate pairs"], ["contacts", "contacts, normals"],
];

class View {
  constructor(place, data) {
    this.place = place;
    this.data = data;
    this.canvas = element("canvas", { tabIndex: 0 });
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The recorded scene in 3-D. Space plays, arrow keys step, drag turns.");
    this.frame = 0;
    this.timer = 0;
    this.#build();
  }

  #build() {
    this.runs = element("select", {}, ...this.data.map((p, k) => element("option", { value: k, textContent: p.name })));
    this.runs.addEventListener("change", () => this.open(Number(this.runs.value)));
    this.play_button = element("button", { type: "button", textContent: "Play" });
    this.play_button.addEventListener("click", () => this.play(!this.timer));
    this.slider = element("input", { type: "range", min: 0, value: 0 });
    this.slider.setAttribute("aria-label", "frame");
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    const step = (text, name, by) => {
      const button = element("button", { type: "button", textContent: text });
      button.setAttribute("aria-label", name);
      button.addEventListener("click", () => this.go(this.frame + by));
      return button;
    };
    const home = element("button", { type: "button", textContent: "Whole scene" });
    home.addEventListener("click", () => { this.mark([], ""); this.stage.home(); });
    this.checks = layers.map(([key, text]) => {
      const input = element("input", { type: "checkbox" });
      input.addEventListener("change", () => { this.stage.shown[key] = input.checked; this.go(this.frame); });
      return { key, input, label: element("label", {}, input, ` ${text}`) };
    });
    this.status = element("p", { className: "status" });
    this.marks = element("div", { className: "marks" });
    this.rows = element("tbody");
    const head = element("tr", {}, ...["bodies", "depth", "normal"].map((t) => element("th", { scope: "col", textContent: t })));
    const table = element("details", { className: "beside" }, element("summary", { textContent: "Contacts of this frame as a table" }),
      element("table", {}, element("thead", {}, head), this.rows));
    const run_label = element("label", {}, "Run ", this.runs);
    this.place.replaceChildren(
      element("div", { className: "bar-of-tools" }, run_label, this.play_button, step("\u2039", "one frame back", -1), step("\u203a", "one frame on", 1), this.slider, home),
      element("div", { className: "canvas" }, this.canvas),
      element("div", { className: "layers" }, ...this.checks.map((c) => c.label)),
      this.status, this.marks, table);
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.stage?.resize()).observe(this.canvas.parentElement);
    on_scheme_change(() => this.stage?.recolor());
  }

  open(k) {
    const shown = this.stage?.shown;
    this.play(false);
    if (this.stage) {
      this.stage.dispose();
      const fresh = this.canvas.cloneNode();
      fresh.addEventListener("keydown", (event) => this.key(event));
      this.canvas.replaceWith(fresh);
      this.canvas = fresh;
    }
    this.current = k;
    this.runs.value = k;
    this.playback = new Playback(this.data[k]);
    this.stage = new Stage(this.canvas, this.playback);
    if (shown) this.stage.shown = shown;
    for (const { key, input } of this.checks) input.checked = this.stage.shown[key];
    this.slider.max = this.playback.frame_count - 1;
    this.marked_text = "";
    this.marks.replaceChildren(...this.playback.marks.map((mark) => {
      const button = element("button", { type: "button", textContent: mark.text });
      button.addEventListener("click", () => this.show_mark(mark));
      return button;
    }));
    this.stage.resize();
    this.go(0);
    this.stage.home();
  }

  mark(bodies, text) {
    this.stage.marked = bodies;
    this.marked_text = text;
    this.go(this.frame);
  }

  show_mark(mark) {
    this.play(false);
    if (mark.step >= 0) this.frame = this.playback.frame_of(mark.step);
    this.mark(mark.bodies, mark.text);
    this.stage.fly_to(mark.bodies);
  }

  go(frame) {
    this.frame = Math.max(0, Math.min(this.playback.frame_count - 1, frame));
    this.slider.value = this.frame;
    const { pairs, contacts } = this.stage.show(this.frame);
    const step = this.playback.steps[this.frame];
    this.slider.setAttribute("aria-valuetext", `step ${step}`);
    const count = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;
    this.status.textContent = `Step ${step} of ${this.playback.last_step}, ${(step * this.playback.dt_s).toFixed(3)} s: ` +
      `${count(pairs.length, "candidate pair")}, ${count(contacts.length, "contact")}.` + (this.marked_text ? ` Marked: ${this.marked_text}.` : "");
    this.place.dataset.step = step;
    this.place.dataset.marked = this.stage.marked.join(" ");
    this.rows.replaceChildren(...contacts.slice(0, 50).map((c) => element("tr", {},
      element("td", { textContent: `${body_name(this.playback, c.a)}, ${body_name(this.playback, c.b)}` }),
      element("td", { textContent: `${(c.depth_m * 1000).toPrecision(3)} mm` }),
      element("td", { textContent: c.normal.map((x) => x.toFixed(2)).join(" ") }))));
  }

  play(is_on) {
    if (Boolean(this.timer) === is_on) return;
    clearInterval(this.timer);
    this.timer = 0;
    if (is_on) {
      if (this.frame === this.playback.frame_count - 1) this.go(0);
      this.timer = setInterval(() => {
        if (this.frame === this.playback.frame_count - 1) this.play(false);
        else this.go(this.frame + 1);
      }, 50);
    }
    this.play_button.textContent = is_on ? "Pause" : "Play";
  }

  key(event) {
    const act = {
      " ": () => this.play(!this.timer), ArrowLeft: () => this.go(this.frame - 1), ArrowRight: () => this.go(this.frame + 1),
      Home: () => this.go(0), End: () => this.go(this.playback.frame_count - 1),
    }[event.key];
    if (!act || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    act();
  }
}

export function open_views(data) {
  const place = document.getElementById("view");
  if (!place || !data.length) return;
  // The picture stays for paper; on the screen the view replaces it.
  const picture = document.getElementById("view-picture");
  if (!document.createElement("canvas").getContext("webgl2")) {
    place.append(element("p", { className: "hint no-webgl", textContent: "This browser has no WebGL: a picture of the frame stands in for the 3-D view." }));
    place.dataset.state = "picture";
    return;
  }
  const view = new View(place, data);
  view.open(0);
  place.dataset.state = "drawn";
  if (picture) place.after(picture);
  picture?.classList.add("print-only");
  for (const button of document.querySelectorAll("button.to-view")) {
    button.hidden = false;
    button.addEventListener("click", () => {
      const playback = Number(button.dataset.playback);
      if (view.current !== playback) view.open(playback);
      view.show_mark(data[playback].marks[Number(button.dataset.mark)]);
      place.scrollIntoView({ block: "center" });
      view.canvas.focus({ preventScroll: true });
    });
  }
}
