// Drives the sheet of a telescope's kit in headless Chromium: it plays all in, all out and all in, and its parts are where the keys
// of motion.json and the screws between them say. usage: node motion.js KIT MOST_PAGES
"use strict";
const fs = require("node:fs");
const path = require("node:path");
const { CHANGED, SOFTWARE_GL, accessible, clear, difference, drawn, ends, fitsPhone, must, ofCut, opened, pixels, report, shoot } = require("./common.js");
const { between, off, places, written } = require("./screws.js");

const LIMIT_MM = 0.05;
const SHARES = [0.25, 0.5, 0.75];
const kit = process.argv[2];
const read = (file) => JSON.parse(fs.readFileSync(path.join(kit, file), "utf8"));
const [motion, sheet] = [read("motion.json"), read("checklist.json")];
const last = motion.keys.length - 1;

const set = (page, at) => page.$eval("#view-at", (slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}, at);
const found = (page) => page.evaluate(() => document.getElementById("view").places());
const state = (page) => page.$eval("#view-state", (output) => output.textContent);

// The greatest distance of a part from where it is wanted, mm.
const worst = (all, wanted) => {
  const named = Object.fromEntries(all.map(({ name, rows }) => [name, rows]));
  return Math.max(...Object.entries(wanted).map(([name, rows]) => (named[name] ? off(named[name], rows) : Infinity)));
};

// The parts are at the keys, and on the screws between them; a straight line between keys is elsewhere.
const measure = async (page) => {
  let [atKeys, atScrews, straight] = [0, 0, 0];
  for (let key = 0; key <= last; key += 1) {
    await set(page, key);
    const all = await found(page);
    if (key === 0) must(all.length === Object.keys(places(motion, sheet, motion.keys[0].states)).length, `all ${all.length} parts are in the view`);
    atKeys = Math.max(atKeys, worst(all, written(sheet, motion.keys[key])), worst(all, places(motion, sheet, motion.keys[key].states)));
    if (key === last) break;
    const [from, to] = [motion.keys[key].states, motion.keys[key + 1].states];
    const ends = [from, to].map((states) => places(motion, sheet, states));
    for (const share of SHARES) {
      await set(page, key + share);
      const wanted = places(motion, sheet, between(from, to, share));
      const moving = await found(page);
      atScrews = Math.max(atScrews, worst(moving, wanted));
      const lines = Object.fromEntries(Object.keys(wanted).map((name) => [name, between(ends[0][name], ends[1][name], share)]));
      straight = Math.max(straight, worst(moving, lines));
    }
  }
  must(atKeys <= LIMIT_MM, `at ${last + 1} keys the parts are ${atKeys.toExponential(1)} mm off at most`);
  must(atScrews <= LIMIT_MM, `between keys they are ${atScrews.toExponential(1)} mm off the screws at most`);
  must(straight > 10 * LIMIT_MM, `and up to ${straight.toFixed(2)} mm off straight lines`);
};

// Plays from all in to all out and back, and looks at what is said and where the parts are when all is out.
const play = async (page) => {
  await page.evaluate(() => {
    const output = document.getElementById("view-state");
    window.heard = [];
    new MutationObserver(() => {
      window.heard.push(output.textContent);
      if (output.textContent === "All out") window.out = document.getElementById("view").places();
    }).observe(output, { childList: true, characterData: true, subtree: true });
  });
  const { states } = motion.keys[last];
  await page.focus("#view-play");
  await page.keyboard.press("Enter");
  must(await page.$eval("#view-play", (button) => button.textContent) === "Stop", "it plays, and can be stopped");
  await page.waitForFunction(() => window.heard.at(-1) === "All in", { timeout: 120000, polling: 100 });
  const [heard, out] = await page.evaluate(() => [window.heard, window.out]);
  const steps = await page.$$eval("button[data-to]", (all) => all.map((chip) => chip.textContent));
  const told = heard.filter((words) => words.startsWith("Step")).map((words) => words.split(": ")[1]);
  const wanted = [...steps, ...[...steps].reverse()];
  must(heard.indexOf("All out") > 0 && heard.at(-1) === "All in", "it plays all in, all out and all in");
  must(JSON.stringify(told) === JSON.stringify(wanted), `it opens in order, and closes the other way round: ${told.join(" ")}`);
  must(worst(out, places(motion, sheet, states)) <= LIMIT_MM, "all out it is where the last key is");
  must(worst(await found(page), places(motion, sheet, motion.keys[0].states)) <= LIMIT_MM, "and all in where the first is");
};

