// The assembly on a screen: turned, taken apart and cut. WebGL 2, no library, no network.
"use strict";
(() => {
  const section = document.getElementById("view");
  const canvas = document.getElementById("view-canvas");
  const source = document.getElementById("view-data");
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return; // The pictures of the sheet show the same.
  const data = JSON.parse(source.textContent);

  const VERTEX = `#version 300 es
    in vec3 place;                      // 0 to 1 in the box of all parts
    uniform vec3 low, size, shift;      // mm
    uniform mat3 turn;
    uniform vec3 middle;
    uniform vec2 scale;                 // clip units in a mm
    uniform float depth;
    out vec3 model, seen;
    void main() {
      model = low + place * size;
      seen = turn * (model + shift - middle);
      gl_Position = vec4(seen.xy * scale, -seen.z * depth, 1.0);
    }`;
  const FRAGMENT = `#version 300 es
    precision highp float;
    in vec3 model, seen;
    uniform vec3 color, cutColor, stripeColor;
    uniform int runs;                   // of the stripes: 0 up, 1 down, 2 both ways
    uniform vec4 plane;                 // what lies beyond it is cut away
    uniform bool isCut;
    out vec4 pixel;
    void main() {
      if (isCut && dot(model, plane.xyz) > plane.w) discard;
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
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return;
  gl.useProgram(program);
  const at = Object.fromEntries(["low", "size", "shift", "turn", "middle", "scale", "depth", "color", "cutColor",
    "stripeColor", "runs", "plane", "isCut"].map((name) => [name, gl.getUniformLocation(program, name)]));

  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const items = data.items.map((item) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, bytes(item.vertices), gl.STATIC_DRAW);
    const place = gl.getAttribLocation(program, "place");
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.UNSIGNED_SHORT, true, 6, 0);
    const triangles = bytes(item.triangles);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    const type = item.wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT;
    return { ...item, array, type, count: triangles.length / (item.wide ? 4 : 2), isShown: true };
  });

  const [low, high] = data.box;
  const size = high.map((value, axis) => value - low[axis]);
  const middle = high.map((value, axis) => 0.5 * (value + low[axis]));
  const START = { yaw: -0.5, pitch: 0.35, zoom: 1 };
  const view = { ...START, apart: 0, axis: -1, share: 0.5 };
  const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

  // Columns of the rotation: yaw about the model's z, then the viewer is lifted by pitch.
  const turn = () => {
    const [c, s, p, q] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
    return [c, s * q, -s * p, -s, c * q, -c * p, 0, p, q];
  };

  const draw = () => {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * ratio)));
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const far = Math.max(...data.items.map((item) => Math.hypot(...item.shift)));
    const radius = 0.5 * Math.hypot(...size) + view.apart * far;
    // Half of what is seen at the start, whichever way it is turned about its axis.
    const [across, up] = [0.5 * Math.hypot(size[0], size[1]), 0.5 * size[2]];
    const over = up * Math.cos(START.pitch) + across * Math.sin(START.pitch);
    const reach = view.apart * far;
    const unit = view.zoom * Math.min(width / (across + reach), height / (over + reach)) / 1.08;
    gl.viewport(0, 0, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform3fv(at.low, low);
    gl.uniform3fv(at.size, size);
    gl.uniform3fv(at.middle, middle);
    gl.uniformMatrix3fv(at.turn, false, turn());
    gl.uniform2f(at.scale, unit / width, unit / height);
    gl.uniform1f(at.depth, 0.5 / (radius + far));
    gl.uniform1i(at.isCut, view.axis >= 0 ? 1 : 0);
    const normal = [0, 1, 2].map((axis) => (axis === view.axis ? 1 : 0));
    const offset = view.axis < 0 ? 0 : low[view.axis] + view.share * size[view.axis];
    gl.uniform4f(at.plane, ...normal, offset);
    for (const item of items.filter((item) => item.isShown)) {
      gl.bindVertexArray(item.array);
      gl.uniform3fv(at.shift, item.shift.map((value) => value * view.apart));
      gl.uniform3fv(at.color, item.color);
      gl.uniform3fv(at.cutColor, item.cut);
      gl.uniform3fv(at.stripeColor, item.stripe);
      gl.uniform1i(at.runs, item.runs);
      gl.drawElements(gl.TRIANGLES, item.count, item.type, 0);
    }
  };
  let isDue = false;
  const show = () => {
    if (isDue) return;
    isDue = true;
    requestAnimationFrame(() => { isDue = false; draw(); });
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

  const explode = document.getElementById("view-explode");
  const axis = document.getElementById("view-axis");
  const share = document.getElementById("view-section");
  const place = document.getElementById("view-place");
  explode.addEventListener("input", () => { view.apart = explode.value / 100; show(); });
  const cut = () => {
    view.axis = Number(axis.value);
    view.share = share.value / 100;
    share.disabled = view.axis < 0;
    place.textContent = view.axis < 0 ? "" : `${(view.share * size[view.axis]).toFixed(1)} mm from its low side`;
    show();
  };
  axis.addEventListener("input", cut);
  share.addEventListener("input", cut);
  document.getElementById("view-reset").addEventListener("click", () => {
    Object.assign(view, START);
    explode.value = 0;
    view.apart = 0;
    axis.value = "-1";
    cut();
  });
  document.querySelectorAll("input[data-item]").forEach((box) => {
    box.addEventListener("input", () => { items[Number(box.dataset.item)].isShown = box.checked; show(); });
  });
  canvas.addEventListener("webglcontextlost", () => { section.hidden = true; });

  section.hidden = false;
  new ResizeObserver(show).observe(canvas);
  cut();
  draw();
})();
