// Drives the sheet of an object on a base in headless Chromium: its units leave one after the other along the normals of their
// panels, what closes it first. usage: node units.js KIT MOST_PAGES
"use strict";
const fs = require("node:fs");
const path = require("node:path");
const { CHANGED, SOFTWARE_GL, accessible, clear, difference, drawn, ends, fitsPhone, must, opened, pixels, report, shoot } = require("./common.js");
const { holdSheets } = require("./sheets.js");

const kit = process.argv[2];
const read = (file) => JSON.parse(fs.readFileSync(path.join(kit, file), "utf8"));
const [sheet, panels] = [read("checklist.json"), read("panels.json").panels];

// What comes together, in the order of the kit: units, then polyhedra across their planes, then what closes them. It leaves the
// other way round.
const [joins, pegs] = [sheet.joins ?? [], sheet.pins ?? []];
const within = (join, unit) => join.moving.includes(unit.polyhedron) && !unit.is_last;
const own = (unit) => ({ way: unit.way, moves: (other) => other === unit });
const coming = [
  ...sheet.units.filter((unit) => !unit.is_last).map(own),
  ...joins.map((join) => ({ way: join.way, moves: (unit) => within(join, unit) })),
  ...sheet.units.filter((unit) => unit.is_last).map(own),
];
const leaving = [...coming].reverse();

const set = (page, at) => page.$eval("#view-at", (slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}, at);
const found = (page) => page.evaluate(() => document.getElementById("view").places());
const ids = (unit) => [...unit.parts, ...(unit.panel ? [`panel ${unit.panel}`] : [])];
const along = (rows, way) => rows.reduce((sum, row, axis) => sum + row[3] * way[axis], 0);
const far = (rows) => Math.hypot(...rows.map((row) => row[3]));
const isUpright = (rows) => rows.every((row, i) => [0, 1, 2].every((j) => row[j] === (i === j ? 1 : 0)));

// At each half step all before it have gone their whole way, what leaves is on its own, and the others stand. A unit whose polyhedron
// left first goes on from there.
const leave = async (page) => {
  await set(page, 1);
  const places = async () => Object.fromEntries((await found(page)).map(({ name, rows }) => [name, rows]));
  const start = await places();
  const whole = far(start[sheet.units.filter((unit) => leaving[0].moves(unit)).flatMap(ids)[0]]);
  let [aside, wrong] = [0, []];
  for (let step = 0; step < leaving.length; step += 1) {
    await set(page, step + 0.5);
    const named = await places();
    for (const unit of sheet.units) {
      const gone = leaving.slice(0, step).filter((one) => one.moves(unit));
      const base = [0, 1, 2].map((axis) => gone.reduce((sum, one) => sum + whole * one.way[axis], 0));
      for (const id of ids(unit)) {
        const rows = named[id];
        const left = rows.map((row, axis) => row[3] - base[axis]);
        const { way } = leaving[step];
        const out = leaving[step].moves(unit) ? left.reduce((sum, value, axis) => sum + value * way[axis], 0) : 0;
        aside = Math.max(aside, Math.hypot(...left.map((value, axis) => value - out * way[axis])));
        const isOnWay = out > 0.1 * whole && out < 0.9 * whole;
        if (leaving[step].moves(unit) !== isOnWay || !isUpright(rows)) wrong.push(`${id} at ${step + 0.5}`);
      }
    }
  }
  must(wrong.length === 0, `${leaving.length} steps leave in order, what closes it first ${wrong.join("; ")}`);
  must(aside < 1e-3 && whole > 1, `each goes ${whole.toFixed(1)} mm along its way and ${aside.toExponential(1)} mm beside it`);
  const skew = sheet.units.filter((unit) => unit.panel).map((unit) => {
    const normal = panels[unit.panel - 1].axes[2];
    return Math.hypot(...unit.way.map((value, axis) => value - normal[axis]));
  });
  must(skew.length > 3 && Math.max(...skew) < 1e-9, `the ways are the normals of ${skew.length} panels`);
};

// When all is apart each pin stands on its part, and points at the part that left it along the pin.
const bench = async (page) => {
  await set(page, 1e9);
  const named = Object.fromEntries((await found(page)).map(({ name, rows }) => [name, rows]));
  const unitOf = (id) => sheet.units.findIndex((unit) => unit.parts.includes(id));
  const inside = pegs.filter(({ on, into }) => unitOf(on) === unitOf(into));
  const gap = ({ on, into, direction }) => along(named[into], direction) - along(named[on], direction);
  const wrong = inside.filter((pin) => gap(pin) < 2 * pin.length_mm).map(({ on, into }) => `${on} into ${into}`);
  must((inside.length > 1 || joins.length > 0) && wrong.length === 0, `${inside.length} pins point into the gap that they close ${wrong.join("; ")}`);
  const pins = Object.entries(named).filter(([name]) => name.startsWith("pin "));
  const loose = pins.filter(([name, rows]) => far(rows.map((row, axis) => [0, 0, 0, row[3] - named[name.split(" ")[3]][axis][3]])) > 1e-9);
  must(pins.length === pegs.length && loose.length === 0, `each of ${pins.length} pins stands on its part`);
};

const drive = async (page) => {
  const start = await pixels(page);
  must(drawn(start) > 0.02 && await clear(page, start), "the object is drawn, with room at every edge");
  must((await page.$$("#view-names span")).length === 0, "no unit is named while it is in its place");
  await shoot(page, "together");
  await page.focus("#view-at");
  await page.keyboard.press("End");
  const apart = await pixels(page);
  must(difference(start, apart) > CHANGED, "the slider takes it apart by the keyboard");
  await shoot(page, "apart");
  must((await page.$$("#view-names span")).length > 2, "names are written beside the units that are out");
  const boxes = await page.$$("input[data-bodies]");
  for (const box of boxes.slice(0, 2)) {
    const name = await box.evaluate((input) => input.parentElement.textContent.trim());
    await box.click();
    must(difference(apart, await pixels(page)) > CHANGED, `the ${name} can be hidden`);
    await shoot(page, `without-${name}`);
    await box.click();
  }
  must(difference(apart, await pixels(page)) === 0, "and comes back");
  await page.click("#view-reset");
  must(difference(start, await pixels(page)) === 0, "starting again is as at the start");
};

report(async () => {
  const [file, mostPages] = [path.join(kit, "job.html"), Number(process.argv[3])];
  const shown = await opened(file, SOFTWARE_GL);
  await drive(shown.page);
  await leave(shown.page);
  await bench(shown.page);
  await accessible(shown.page, "with the view");
  await fitsPhone(shown.page);
  await holdSheets(kit, sheet);
  await ends(shown, file, mostPages);
});