const drive = async (page) => {
  const start = await pixels(page);
  must(await state(page) === "All in" && drawn(start) > 0.002, "it begins all in, and stands still");
  await shoot(page, "collapsed");
  await page.focus("#view-at");
  await page.keyboard.press("End");
  const open = await pixels(page);
  must(await state(page) === "All out" && difference(start, open) > CHANGED, "the slider opens it by the keyboard");
  must(await clear(page, open), "all of it is seen, with room at every edge");
  await shoot(page, "extended");
  await page.click("#view-line");
  const bare = await pixels(page);
  must(difference(open, bare) > 0.0005, "the curve that was asked for is drawn, and can be hidden");
  await page.click("#view-line");
  must((await page.$$("#view-names span")).length > 1, "names are written beside the parts");
  await page.click("#view-named");
  await pixels(page);
  must((await page.$$("#view-names span")).length === 0, "and can be hidden");
  await page.click("#view-named");
  for (const box of await page.$$("input[data-bodies]")) {
    await box.click();
    must(difference(open, await pixels(page)) > 0.0005, `${await box.evaluate((input) => input.parentElement.textContent.trim())} can be hidden`);
    await box.click();
  }
  await page.select("#view-axis", "1");
  must(ofCut(await pixels(page)) > 0.0005, "it can be cut open");
  await set(page, last / 2);
  await shoot(page, "half");
  await page.click("#view-reset");
  must(difference(start, await pixels(page)) === 0, "starting again is as at the start");
};

// The buttons go from joint to joint.
const step = async (page) => {
  const ends = await page.$$eval("button[data-to]", (all) => all.map((chip) => Number(chip.dataset.to)));
  const at = () => page.$eval("#view-at", (slider) => Number(slider.value));
  const reach = (value) => page.waitForFunction((to) => Number(document.getElementById("view-at").value) === to
    && document.getElementById("view-play").textContent === "Play", { timeout: 60000 }, value);
  await page.click("#view-reset");
  await page.click("#view-on");
  await reach(ends[0]);
  must(await at() === ends[0], "Step on opens the first joint to its end");
  await page.click("button[data-to]");
  await page.click("#view-back");
  await reach(0);
  must(await at() === 0, "Step back closes it");
  await page.evaluate(() => [...document.querySelectorAll("button[data-to]")].at(-1).click());
  await reach(last);
  must(await page.evaluate(() => [...document.querySelectorAll("button[data-to]")].at(-1).getAttribute("aria-current") === null), "at the end no step is marked");
  await page.click("#view-reset");
};

// With less motion asked for, nothing runs: steps jump, and the slider works.
const calm = async (file) => {
  const { browser, page, trouble } = await opened(file, SOFTWARE_GL, [{ name: "prefers-reduced-motion", value: "reduce" }]);
  must(await page.$eval("#view-play", (button) => button.hidden), "with less motion there is no Play");
  const [after, end] = await page.evaluate(() => {
    document.getElementById("view-on").click();
    return [Number(document.getElementById("view-at").value), Number(document.querySelector("button[data-to]").dataset.to)];
  });
  must(after === end, "a step jumps");
  await set(page, 0.5);
  const wanted = places(motion, sheet, between(motion.keys[0].states, motion.keys[1].states, 0.5));
  must(worst(await found(page), wanted) <= LIMIT_MM, "and the slider works");
  await accessible(page, "with less motion");
  must(trouble.length === 0, `no error and no request ${trouble.join("; ")}`);
  await browser.close();
};

report(async () => {
  const [file, mostPages] = [path.join(kit, "job.html"), Number(process.argv[3])];
  const shown = await opened(file, SOFTWARE_GL);
  await drive(shown.page);
  await measure(shown.page);
  await step(shown.page);
  await play(shown.page);
  await accessible(shown.page, "with the view");
  await fitsPhone(shown.page);
  await set(shown.page, last);
  await ends(shown, file, mostPages);
  await calm(file);
});
