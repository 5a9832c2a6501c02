// Charts from their specifications (reports/chart.hpp). Only what is used of ECharts is bundled.
import { BarChart, CustomChart, LineChart, ScatterChart } from "echarts/charts";
import {
  AriaComponent, DataZoomComponent, GridComponent, LegendComponent, MarkLineComponent, TooltipComponent,
} from "echarts/components";
import * as echarts from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { css_color, on_scheme_change, reduced_motion } from "./colors.js";

echarts.use([
  AriaComponent, BarChart, CustomChart, DataZoomComponent, GridComponent, LegendComponent, LineChart, MarkLineComponent,
  ScatterChart, SVGRenderer, TooltipComponent,
]);

const palette = () => [...Array(8).keys()].map((k) => css_color(`--s${k}`));
// Lines and points differ by shape as well as by color.
const symbols = ["circle", "rect", "triangle", "diamond", "pin", "arrow", "roundRect", "emptyCircle"];
const dashes = ["solid", "dashed", "dotted", [8, 3, 2, 3], [12, 4], [2, 2], [6, 2, 2, 2, 2, 2], [1, 4]];

const number = (value) => (value === null || value === undefined ? "none" : Number(value.toPrecision(4)).toString());

function axis(spec, is_x) {
  const common = {
    name: spec.unit ? `${spec.name}, ${spec.unit}` : spec.name,
    nameLocation: "middle",
    nameGap: is_x ? 28 : 56,
    nameTextStyle: { color: css_color("--soft") },
    axisLabel: { color: css_color("--soft"), hideOverlap: true },
    axisLine: { lineStyle: { color: css_color("--faint") } },
    splitLine: { show: !is_x || !spec.categories, lineStyle: { color: css_color("--line") } },
  };
  if (spec.categories) {
    return {
      ...common, type: "category", data: spec.categories, inverse: !is_x,
      axisLabel: { ...common.axisLabel, width: is_x ? undefined : 190, overflow: "truncate", hideOverlap: false },
      name: is_x ? common.name : "",
    };
  }
  return { ...common, type: spec.log ? "log" : "value", scale: !spec.from_zero };
}

const points = (s, ys) => ys.map((y, k) => [s.x[k], y]);

// A band is two stacked lines, the lower one invisible. Of one name with its line, so that the legend hides both.
function band(s, color, k) {
  const edge = { type: "line", stack: `band-${k}`, symbol: "none", silent: true, lineStyle: { opacity: 0 }, name: s.name, is_aside: true };
  return [
    { ...edge, data: points(s, s.low) },
    { ...edge, data: points(s, s.high.map((h, j) => h - s.low[j])), areaStyle: { color, opacity: 0.18 } },
  ];
}

// Whiskers of intervals: horizontal where the places are categories down the side, otherwise vertical.
function whiskers(s, color, is_down) {
  const along = (v, j) => (is_down ? [v, s.y[j]] : [s.x[j], v]);
  return {
    type: "custom", name: s.name, is_aside: true, silent: true, z: 3,
    data: s.low.map((low, j) => [...along(low, j), ...along(s.high[j], j)]),
    encode: { x: [0, 2], y: [1, 3] },
    renderItem: (_, api) => {
      const from = api.coord([api.value(0), api.value(1)]);
      const to = api.coord([api.value(2), api.value(3)]);
      const style = { stroke: color, lineWidth: 2, fill: "none" };
      const cap = (at) => (is_down
        ? { x1: at[0], y1: at[1] - 5, x2: at[0], y2: at[1] + 5 }
        : { x1: at[0] - 5, y1: at[1], x2: at[0] + 5, y2: at[1] });
      return {
        type: "group",
        children: [{ x1: from[0], y1: from[1], x2: to[0], y2: to[1] }, cap(from), cap(to)].map((shape) => ({ type: "line", shape, style })),
      };
    },
  };
}

function marks(spec) {
  if (!spec.marks?.length) return undefined;
  return {
    symbol: "none", silent: true,
    lineStyle: { color: css_color("--ink"), type: "dashed", width: 1 },
    label: { formatter: (p) => p.name, color: css_color("--soft"), position: "insideEndTop", backgroundColor: css_color("--paper"), padding: [1, 3] },
    data: spec.marks.map((m) => (m.y !== undefined ? { name: m.text, yAxis: m.y } : { name: m.text, xAxis: m.x })),
  };
}

