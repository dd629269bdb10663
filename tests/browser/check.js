// Drives a job sheet in headless Chromium with the network off: no rule of axe broken, no request, no error, and the view does
// what its controls say. usage: node check.js JOB.html MOST_PAGES
"use strict";
const { CHANGED, SOFTWARE_GL, accessible, clear, difference, drawn, must, ofCut, onPaper, opened, pixels, presses, report, withoutView } = require("./common.js");

const drive = async (page) => {
  const start = await pixels(page);
  must(drawn(start) > 0.02, "the assembly is drawn");
  must(ofCut(start) === 0, "nothing is cut at first");
  must(await clear(page, start), "all of it is seen, with room at every edge");
  await presses(page, "#view-explode", "ArrowRight", 60);
  const apart = await pixels(page);
  must(difference(start, apart) > CHANGED, "the slider takes it apart");
  await page.select("#view-axis", "0");
  const cut = await pixels(page);
  must(ofCut(cut) > 0.001 && difference(apart, cut) > CHANGED, "the section plane cuts it open");
  await presses(page, "#view-section", "ArrowLeft", 40);
  must(difference(cut, await pixels(page)) > CHANGED, "the section plane moves");
  await page.click("#view-reset");
  must(difference(start, await pixels(page)) === 0, "starting again is as at the start");
  await presses(page, "#view-canvas", "ArrowRight", 5);
  const turned = await pixels(page);
  must(difference(start, turned) > CHANGED, "the arrow keys turn it");
  const box = await (await page.$("#view-canvas")).boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.4 * box.height, { steps: 4 });
  await page.mouse.up();
  const dragged = await pixels(page);
  must(difference(turned, dragged) > CHANGED, "the mouse turns it");
  // Apart, no part hides behind another.
  await presses(page, "#view-explode", "ArrowRight", 100);
  const all = await pixels(page);
  const without = [];
  for (const box of await page.$$("input[data-bodies]")) {
    await box.click();
    without.push(difference(all, await pixels(page)));
    await box.click();
  }
  must(Math.max(...without) > CHANGED, "a part can be taken out of sight");
  must(difference(all, await pixels(page)) === 0, "and all of them come back");
};

report(async () => {
  const [file, mostPages] = [process.argv[2], Number(process.argv[3] || 8)];
  const shown = await opened(file, SOFTWARE_GL);
  await drive(shown.page);
  await accessible(shown.page, "with the view");
  await onPaper(shown.page, mostPages);
  must(shown.trouble.length === 0, `no error and no request ${shown.trouble.join("; ")}`);
  await shown.browser.close();
  await withoutView(file);
});
