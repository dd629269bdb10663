// What all checks of a sheet in headless Chromium share. CHROMIUM=path, TOOLS=folder with puppeteer-core and axe-core; SHOTS=folder
// keeps pictures of the page for people to look at.
"use strict";
const { createRequire } = require("node:module");
const path = require("node:path");
const { pathToFileURL } = require("node:url");
const tools = createRequire(path.join(process.env.TOOLS, "package.json"));
const puppeteer = tools("puppeteer-core");
const axe = require("node:fs").readFileSync(tools.resolve("axe-core/axe.min.js"), "utf8");

const SOFTWARE_GL = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
// A control that does something moves this share of the pixels; noise moves none.
const CHANGED = 0.01;
const faults = [];
const must = (holds, claim) => {
  console.log(`${holds ? "ok   " : "WRONG"} ${claim}`);
  if (!holds) faults.push(claim);
};

// The page in a browser of its own, with what went wrong in it.
const opened = async (file, options, features = []) => {
  const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM, headless: true, args: ["--no-sandbox", ...options] });
  const page = await browser.newPage();
  const trouble = [];
  await page.setViewport({ width: 1100, height: 1200 });
  await page.setOfflineMode(true);
  await page.emulateMediaFeatures(features);
  page.on("pageerror", (error) => trouble.push(String(error)));
  page.on("console", (message) => { if (message.type() === "error") trouble.push(message.text()); });
  page.on("request", (request) => { if (!/^(file|data):/.test(request.url())) trouble.push(`asked for ${request.url()}`); });
  await page.goto(pathToFileURL(path.resolve(file)).href, { waitUntil: "load" });
  return { browser, page, trouble };
};

// The pixels of the view after the next frame.
const pixels = (page) => page.evaluate(() => new Promise((resolve) => {
  requestAnimationFrame(() => requestAnimationFrame(() => {
    const canvas = document.getElementById("view-canvas");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    resolve(Array.from(context.getImageData(0, 0, copy.width, copy.height).data));
  }));
}));
const share = (data, test) => {
  let count = 0;
  for (let at = 0; at < data.length; at += 4) count += test(at) ? 1 : 0;
  return count / (data.length / 4);
};
const difference = (a, b) => share(a, (at) => [0, 1, 2].some((channel) => Math.abs(a[at + channel] - b[at + channel]) > 8));
const ofCut = (data) => share(data, (at) => Math.abs(data[at] - 213) < 6 && Math.abs(data[at + 1] - 94) < 6 && data[at + 2] < 6);
const drawn = (data) => share(data, (at) => data[at] + data[at + 1] + data[at + 2] < 740);

// Whether the outermost pixels of the view are paper.
const clear = async (page, data) => {
  const [width, height] = await page.$eval("#view-canvas", (canvas) => [canvas.width, canvas.height]);
  const isPaper = (x, y) => data[4 * (y * width + x)] + data[4 * (y * width + x) + 1] + data[4 * (y * width + x) + 2] > 740;
  const across = Array.from({ length: width }, (_, x) => isPaper(x, 0) && isPaper(x, height - 1));
  const down = Array.from({ length: height }, (_, y) => isPaper(0, y) && isPaper(width - 1, y));
  return across.concat(down).every(Boolean);
};

// Nothing is wider than a phone.
const fitsPhone = async (page) => {
  await page.setViewport({ width: 390, height: 800 });
  const wide = await page.$$eval("table, figure, svg, p, li, h1, h2, button, fieldset", (all) => all
    .filter((one) => one.getBoundingClientRect().right > window.innerWidth + 1 || one.scrollWidth > one.clientWidth + 1 && one.tagName === "TABLE")
    .map((one) => `${one.tagName} ${one.textContent.slice(0, 40)}`));
  must(wide.length === 0, `on a phone nothing needs sideways scrolling ${wide.join("; ")}`);
};

// The pages that the sheet takes on paper.
const pagesOn = async (page, format) => {
  const pdf = Buffer.from(await page.pdf({ format, preferCSSPageSize: false, printBackground: true })).toString("latin1");
  return (pdf.match(/\/Type\s*\/Page\b/g) || []).length;
};

const presses = async (page, id, key, times) => {
  await page.focus(id);
  for (let time = 0; time < times; time += 1) await page.keyboard.press(key);
};

const accessible = async (page, how) => {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  for (const violation of violations) console.log(`      ${violation.id}: ${violation.help}: ${violation.nodes.map((node) => node.html.slice(0, 160)).join(" | ")}`);
  must(violations.length === 0, `axe finds nothing, ${how}`);
};

// On paper the pictures stand in for the view.
const onPaper = async (page, mostPages) => {
  await page.emulateMediaType("print");
  await accessible(page, "on paper");
  must(await page.$eval("#view", (view) => view.getBoundingClientRect().height === 0), "on paper there is no view");
  for (const format of ["A4", "Letter"]) {
    const pages = await pagesOn(page, format);
    must(pages > 0 && pages <= mostPages, `on ${format} it takes ${pages} pages, at most ${mostPages}`);
  }
};

// Without WebGL the pictures stand in for the view, and all of it is on a phone.
const withoutView = async (file) => {
  const plain = await opened(file, ["--disable-gpu", "--disable-3d-apis"]);
  must(await plain.page.$eval("#view", (view) => view.hidden), "without WebGL the view stays away");
  must(await plain.page.$$eval("figure img, figure svg", (all) => all.every((one) => one.getBoundingClientRect().width > 100)), "and the pictures are there");
  await accessible(plain.page, "without the view");
  await fitsPhone(plain.page);
  must(plain.trouble.length === 0, `no error and no request ${plain.trouble.join("; ")}`);
  await plain.browser.close();
};

// Keeps a picture of the view with its controls for people to look at.
const shoot = async (page, name) => {
  if (!process.env.SHOTS) return;
  const view = await page.$("#view");
  await view.screenshot({ path: path.join(process.env.SHOTS, `${name}.png`) });
};

// Looks at the sheet on a phone and on paper, ends the browser, and opens the sheet without WebGL.
const ends = async (shown, file, mostPages) => {
  await pixels(shown.page);
  await shoot(shown.page, "phone");
  await shown.page.setViewport({ width: 1100, height: 1200 });
  await onPaper(shown.page, mostPages);
  must(shown.trouble.length === 0, `no error and no request ${shown.trouble.join("; ")}`);
  await shown.browser.close();
  await withoutView(file);
};

// Runs a check to its end, and tells by the exit code whether all of it holds.
const report = (check) => check()
  .then(() => process.exit(faults.length === 0 ? 0 : 1))
  .catch((error) => { console.error(error); process.exit(2); });

module.exports = {
  CHANGED, SOFTWARE_GL, accessible, clear, difference, drawn, ends, fitsPhone, must, ofCut, onPaper, opened, pixels, presses, report, shoot, withoutView,
};
