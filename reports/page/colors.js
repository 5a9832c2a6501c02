// The page's own colors, as the scheme that is in force has them.
export const css_color = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export const on_scheme_change = (redraw) => {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
};

export const reduced_motion = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
