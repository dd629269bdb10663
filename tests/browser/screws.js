// Where the bodies of a telescope's kit are, from its motion.json alone, by matrix exponentials: nothing of the page and nothing of
// the program. A matrix is four rows of four numbers.
"use strict";
const unit = () => [0, 1, 2, 3].map((row) => [0, 1, 2, 3].map((column) => (row === column ? 1 : 0)));
const times = (a, b) => a.map((row) => [0, 1, 2, 3].map((column) => row.reduce((sum, value, k) => sum + value * b[k][column], 0)));
const scaled = (a, by) => a.map((row) => row.map((value) => value * by));
const plus = (a, b) => a.map((row, i) => row.map((value, j) => value + b[i][j]));

// The exponential of a twist, by halving it until its series is short.
const exponential = (twist) => {
  const norm = Math.max(...twist.flat().map(Math.abs));
  const halvings = Math.max(0, Math.ceil(Math.log2(norm + 1)) + 4);
  const small = scaled(twist, 2 ** -halvings);
  let [sum, term] = [unit(), unit()];
  for (let order = 1; order < 20; order += 1) {
    term = scaled(times(term, small), 1 / order);
    sum = plus(sum, term);
  }
  for (let halving = 0; halving < halvings; halving += 1) sum = times(sum, sum);
  return sum;
};
const along = ({ curvature, torsion }, arc) => exponential(scaled([[0, -curvature, 0, 1], [curvature, 0, -torsion, 0], [0, torsion, 0, 0], [0, 0, 0, 0]], arc));
const roll = (angle) => exponential(scaled([[0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 0]], angle));
const inverse = (a) => [0, 1, 2].map((row) => {
  const across = [a[0][row], a[1][row], a[2][row]];
  return [...across, -across.reduce((sum, value, k) => sum + value * a[k][3], 0)];
}).concat([[0, 0, 0, 1]]);

const chain = (motion, states) => {
  const frames = [motion.root];
  states.forEach(([slide, turn], joint) => {
    const [outer, inner] = [motion.shells[joint], motion.shells[joint + 1]];
    const step = times(times(along(outer, outer.length_mm), roll(turn)), along(inner, slide - inner.length_mm));
    frames.push(times(frames[joint], step));
  });
  return frames;
};

// Slides and turns at a share of the way between two keys.
const between = (from, to, share) => from.map((value, i) => (Array.isArray(value) ? between(value, to[i], share) : value + (to[i] - value) * share));

// The place of every part in a state, by its id. `sheet` is checklist.json.
const places = (motion, sheet, states) => {
  const found = {};
  if (!motion.limbs) {
    const frames = chain(motion, states);
    for (const part of sheet.parts) found[part.id] = frames[part.shell - 1];
    return found;
  }
  const junctures = sheet.junctures.map(unit);
  sheet.limbs.forEach((limb, index) => {
    const own = motion.limbs[index];
    const base = junctures[limb.from - 1];
    const frames = chain(own, states[index]);
    const out = chain(own, own.joints.map((joint) => [joint.open_mm, joint.turn_rad]));
    const last = frames.length - 1;
    junctures[limb.to - 1] = times(base, times(frames[last], inverse(out[last])));
    for (const part of limb.sheet.parts) found[part.id] = times(base, frames[part.shell - 1]);
  });
  sheet.junctures.forEach((own, index) => { for (const part of own.parts) found[part.id] = junctures[index]; });
  return found;
};

// The places that a key writes down itself.
const written = (sheet, key) => {
  const all = {};
  if (key.placements) for (const part of sheet.parts) all[part.id] = key.placements[part.shell - 1];
  if (key.junctures) sheet.junctures.forEach((own, index) => { for (const part of own.parts) all[part.id] = key.junctures[index]; });
  return all;
};

// How far a body is off, mm: its origin, and points half a decimetre from it along its axes.
const REACH = 50;
const off = (rows, wanted) => Math.max(...[[0, 0, 0], [REACH, 0, 0], [0, REACH, 0], [0, 0, REACH]].map((p) => Math.hypot(...[0, 1, 2].map((row) => {
  const at = (matrix) => matrix[row][3] + p.reduce((sum, value, k) => sum + value * matrix[row][k], 0);
  return at(rows) - at(wanted);
}))));

module.exports = { between, off, places, written };
