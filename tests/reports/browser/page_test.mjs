// The report's page in headless Chromium with the network off:  page_test.mjs PROGRAM CHROMIUM WORK SCENE_FILE
// Everything is made by the program itself, as a user would; screenshots stay in WORK for people to look at.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [program, chromium, work, scene_file] = process.argv.slice(2);
const axe_source = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const most_bytes = 3_000_000;

function broadside(good, ...args) {
  try {
    return execFileSync(program, args, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
  } catch (error) {
    if (good.includes(error.status)) return error.stdout;
    throw new Error(`broadside ${args.join(" ")} exits ${error.status}:\n${error.stdout}${error.stderr}`);
  }
}

// A wrong engine and a sound one over one scene, judged and timed; with two nights of history.
function make_page(folder, scene) {
  const both = ["--engine", "octree-cpu", "--engine", "octree-cpu[variant=printed-E3]", "--engine", "all-pairs"];
  broadside([0], "run", scene, ...both, "--frames", "120", "--out", folder);
  const traces = ["octree-cpu.h5", "octree-cpu+variant=printed-E3.h5", "all-pairs.h5"].map((t) => path.join(folder, t));
  broadside([1, 3], "check", ...traces, "--against", traces[2], "--json", path.join(folder, "verdicts.json"));
  broadside([0], "time", scene, ...both, "--frames", "120", "--repetitions", "3", "--out", path.join(folder, "samples.json"));
  const page = path.join(folder, "report.html");
  broadside([0], "report", folder, "--html", page);
  return page;
}

// What a run of one scene cannot show: narrow phases beside the exact answer, and a paper's table with its figures.
function make_other_page(folder) {
  broadside([0, 3], "agree", "--pairs", "boxes", "--n", "400", "--out", folder);
  const paper = path.join(folder, "paper");
  broadside([0, 1, 3], "paper", "table5", "figure4", "memory", "--engine", "octree-cpu", "--frames", "60", "--runs", "2", "--models", "dragon",
    "--counts", "6,12", "--stand-in", "--out", paper);
  const page = path.join(folder, "report.html");
  broadside([0], "report", folder, "--paper", paper, "--html", page);
  return page;
}

function hostile_scene() {
  const name = "</script><script>window.hostile=1</script><img src=x onerror=window.hostile=2>";
  const file = path.join(work, "hostile.toml");
  // The scene of erratum E3, which fills every section of the page, under a hostile name that no page may execute.
  const given = readFileSync(scene_file, "utf8");
  writeFileSync(file, given.replace(/^name = .*$/m, `name = '${name}'`));
  return { file, name };
}

const browser = await puppeteer.launch({
  executablePath: chromium,
  headless: true,
  timeout: 300_000,
  protocolTimeout: 600_000,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--hide-scrollbars",
    "--proxy-server=127.0.0.1:9", "--disable-dev-shm-usage", "--disable-background-networking"],
});

// A page on which nothing may complain or reach out.
async function opened(file, { width = 1280, height = 900, scheme = "light", before = () => {}, scripts = true } = {}) {
  const page = await browser.newPage();
  // A crowded machine is slow, and that is no fault of the page.
  page.setDefaultTimeout(300_000);
  page.setDefaultNavigationTimeout(300_000);
  const troubles = [];
  page.on("console", (message) => { if (message.type() === "error") troubles.push(`console: ${message.text()}`); });
  page.on("pageerror", (error) => troubles.push(`exception: ${error.message}`));
  page.on("request", (request) => { if (!/^(file|data|blob):/.test(request.url())) troubles.push(`request: ${request.url()}`); });
  await page.setJavaScriptEnabled(scripts);
  await page.setOfflineMode(true);
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }, { name: "prefers-reduced-motion", value: "reduce" }]);
  await before(page);
  await page.goto(pathToFileURL(file).href, { waitUntil: "load" });
  return { page, troubles };
}

// How many pixels of the canvas are reddish, and how many differ from its corner.
const pixels = (page) => page.evaluate(() => {
  const canvas = document.querySelector("#view canvas");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  let drawn = 0;
  let red = 0;
  for (let k = 0; k < data.length; k += 4) {
    if (data[k] !== data[0] || data[k + 1] !== data[1] || data[k + 2] !== data[2]) ++drawn;
    if (data[k] > 150 && data[k + 1] < 80 && data[k + 2] < 80) ++red;
  }
  return { drawn, red, size: data.length / 4, content: copy.toDataURL().length };
});

