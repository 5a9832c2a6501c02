// Starts everything on the page that needs a script.
import "./comfort.js";
import { draw_charts } from "./charts.js";
import { open_views } from "./view.js";

// Data are in blocks of JSON, which no browser runs; a part without a block shows nothing.
const block = (id) => JSON.parse(document.getElementById(id)?.textContent ?? "null");

document.documentElement.classList.add("scripted");
draw_charts(block("charts") ?? []);
open_views(block("playbacks") ?? []);