function series_of(spec, s, k) {
  const color = css_color(`--s${k % 8}`);
  const is_down = Boolean(spec.y.categories);
  const main = {
    name: s.name, itemStyle: { color }, color,
    markLine: k === 0 ? marks(spec) : undefined,
    emphasis: { focus: "series" },
  };
  if (s.kind === "bar") {
    return [{ ...main, type: "bar", stack: s.stack || undefined, data: is_down ? s.x.map((x, j) => [x, s.y[j]]) : points(s, s.y), barMaxWidth: 26 }];
  }
  if (s.kind === "area") {
    return [{ ...main, type: "line", stack: "area", symbol: "none", lineStyle: { width: 0.5 }, areaStyle: { opacity: 0.85 }, data: points(s, s.y) }];
  }
  if (s.kind === "points") {
    const own = [{ ...main, type: "scatter", symbol: symbols[k % 8], symbolSize: 9, data: points(s, s.y), z: 4 }];
    return s.low ? [...own, whiskers(s, color, is_down)] : own;
  }
  const line = {
    ...main, type: "line", data: points(s, s.y), showSymbol: s.y.length <= 40, symbol: symbols[k % 8], symbolSize: 6,
    lineStyle: { width: 1.8, type: dashes[k % 8] }, connectNulls: false, z: 3,
  };
  return s.low ? [line, ...band(s, color, k)] : [line];
}

function tooltip(spec, series) {
  const unit = spec.y.categories ? spec.x.unit : spec.y.unit;
  return {
    trigger: spec.y.categories ? "item" : "axis", confine: true,
    backgroundColor: css_color("--paper"), borderColor: css_color("--line"), textStyle: { color: css_color("--ink"), fontSize: 12 },
    // Plain text only, because names come from outside.
    renderMode: "richText",
    formatter: (given) => {
      const items = (Array.isArray(given) ? given : [given]).filter((p) => !series[p.seriesIndex].is_aside);
      if (!items.length) return "";
      const at = spec.y.categories ? spec.y.categories[items[0].value[1]] ?? items[0].value[1]
        : spec.x.categories ? items[0].name : `${spec.x.name} ${number(items[0].value[0])}`;
      const lines = items.map((p) => `${p.seriesName}: ${number(spec.y.categories ? p.value[0] : p.value[1])}${unit ? ` ${unit}` : ""}`);
      return [at, ...lines].join("\n");
    },
  };
}

function option(spec) {
  const series = spec.series.flatMap((s, k) => series_of(spec, s, k));
  return {
    aria: { enabled: true, label: { description: spec.description }, decal: { show: spec.series.some((s) => s.kind === "bar" || s.kind === "area") && spec.series.length > 1 } },
    animation: !reduced_motion() && spec.series.every((s) => s.x.length < 500),
    color: palette(),
    textStyle: { fontFamily: getComputedStyle(document.body).fontFamily },
    grid: { left: spec.y.categories ? 200 : 74, right: 24, top: spec.series.length > 1 ? 44 : 18, bottom: spec.zoom ? 78 : 48, containLabel: false },
    legend: spec.series.length > 1 ? { type: "scroll", top: 4, data: spec.series.map((s) => s.name), textStyle: { color: css_color("--ink") }, pageTextStyle: { color: css_color("--soft") } } : undefined,
    tooltip: tooltip(spec, series),
    dataZoom: spec.zoom ? [{ type: "slider", height: 18, bottom: 8, borderColor: css_color("--line"), textStyle: { color: css_color("--soft") } }] : undefined,
    xAxis: axis(spec.x, true), yAxis: axis(spec.y, false), series,
  };
}

export function draw_charts(specs) {
  const drawn = new Map();
  const draw = (place) => {
    const spec = specs[Number(place.dataset.chart)];
    if (!spec || drawn.has(place)) return;
    // Hides the plain picture; with scripts off it stays.
    place.replaceChildren();
    place.classList.add("drawn");
    // Bars side by side need a row each; points share a row.
    const bars = spec.series.filter((one) => one.kind === "bar").length;
    if (spec.y.categories) place.style.height = `${100 + Math.max(34, 12 * bars + 12) * spec.y.categories.length}px`;
    const chart = echarts.init(place, null, { renderer: "svg" });
    chart.setOption(option(spec));
    place.setAttribute("role", "img");
    place.setAttribute("aria-label", spec.description);
    drawn.set(place, { chart, spec });
  };
  const places = document.querySelectorAll("[data-chart]");
  // One after the other, so that the page stays responsive while it draws.
  const draw_next = (k) => {
    if (k >= places.length) return;
    draw(places[k]);
    setTimeout(draw_next, 0, k + 1);
  };
  draw_next(0);
  new ResizeObserver(() => { for (const { chart } of drawn.values()) chart.resize(); }).observe(document.body);
  on_scheme_change(() => { for (const { chart, spec } of drawn.values()) chart.setOption(option(spec), true); });
  addEventListener("beforeprint", () => {
    for (const place of places) draw(place);
    for (const { chart } of drawn.values()) chart.resize();
  });
}