async function serious_faults(page) {
  await page.evaluate(axe_source);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
  return violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.help}: ${v.nodes.slice(0, 3).map((n) => n.html.slice(0, 160)).join(" | ")}`);
}

const walk_down = (page) => page.evaluate(async () => {
  for (let y = 0; y < document.body.scrollHeight; y += 500) {
    scrollTo(0, y);
    await new Promise((done) => setTimeout(done, 40));
  }
  scrollTo(0, 0);
});

const tests = {
  async "loads with the network off, without a complaint, and every chart is drawn"(file) {
    const { page, troubles } = await opened(file);
    await walk_down(page);
    const charts = await page.evaluate(() => [...document.querySelectorAll("[data-chart]")].map((c) => [c.classList.contains("drawn"), c.querySelectorAll("svg path").length]));
    assert.ok(charts.length >= 5, `${charts.length} charts`);
    for (const [drawn, paths] of charts) assert.ok(drawn && paths > 3, JSON.stringify(charts));
    assert.deepEqual(troubles, []);
    await page.screenshot({ path: path.join(work, "light.png"), fullPage: true });
    await page.close();
  },

  async "a failed verdict opens, and leads to its frame and pair in the 3-D view"(file) {
    const { page, troubles } = await opened(file);
    assert.equal(await page.$eval("#view", (v) => v.dataset.state), "drawn");
    const whole = await pixels(page);
    assert.ok(whole.drawn > whole.size / 200, `the 3-D view drew ${whole.drawn} of ${whole.size} pixels`);
    const place = await page.$("td.fail details summary");
    await place.click();
    const card = await page.$eval("td.fail details[open] .card", (c) => c.textContent);
    assert.match(card, /worst at.*step \d+/s);
    const [, step] = card.match(/step (\d+)/);
    await page.$eval("td.fail details[open] button.to-view", (b) => b.click());
    const shown = await page.$eval("#view", (v) => ({ step: v.dataset.step, marked: v.dataset.marked }));
    assert.equal(shown.step, step);
    assert.notEqual(shown.marked, "");
    const near = await pixels(page);
    assert.notEqual(near.content, whole.content, "the camera flew");
    assert.ok(near.red > 100, `the marked pair is red: ${near.red} pixels`);
    await page.screenshot({ path: path.join(work, "view.png") });
    // Each layer must be visible, also where it lies inside bodies.
    for (const layer of ["candidate pairs", "contacts, normals"]) {
      const toggle = () => page.evaluate((name) => [...document.querySelectorAll("#view .layers label")].find((l) => l.textContent.includes(name)).querySelector("input").click(), layer);
      await toggle();
      assert.notEqual((await pixels(page)).content, near.content, `${layer} were seen`);
      await toggle();
    }
    assert.deepEqual(troubles, []);
    await page.close();
  },

  async "boxes of the octree are red wireframes, frames play and step by keys"(file) {
    const { page, troubles } = await opened(file);
    await page.$eval("#view", (v) => v.scrollIntoView());
    const before = await pixels(page);
    const boxes = await page.$$("#view .layers input");
    await boxes[2].click();
    const after = await pixels(page);
    assert.ok(after.red > before.red + 200, `red wireframe: ${before.red} then ${after.red} pixels`);
    await page.screenshot({ path: path.join(work, "boxes.png") });
    await page.focus("#view canvas");
    const step = () => page.$eval("#view", (v) => Number(v.dataset.step));
    await page.keyboard.press("Home");
    const first = await step();
    await page.keyboard.press("ArrowRight");
    assert.ok(await step() > first);
    await page.keyboard.press("Space");
    await new Promise((done) => setTimeout(done, 600));
    await page.keyboard.press("Space");
    const played = await step();
    assert.ok(played > first + 1, `played to step ${played}`);
    await page.keyboard.press("End");
    assert.equal(await step(), 120);
    assert.deepEqual(troubles, []);
    await page.close();
  },

  async "axe-core finds nothing serious, light and dark, wide and narrow"(file) {
    for (const [scheme, width, name] of [["light", 1280, ""], ["dark", 1280, "dark"], ["light", 390, "narrow"]]) {
      const { page } = await opened(file, { scheme, width });
      await walk_down(page);
      assert.deepEqual(await serious_faults(page), [], `${scheme}, ${width} pixels wide`);
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.ok(overflow <= 0, `${overflow} pixels too wide at ${width}`);
      if (name) await page.screenshot({ path: path.join(work, `${name}.png`), fullPage: true });
      await page.close();
    }
  },

  async "without WebGL a picture of the frame stands in"(file) {
    const { page, troubles } = await opened(file, {
      before: (p) => p.evaluateOnNewDocument(() => {
        const given = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return /webgl/.test(kind) ? null : given.call(this, kind, ...rest); };
      }),
    });
    assert.equal(await page.$eval("#view", (v) => v.dataset.state), "picture");
    assert.ok(await page.$eval("#view svg.scene", (s) => s.getBoundingClientRect().height > 100 && s.querySelectorAll(".marked polygon").length > 0));
    // three.js itself tells the console that it got no context.
    assert.deepEqual(troubles.filter((t) => !/WebGL/i.test(t)), []);
    await page.close();
  },

  async "with scripts off all is there to read"(file) {
    const { page } = await opened(file, { scripts: false });
    // Checks only what the browser itself can tell about this page.
    const text = readFileSync(file, "utf8");
    assert.match(text, /What did not pass/);
    await page.screenshot({ path: path.join(work, "no_script.png"), fullPage: true });
    assert.ok((text.match(/<svg class="plot/g) ?? []).length >= 5, "plain pictures of the charts");
    await page.close();
  },

  async "prints"(file) {
    const { page } = await opened(file);
    await walk_down(page);
    const pdf = await page.pdf({ path: path.join(work, "print.pdf"), landscape: true, printBackground: false });
    assert.ok(pdf.length > 20_000);
    await page.emulateMediaType("print");
    await page.screenshot({ path: path.join(work, "print.png"), fullPage: true });
    await page.close();
  },

  async "is below 3 MB"(file) {
    assert.ok(statSync(file).size < most_bytes, `${statSync(file).size} bytes`);
  },
};

let failed = 0;
async function run(name, test) {
  try {
    await test();
    console.log(`ok    ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAIL  ${name}\n${error.stack ?? error}`);
  }
}

try {
  rmSync(work, { recursive: true, force: true });
  mkdirSync(work, { recursive: true });
  const file = make_page(path.join(work, "run"), "errata:E3");
  for (const [name, test] of Object.entries(tests)) await run(name, () => test(file));
  await run("a scene called </script><script> is text and nothing else", async () => {
    const { file: scene, name } = hostile_scene();
    const hostile = make_page(path.join(work, "hostile"), scene);
    const { page, troubles } = await opened(hostile);
    await walk_down(page);
    assert.equal(await page.evaluate(() => window.hostile), undefined);
    assert.ok((await page.$eval("body", (b) => b.innerText)).includes(name));
    assert.deepEqual(troubles, []);
    await page.close();
  });
  await run("agreement is drawn with a table beside each chart, and the paper's tables and figures are there", async () => {
    const other = make_other_page(path.join(work, "other"));
    for (const [scheme, width, name] of [["light", 1280, "other"], ["dark", 390, "other_narrow"]]) {
      const { page, troubles } = await opened(other, { scheme, width });
      await walk_down(page);
      const charts = await page.evaluate(() => [...document.querySelectorAll("figure.chart")].map((c) => ({
        title: c.querySelector("figcaption").textContent, drawn: c.querySelector(".drawn svg path") !== null, cells: c.querySelectorAll("details td").length })));
      assert.deepEqual(charts.map((c) => c.title), ["Distance and depth, off by", "Normal, off by"]);
      for (const chart of charts) assert.ok(chart.drawn && chart.cells >= 8, JSON.stringify(chart));
      const name_width = await page.$eval("figure.chart details", (d) => { d.open = true; return d.querySelector("tbody th").getBoundingClientRect().width; });
      assert.ok(name_width > 60, `names of rows stand in ${name_width} pixels`);
      const paper = await page.evaluate(() => ({ tables: document.querySelectorAll("#paper table").length, figures: document.querySelectorAll("#paper figure svg").length,
        link: document.querySelector("nav a[href='#paper']") !== null }));
      assert.ok(paper.tables >= 4 && paper.figures >= 2 && paper.link, JSON.stringify(paper));
      assert.deepEqual(await serious_faults(page), [], `${scheme}, ${width} pixels wide`);
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.ok(overflow <= 0, `${overflow} pixels too wide at ${width}`);
      assert.deepEqual(troubles, []);
      await page.screenshot({ path: path.join(work, `${name}.png`), fullPage: true });
      await page.close();
    }
  });
} finally {
  await browser.close();
}
process.exitCode = failed ? 1 : 0;
