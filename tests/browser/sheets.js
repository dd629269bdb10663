// Measures the drawings of the sheets of a base in headless Chromium: size on paper, lengths of the beam's paths, extents and rings,
// each as the checklist and the DXF of the same sheet have them. Used by units.js.
"use strict";
const fs = require("node:fs");
const path = require("node:path");
const { must, opened } = require("./common.js");

const NEAR_MM = 1e-3;
const PX_PER_MM = 96 / 25.4;

// What the browser makes of a drawing, in mm of its viewBox.
const measured = (page) => page.evaluate(() => {
  const root = document.documentElement;
  const box = root.viewBox.baseVal;
  const shapes = (layer) => [...root.querySelectorAll(`#${layer} > *`)];
  // Chromium lays a few chords on a small circle, some 8 % short: that of its box is taken.
  const along = (shape) => shape.tagName === "circle" ? Math.PI * shape.getBBox().width : shape.getTotalLength();
  const lengths = (layer) => shapes(layer).map(along);
  const bounds = (shape) => { const { x, y, width, height } = shape.getBBox(); return [x, y, x + width, y + height]; };
  const same = (a, b) => a.every((value, at) => Math.abs(value - b[at]) < 1e-3);
  const cut = [...shapes("CUT_INNER"), ...shapes("CUT_OUTER")];
  const boxes = cut.map(bounds);
  return {
    paper: [root.width.baseVal.value, root.height.baseVal.value],
    view: [box.x, box.y, box.width, box.height],
    cut: [...lengths("CUT_INNER"), ...lengths("CUT_OUTER")],
    engraved: lengths("ENGRAVE"),
    open: cut.filter((shape) => !["polygon", "circle"].includes(shape.tagName)).length,
    outside: boxes.filter(([x, y, right, low]) => x < 0 || y < 0 || right > box.width || low > box.height).length,
    twice: boxes.filter((one, at) => boxes.slice(0, at).some((other) => same(one, other))).length,
    filled: [...root.querySelectorAll("*")].filter((shape) => shape.getTotalLength && getComputedStyle(shape).fill !== "none").length,
    moved: root.querySelectorAll("[transform]").length,
    outer: shapes("CUT_OUTER").map(bounds),
  };
});

// The extents of the closed lines that the DXF of a sheet has on a layer, its y upward.
const dxfBoxes = (file, layer, height) => {
  const lines = fs.readFileSync(file, "utf8").split(/\r?\n/).map((line) => line.trim());
  const pairs = Array.from({ length: Math.floor(lines.length / 2) }, (_, at) => [Number(lines[2 * at]), lines[2 * at + 1]]);
  const shapes = [];
  for (const [code, value] of pairs) {
    if (code === 0) shapes.push({ kind: value, x: [], y: [] });
    const shape = shapes[shapes.length - 1];
    if (!shape) continue;
    if (code === 8) shape.layer = value;
    if (code === 10) shape.x.push(Number(value));
    if (code === 20) shape.y.push(height - Number(value));
  }
  const own = shapes.filter((shape) => shape.kind === "LWPOLYLINE" && shape.layer === layer);
  return own.map(({ x, y }) => [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)]);
};

const sum = (values) => values.reduce((all, value) => all + value, 0);
const sorted = (boxes) => [...boxes].sort((a, b) => a[0] - b[0] || a[1] - b[1]);

// Holds one sheet.
const holdSheet = async (kit, sheet, row) => {
  const { browser, page, trouble } = await opened(path.join(kit, sheet.svg), []);
  const seen = await measured(page);
  await browser.close();
  const [width, height] = sheet.size_mm;
  const off = Math.max(...[width, height].map((size, axis) => Math.abs(seen.paper[axis] / PX_PER_MM - size)));
  must(off < NEAR_MM && seen.view.join() === [0, 0, width, height].join(), `${sheet.svg} is ${width} × ${height} mm on paper, one unit a mm`);
  const [cut, engraved] = [sum(seen.cut), sum(seen.engraved)];
  const near = (found, promised) => Math.abs(found - promised) < 1e-5 * promised + NEAR_MM;
  must(near(cut, row.cut_mm) && near(engraved, row.engraved_mm), `its paths measure ${cut.toFixed(2)} mm of cuts and ${engraved.toFixed(2)} mm engraved`);
  must(seen.open + seen.outside + seen.twice + seen.filled + seen.moved === 0, `its ${seen.cut.length} cuts are closed, on the sheet, once, without fill or transform`);
  const [ours, theirs] = [sorted(seen.outer), sorted(dxfBoxes(path.join(kit, sheet.dxf), "CUT_OUTER", height))];
  const apart = Math.max(...ours.flatMap((box, at) => box.map((value, side) => Math.abs(value - theirs[at][side]))));
  must(ours.length === sheet.panels.length && ours.length === theirs.length && apart < NEAR_MM, `its ${ours.length} outlines lie as in the DXF within ${apart.toExponential(1)} mm`);
  must(trouble.length === 0, `it asks for nothing ${trouble.join("; ")}`);
};

// Holds all sheets of a kit.
exports.holdSheets = async (kit, checklist) => {
  for (const [at, sheet] of checklist.cut_sheets.entries()) await holdSheet(kit, sheet, checklist.sheet_rows[at]);
};
