// Telescopes: each shell slides along its own helix, then turns about its tangent.
{
  const data = JSON.parse(byId("view-data").textContent);
  const { limbs, junctures, bodies, keys, poses: named } = data.motion;

  // The turn about an axis, as long as the angle (Rodrigues).
  const spin = (axis) => {
    const angle = Math.hypot(...axis);
    if (angle < 1e-15) return STILL.turn;
    const [x, y, z] = axis.map((value) => value / angle);
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    const t = 1 - c;
    return [t * x * x + c, t * x * y + s * z, t * x * z - s * y, t * x * y - s * z, t * y * y + c, t * y * z + s * x,
      t * x * z + s * y, t * y * z - s * x, t * z * z + c];
  };
  // The screw that takes a shell along its helix: about the axis of the helix, as Chasles has it.
  const along = ([curvature, torsion], arc) => {
    const rate = [torsion, 0, curvature];
    const square = torsion * torsion + curvature * curvature;
    if (square < 1e-24) return { ...STILL, to: [arc, 0, 0] };
    const turn = spin(rate.map((value) => value * arc));
    const axis = [0, curvature / square, 0];
    const around = turned(turn, axis);
    return { turn, to: axis.map((value, row) => value - around[row] + rate[row] * (torsion / square) * arc) };
  };
  const step = (outer, inner, [slide, turn]) => {
    const pivot = after(along(outer, outer[2]), { ...STILL, turn: spin([turn, 0, 0]) });
    return after(pivot, along(inner, slide - inner[2]));
  };
  const chain = ({ root, shells }, states) => {
    let frame = { turn: [0, 1, 2].flatMap((column) => [0, 1, 2].map((row) => root[row][column])), to: [0, 1, 2].map((row) => root[row][3]) };
    const frames = [frame];
    states.forEach((state, joint) => {
      frame = after(frame, step(shells[joint], shells[joint + 1], state));
      frames.push(frame);
    });
    return frames;
  };
  for (const limb of limbs) limb.out = back(chain(limb, limb.joints.map(({ open, turn }) => [open, turn])).pop());

  // The states of all joints for a value of the slider: between two keys slides and turns go evenly.
  const mixed = (at) => {
    if (at < 0) return named[-1 - at].state;
    const from = clamp(Math.floor(at), 0, keys.length - 1);
    const to = Math.min(from + 1, keys.length - 1);
    const share = at - from;
    return keys[from].map((limb, own) => limb.map((state, joint) => state.map((value, part) => value + (keys[to][own][joint][part] - value) * share)));
  };
  const poses = (at) => {
    const states = mixed(at);
    const bases = Array(junctures).fill(STILL);
    const shells = limbs.map((limb, own) => {
      const frames = chain(limb, states[own]).map((frame) => after(bases[limb.from], frame));
      bases[limb.to] = after(frames[frames.length - 1], limb.out);
      return frames;
    });
    return bodies.map(([first, shell]) => (shell === undefined ? bases[first] : shells[first][shell]));
  };
  // Says how far the joints are that move.
  const figures = (at) => {
    const [from, to] = [Math.max(Math.ceil(at) - 1, 0), Math.max(Math.ceil(at), 0)];
    if (from === to || at <= 0) return "";
    const states = mixed(at);
    return limbs.flatMap(({ joints }, own) => joints.map((joint, index) => {
      const isMoving = [0, 1].some((part) => keys[from][own][index][part] !== keys[to][own][index][part]);
      if (!isMoving) return "";
      const [slide, turn] = states[own][index];
      const out = `${joint.id} out by ${(slide - joint.closed).toFixed(1)} of ${(joint.open - joint.closed).toFixed(1)} mm`;
      return Math.abs(joint.turn) < 0.01 ? out : `${out}, turned by ${(turn * 180 / Math.PI).toFixed(1)} of ${(joint.turn * 180 / Math.PI).toFixed(1)}°`;
    })).filter(Boolean).join("; ");
  };

  const stage = makeStage(data, poses, () => 0);
  if (stage) makePlayer(stage, data, { words: ["All in", "All out"], figures, poses: named.map(({ name }) => name) });
}
