// A slider from step to step, with buttons; it plays unless the system asks for less motion.

// `words` are those of the ends, `figures(at)` says more of a state. A pose is at -1, -2 and so on.
const makePlayer = (stage, data, { words, figures, poses = [] }) => {
  const MOVE_MS = 900;
  const slider = byId("view-at");
  const play = byId("view-play");
  const state = byId("view-state");
  const more = byId("view-figures");
  const chips = [...document.querySelectorAll("button[data-to]")];
  const poseChips = [...document.querySelectorAll("button[data-pose]")];
  const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
  const end = Number(slider.max);
  let at = 0;
  let goals = [];
  let before = null;

  const say = (element, text) => { if (element.textContent !== text) element.textContent = text; };
  const show = () => {
    slider.value = at;
    stage.move(at);
    const step = data.steps.findIndex(({ to }) => at <= to);
    const told = at < 0 ? `Pose ${poses[-1 - at]}` : at <= 0 ? words[0] : at >= end ? words[1] : `Step ${step + 1} of ${data.steps.length}: ${data.steps[step].name}`;
    const now = figures(at);
    say(state, told);
    say(more, now);
    slider.setAttribute("aria-valuetext", now ? `${told}. ${now}` : told);
    chips.forEach((chip, index) => {
      if (at > 0 && at < end && index === step) chip.setAttribute("aria-current", "step");
      else chip.removeAttribute("aria-current");
    });
    poseChips.forEach((chip, index) => {
      if (at === -1 - index) chip.setAttribute("aria-current", "step");
      else chip.removeAttribute("aria-current");
    });
    say(play, goals.length > 0 ? "Stop" : "Play");
  };
  const run = (now) => {
    if (goals.length === 0) return;
    // A slow machine shows fewer states in more time, but leaves none out.
    const way = before === null ? 0 : Math.min((now - before) / MOVE_MS, 0.25);
    before = now;
    const left = goals[0] - at;
    if (Math.abs(left) > way) at += Math.sign(left) * way;
    else at = goals.shift();
    show();
    if (goals.length > 0) requestAnimationFrame(run);
  };
  // Goes to these values one after the other; at once where less motion is asked for.
  const go = (...to) => {
    const isRunning = goals.length > 0;
    at = Math.max(at, 0);
    goals = calm.matches ? [] : to;
    if (goals.length === 0 && to.length > 0) at = to[to.length - 1];
    show();
    if (goals.length === 0 || isRunning) return;
    before = null;
    requestAnimationFrame(run);
  };

  const EPSILON = 1e-6;
  const ends = data.steps.map(({ to }) => to);
  slider.addEventListener("input", () => { goals = []; at = Number(slider.value); show(); });
  play.addEventListener("click", () => {
    if (goals.length > 0) go();
    else if (at >= end) go(0);
    else go(end, 0);
  });
  byId("view-on").addEventListener("click", () => go(ends.find((to) => to > at + EPSILON) ?? end));
  byId("view-back").addEventListener("click", () => go([0, ...ends].filter((to) => to < at - EPSILON).pop() ?? 0));
  for (const chip of chips) chip.addEventListener("click", () => go(Number(chip.dataset.to)));
  poseChips.forEach((chip, index) => chip.addEventListener("click", () => { goals = []; at = -1 - index; show(); }));
  byId("view-reset").addEventListener("click", () => { goals = []; at = 0; show(); });
  const hush = () => { play.hidden = calm.matches; if (calm.matches) go(); };
  calm.addEventListener("change", hush);
  hush();
  show();
};
