// Rigid bodies on a screen: turned, moved and cut. WebGL 2, no library, no network.
"use strict";
const byId = (id) => document.getElementById(id);
const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

// A rigid motion: the columns of its rotation one after the other, and where it takes the origin.
const STILL = { turn: [1, 0, 0, 0, 1, 0, 0, 0, 1], to: [0, 0, 0] };
const turned = (turn, [x, y, z]) => [0, 1, 2].map((row) => turn[row] * x + turn[row + 3] * y + turn[row + 6] * z);
const moved = (motion, point) => turned(motion.turn, point).map((value, axis) => value + motion.to[axis]);
// The inner motion first, then the outer one.
const after = (outer, inner) => ({
  turn: [0, 3, 6].flatMap((at) => turned(outer.turn, inner.turn.slice(at, at + 3))), to: moved(outer, inner.to),
});
const back = ({ turn, to }) => {
  const across = [0, 3, 6, 1, 4, 7, 2, 5, 8].map((at) => turn[at]);
  return { turn: across, to: turned(across, to).map((value) => -value) };
};

// Makes the view; null without WebGL, where the pictures of the sheet show the same. `poses(at)` gives the motion of each body
// for a value of the slider, `far(at)` by how many mm bodies are then at most out of their box.
const makeStage = (data, poses, far) => {
  const section = byId("view");
  const canvas = byId("view-canvas");
  const names = byId("view-names");
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return null;

  const VERTEX = `#version 300 es
    in vec3 place;                      // 0 to 1 in the box of its body
    uniform vec3 low, size, to;         // mm
    uniform mat3 spin, turn;
    uniform vec3 middle;
    uniform vec2 scale, nudge;          // clip units in a mm, and clip units
    uniform float depth;
    uniform bool isCutMoved;
    out vec3 cutAt, seen;
    void main() {
      vec3 own = low + place * size;
      vec3 world = spin * own + to;
      cutAt = isCutMoved ? world : own;
      seen = turn * (world - middle);
      gl_Position = vec4(seen.xy * scale + nudge, -seen.z * depth, 1.0);
    }`;
  const FRAGMENT = `#version 300 es
    precision highp float;
    in vec3 cutAt, seen;
    uniform vec3 color, cutColor, stripeColor;
    uniform int runs;                   // of the stripes: 0 up, 1 down, 2 both ways
    uniform vec4 plane;                 // what lies beyond it is cut away
    uniform bool isCut, isLine;
    out vec4 pixel;
    void main() {
      if (isLine) { pixel = vec4(color, 1.0); return; }
      if (isCut && dot(cutAt, plane.xyz) > plane.w) discard;
      if (isCut && !gl_FrontFacing) {   // the inside of material, seen through the cut
        bool up = mod(gl_FragCoord.x - gl_FragCoord.y, 10.0) < 2.5, down = mod(gl_FragCoord.x + gl_FragCoord.y, 10.0) < 2.5;
        bool isStripe = runs == 0 ? up : runs == 1 ? down : up || down;
        pixel = vec4(isStripe ? stripeColor : cutColor, 1.0);
        return;
      }
      vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
      float light = 0.5 + 0.5 * max(dot(normal, normalize(vec3(-0.4, 0.5, 0.77))), 0.0);
      pixel = vec4(color * light, 1.0);
    }`;

  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const at = Object.fromEntries(["low", "size", "to", "spin", "turn", "middle", "scale", "nudge", "depth", "isCutMoved", "color",
    "cutColor", "stripeColor", "runs", "plane", "isCut", "isLine"].map((name) => [name, gl.getUniformLocation(program, name)]));

  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const load = (item) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    const vertices = bytes(item.vertices);
    gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
    const place = gl.getAttribLocation(program, "place");
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.UNSIGNED_SHORT, true, 6, 0);
    const triangles = bytes(item.triangles);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    const type = item.wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT;
    return { ...item, array, type, points: vertices.length / 6, count: triangles.length / (item.wide ? 4 : 2), pose: STILL, isShown: true };
  };
  const items = data.items.map(load);
  const lines = data.lines.map(load);

  // All of the camera is upright: its z axis is the model's up.
  const upright = { turn: data.upright, to: [0, 0, 0] };
  const [low, high] = data.box;
  const size = high.map((value, axis) => value - low[axis]);
  const middle = moved(back(upright), high.map((value, axis) => 0.5 * (value + low[axis])));
  const START = { yaw: -0.5, pitch: 0.35, zoom: 1 };
  const view = { ...START, at: 0, axis: -1, share: 0.5, isNamed: true, hasLine: true };

  // Yaw about the upright z axis, then the viewer is lifted by pitch.
  const camera = () => {
    const [c, s, p, q] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
    return after({ turn: [c, s * q, -s * p, -s, c * q, -c * p, 0, p, q], to: [0, 0, 0] }, upright).turn;
  };

  // Writes words beside bodies, but none over another.
  const label = (turn, unit) => {
    const taken = [];
    const words = [];
    for (const { body, words: name } of view.isNamed ? data.named : []) {
      const item = items[body];
      if (!item.isShown || data.names_wait && item.pose.to.every((value) => value === 0)) continue;
      const center = moved(item.pose, item.low.map((value, axis) => value + 0.5 * item.size[axis]));
      const [x, y] = turned(turn, center.map((value, axis) => value - middle[axis]));
      const [left, top] = [0.5 * canvas.clientWidth + x * unit, 0.5 * canvas.clientHeight - y * unit];
      const wide = 9 * name.length + 10;
      const isFree = taken.every((other) => Math.abs(other.left - left) > 0.5 * (other.wide + wide) || Math.abs(other.top - top) > 20);
      if (!isFree || left < 0 || top < 0 || left > canvas.clientWidth || top > canvas.clientHeight) continue;
      taken.push({ left, top, wide });
      const word = document.createElement("span");
      word.textContent = name;
      word.style.left = `${left}px`;
      word.style.top = `${top}px`;
      words.push(word);
    }
    names.replaceChildren(...words);
  };

  const draw = () => {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * ratio)));
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const reach = far(view.at);
    // Half of what is seen at the start, whichever way it is turned about its axis.
    const [across, up] = [0.5 * Math.hypot(size[0], size[1]), 0.5 * size[2]];
    const over = up * Math.cos(START.pitch) + across * Math.sin(START.pitch);
    const unit = view.zoom * Math.min(width / (across + reach), height / (over + reach)) / 1.08;
    const turn = camera();
    gl.viewport(0, 0, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform3fv(at.middle, middle);
    gl.uniformMatrix3fv(at.turn, false, turn);
    gl.uniform2f(at.scale, unit / width, unit / height);
    gl.uniform2f(at.nudge, 0, 0);
    gl.uniform1f(at.depth, 0.5 / (0.5 * Math.hypot(...size) + 2 * reach));
    gl.uniform1i(at.isCutMoved, data.cuts_moved ? 1 : 0);
    gl.uniform1i(at.isCut, view.axis >= 0 ? 1 : 0);
    gl.uniform1i(at.isLine, 0);
    // What lies towards the viewer of the start is cut away: the front has the low y.
    const side = view.axis === 1 ? -1 : 1;
    const normal = turned(back(upright).turn, [0, 1, 2].map((axis) => (axis === view.axis ? side : 0)));
    const offset = view.axis < 0 ? 0 : low[view.axis] + view.share * size[view.axis];
    gl.uniform4f(at.plane, ...normal, side * offset);
    const place = (item) => {
      gl.bindVertexArray(item.array);
      gl.uniform3fv(at.low, item.low);
      gl.uniform3fv(at.size, item.size);
      gl.uniform3fv(at.to, item.pose.to);
      gl.uniformMatrix3fv(at.spin, false, item.pose.turn);
      gl.uniform3fv(at.color, item.color);
    };
    for (const item of items.filter((item) => item.isShown)) {
      place(item);
      gl.uniform3fv(at.cutColor, item.cut);
      gl.uniform3fv(at.stripeColor, item.stripe);
      gl.uniform1i(at.runs, item.runs);
      gl.drawElements(gl.TRIANGLES, item.count, item.type, 0);
    }
    // Lines lie in bodies, so they are drawn over them, three pixels wide.
    gl.disable(gl.DEPTH_TEST);
    gl.uniform1i(at.isLine, 1);
    for (const line of view.hasLine ? lines : []) {
      place(line);
      for (let nudge = 0; nudge < 9; nudge += 1) {
        gl.uniform2f(at.nudge, 2 * (nudge % 3 - 1) / width, 2 * (Math.floor(nudge / 3) - 1) / height);
        gl.drawArrays(gl.LINE_STRIP, 0, line.points);
      }
    }
    label(turn, 0.5 * unit / ratio);
  };
  let isDue = false;
  const show = () => {
    if (isDue) return;
    isDue = true;
    requestAnimationFrame(() => { isDue = false; draw(); });
  };
  const move = (to) => {
    view.at = to;
    poses(to).forEach((pose, index) => { items[index].pose = pose; });
    show();
  };
  const rotate = (yaw, pitch) => {
    view.yaw += yaw;
    view.pitch = clamp(view.pitch + pitch, -1.57, 1.57);
    show();
  };
  const zoom = (factor) => { view.zoom = clamp(view.zoom * factor, 0.2, 20); show(); };
  const reset = () => { Object.assign(view, START); show(); };

  // One finger or the mouse turns, two fingers zoom.
  const fingers = new Map();
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const wide = fingers.size === 2 ? spread() : 0;
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (fingers.size === 1) rotate((event.clientX - before.x) * 0.01, (event.clientY - before.y) * 0.01);
    else if (wide > 0) zoom(spread() / wide);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas) return; // or the page could not be scrolled past it
    event.preventDefault();
    zoom(Math.exp(-0.0015 * event.deltaY));
  }, { passive: false });
  const KEYS = {
    ArrowLeft: () => rotate(-0.1, 0), ArrowRight: () => rotate(0.1, 0), ArrowUp: () => rotate(0, -0.1), ArrowDown: () => rotate(0, 0.1),
    "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15), Home: reset,
  };
  canvas.addEventListener("keydown", (event) => {
    const act = KEYS[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });

  const axis = byId("view-axis");
  const share = byId("view-section");
  const place = byId("view-place");
  const cut = () => {
    view.axis = Number(axis.value);
    view.share = share.value / 100;
    share.disabled = view.axis < 0;
    place.textContent = view.axis < 0 ? "" : `${(view.share * size[view.axis]).toFixed(1)} mm from its low side`;
    show();
  };
  axis.addEventListener("input", cut);
  share.addEventListener("input", cut);
  byId("view-reset").addEventListener("click", () => { axis.value = "-1"; reset(); cut(); });
  // A body is seen if all that can hide it are ticked.
  const boxes = [...document.querySelectorAll("input[data-bodies]")];
  const hide = () => {
    for (const item of items) item.isShown = true;
    for (const box of boxes.filter((box) => !box.checked && box.dataset.bodies)) {
      for (const body of box.dataset.bodies.split(" ")) items[Number(body)].isShown = false;
    }
    show();
  };
  for (const box of boxes) box.addEventListener("input", hide);
  for (const [id, key] of [["view-line", "hasLine"], ["view-named", "isNamed"]]) {
    const box = byId(id);
    if (box) box.addEventListener("input", () => { view[key] = box.checked; show(); });
  }
  canvas.addEventListener("webglcontextlost", () => { section.hidden = true; });
  // Where each body is drawn in the model, by rows, mm: for those who measure.
  section.places = () => items.map(({ name, pose: { turn, to } }) => ({
    name, rows: [0, 1, 2].map((row) => [turn[row], turn[row + 3], turn[row + 6], to[row]]),
  }));

  section.hidden = false;
  new ResizeObserver(show).observe(canvas);
  cut();
  move(0);
  draw();
  return { move };
};
