// Conveniences: everything on the page can be read and opened without this script.
"use strict";

const cards = () => document.querySelectorAll(".matrix details[open]");

// An open cell closes on Escape (and gets the focus back) or on a click elsewhere.
document.addEventListener("keydown", (event) => {
  if (event.key !== "Escape") return;
  for (const details of cards()) {
    const had_focus = details.contains(document.activeElement);
    details.open = false;
    if (had_focus) details.querySelector("summary").focus();
  }
});
document.addEventListener("click", (event) => {
  for (const details of cards()) if (!details.contains(event.target)) details.open = false;
});

// Keeps only one cell open, also in browsers that do not support named details, and keeps its card on the screen.
for (const details of document.querySelectorAll(".matrix details")) {
  details.addEventListener("toggle", () => {
    if (!details.open) return;
    for (const other of cards()) if (other !== details) other.open = false;
    const card = details.querySelector(".card");
    if (getComputedStyle(card).position !== "absolute") return;
    card.style.translate = "";
    const box = card.getBoundingClientRect();
    const margin = 8;
    const too_far_right = Math.max(0, box.right + margin - document.documentElement.clientWidth);
    const too_far_left = Math.max(0, margin - box.left);
    card.style.translate = `${too_far_left - too_far_right}px 0`;
    if (box.bottom > innerHeight) card.scrollIntoView({ block: "nearest" });
  });
}

// Arrow keys move over the matrix from cell to cell.
document.addEventListener("keydown", (event) => {
  const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[event.key];
  const place = event.target.closest?.(".matrix summary")?.closest("td");
  if (!step || !place) return;
  const row = place.parentElement;
  const rows = [...row.parentElement.children];
  for (let next = rows.indexOf(row) + step[0], column = place.cellIndex + step[1]; ; next += step[0], column += step[1]) {
    const cell = rows[next]?.children[column];
    if (!rows[next] || column < 0 || column >= row.children.length) return;
    const summary = cell?.querySelector("summary");
    if (!summary) continue;
    event.preventDefault();
    summary.focus();
    return;
  }
});

for (const item of document.querySelectorAll(".commands li")) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Copy";
  button.addEventListener("click", async () => {
    const text = item.querySelector("code").textContent;
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = "Copied";
    } catch {
      // A page opened from disk may not use the clipboard: then the text is selected for the reader's own copy key.
      getSelection().selectAllChildren(item.querySelector("code"));
      button.textContent = "Selected";
    }
    setTimeout(() => (button.textContent = "Copy"), 1500);
  });
  item.append(button);
}
