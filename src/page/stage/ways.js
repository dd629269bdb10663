// An object on a base: its units leave along the normals of their panels, the one that closes it first.
{
  const data = JSON.parse(byId("view-data").textContent);
  const { leave, far } = data.motion;
  const poses = (at) => {
    const all = data.items.map(() => [0, 0, 0]);
    leave.forEach(({ bodies, ways }, step) => {
      const share = clamp(at - step, 0, 1);
      bodies.forEach((body, index) => {
        all[body] = all[body].map((value, axis) => value + share * ways[index][axis]);
      });
    });
    return all.map((to) => ({ ...STILL, to }));
  };
  const stage = makeStage(data, poses, (at) => clamp(at, 0, 1) * far);
  if (stage) makePlayer(stage, data, { words: ["Together", "All apart"], figures: () => "" });
}
