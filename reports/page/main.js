// Everything that the page does beyond being read.
import "./comfort.js";
import { draw_charts } from "./charts.js";
import { open_views } from "./view.js";

// Data lie in blocks of JSON that no browser runs; a block that is absent has nothing to show.
const block = (id) => JSON.parse(document.getElementById(id)?.textContent ?? "null");

document.documentElement.classList.add("scripted");
draw_charts(block("charts") ?? []);
open_views(block("playbacks") ?? []);
