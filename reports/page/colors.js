// The page's colors in the color scheme that is active.
export const css_color = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export const on_scheme_change = (redraw) => {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
};

export const reduced_motion = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
