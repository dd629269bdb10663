// The parts of a kit, taken apart along their cuts all at once.
{
  const data = JSON.parse(byId("view-data").textContent);
  const poses = (at) => data.motion.map((shift) => ({ ...STILL, to: shift.map((value) => value * at) }));
  const farthest = Math.max(0, ...data.motion.map((shift) => Math.hypot(...shift)));
  const stage = makeStage(data, poses, (at) => at * farthest);
  if (stage) {
    const explode = byId("view-explode");
    explode.addEventListener("input", () => stage.move(explode.value / 100));
    byId("view-reset").addEventListener("click", () => { explode.value = 0; stage.move(0); });
  }
}
