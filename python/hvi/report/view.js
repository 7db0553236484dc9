/* lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.

   The scene of a page in 3D: particles as lit spheres (WebGL 2). report/view.py writes the page and says what is in its record.
   A frame is one texture of its bytes, made when it is unpacked, and one draw call; drawing allocates nothing. Three vertices of a particle read its bytes
   themselves: instances cost several times more where WebGL is in software. */
"use strict";

const WIDTH = 2048; // of the texture of a frame, and the most rows that each WebGL 2 has: room for 200,000 particles of 20 bytes

const VERTEX = `#version 300 es
precision highp float;
#define WIDTH ${WIDTH}
uniform sampler2D table;                        // columns: bytes; rows: fields; alpha of row 0: radius of a part over the largest
uniform highp usampler2D frame;                 // of n particles: x, y, z, two bytes each, then a byte of each field, the part first
uniform vec3 low, size, center, plane, cut;     // of the frame; of the view; mirror planes; cut: sign along its axis
uniform ivec3 bits;                             // of the number of an image: is it behind the mirror plane of the axis?
uniform mat3 turn;                              // columns: right, up, to the eye
uniform vec3 scale;                             // lengths to clip coordinates
uniform float largest, least, cutAt;            // radius of the largest particle; radius of a pixel
uniform int row, images, shown, n;
flat out vec3 color;
flat out float bulge;                           // radius in window depth
out vec2 at;
float byteOf(int k) { return float(texelFetch(frame, ivec2(k % WIDTH, k / WIDTH), 0).r); }
float wordOf(int k) { return (byteOf(2 * k) + 256.0 * byteOf(2 * k + 1)) / 65535.0; }
void main() {
  int corner = gl_VertexID % 3, image = gl_VertexID / 3 % images, k = gl_VertexID / 3 / images;
  vec3 place = low + size * vec3(wordOf(k), wordOf(n + k), wordOf(2 * n + k));
  if ((image & bits.x) != 0) place.x = 2.0 * plane.x - place.x;
  if ((image & bits.y) != 0) place.y = 2.0 * plane.y - place.y;
  if ((image & bits.z) != 0) place.z = 2.0 * plane.z - place.z;
  vec4 look = texelFetch(table, ivec2(int(byteOf(6 * n + k)), 0), 0);
  float radius = max(largest * look.a, least);
  color = row == 0 ? look.rgb : texelFetch(table, ivec2(int(byteOf((6 + row) * n + k)), row), 0).rgb;
  bulge = 0.5 * radius * scale.z;
  at = corner == 2 ? vec2(0.0, 2.0) : vec2(corner == 0 ? -1.7320509 : 1.7320509, -1.0); // the triangle about the circle of radius 1
  vec3 seen = (place - center) * turn;          // components along right, up, to the eye
  gl_Position = vec4((seen.xy + radius * at) * scale.xy, -seen.z * scale.z, 1.0);
  if (image >= shown || dot(cut, place) > cutAt) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // outside: not drawn
}`;

const FRAGMENT = `#version 300 es
precision highp float;
flat in vec3 color;
flat in float bulge;
in vec2 at;
out vec4 pixel;
const vec3 LIGHT = normalize(vec3(-0.38, 0.5, 0.78)), HALF = normalize(LIGHT + vec3(0.0, 0.0, 1.0));
void main() {
  float r2 = dot(at, at);
  if (r2 > 1.0) discard;
  vec3 normal = vec3(at, sqrt(1.0 - r2));
  gl_FragDepth = gl_FragCoord.z - bulge * normal.z;
  float gloss = pow(max(dot(normal, HALF), 0.0), 24.0);
  pixel = vec4(color * (0.42 + 0.66 * max(dot(normal, LIGHT), 0.0)) + 0.14 * gloss, 1.0);
}`;

const UNIFORMS = ["table", "frame", "n", "low", "size", "center", "plane", "cut", "bits", "turn", "scale", "largest", "least", "cutAt", "row", "images", "shown"];

async function unpack(text) {
  const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Uint8Array(await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
}

function programOf(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

async function start(root) {
  const canvas = root.querySelector("canvas");
  const gl = canvas.getContext("webgl2", { antialias: false, alpha: false }); // samples within a pixel see no edges of spheres
  if (!gl || typeof DecompressionStream === "undefined") return; // the still picture stays
  const scene = JSON.parse(root.querySelector("template").content.textContent);
  const control = name => root.querySelector(`[data-is="${name}"]`);
  const make = (name, text, parent) => parent.appendChild(Object.assign(document.createElement(name), { textContent: text }));

  const program = programOf(gl), uniform = {};
  for (const name of UNIFORMS) uniform[name] = gl.getUniformLocation(program, name);
  const table = await unpack(scene.table), images = 1 << scene.mirror.length;
  gl.useProgram(program);
  const textureOf = (...image) => {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, ...image);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  };
  textureOf(gl.RGBA8, 256, scene.fields.length, 0, gl.RGBA, gl.UNSIGNED_BYTE, table);
  gl.activeTexture(gl.TEXTURE1); // of the frames
  gl.uniform1i(uniform.frame, 1);
  const bits = [0, 0, 0], planes = [0, 0, 0];
  scene.mirror.forEach(([axis, at], k) => { bits[axis] = 1 << k; planes[axis] = at; });
  gl.uniform3iv(uniform.bits, bits);
  gl.uniform3fv(uniform.plane, planes);
  gl.uniform1f(uniform.largest, scene.radius);
  gl.uniform1i(uniform.images, images);
  gl.enable(gl.DEPTH_TEST);
  gl.clearColor(0.97, 0.973, 0.98, 1);

  // the eye goes around the center: yaw about up, pitch towards up
  const state = { frame: 0, yaw: 0, pitch: 0, zoom: 1 };
  const turn = new Float32Array(9), center = new Float32Array(3), scale = new Float32Array(3), cut = new Float32Array(3);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = a => a.map(v => v / Math.hypot(...a));
  const up = unit(scene.up), along = dot(scene.eye, up);
  const ahead = unit(scene.eye.map((v, k) => v - along * up[k])), side = cross(up, ahead); // the eye without pitch; it comes from there with yaw
  const home = () => {
    state.yaw = 0;
    state.pitch = Math.asin(along / Math.hypot(...scene.eye));
    state.zoom = 1;
    center.set(scene.center);
  };
  const pose = () => {
    const cy = Math.cos(state.yaw), sy = Math.sin(state.yaw), cp = Math.cos(state.pitch), sp = Math.sin(state.pitch);
    for (let k = 0; k < 3; k++) {
      const flat = cy * ahead[k] + sy * side[k];
      turn[k] = cy * side[k] - sy * ahead[k];
      turn[3 + k] = cp * up[k] - sp * flat;
      turn[6 + k] = cp * flat + sp * up[k];
    }
    for (let k = 0; k < 3; k++) {
      const line = root.querySelector(`[data-axis="${"xyz"[k]}"]`);
      line.setAttribute("transform", `translate(${22 * turn[k]} ${-22 * turn[3 + k]})`);
      line.previousElementSibling.setAttribute("d", `M0 0L${17 * turn[k]} ${-17 * turn[3 + k]}`);
    }
  };

  const frames = [], ready = [];
  const unpackFrame = k => ready[k] ??= unpack(scene.frames[k].data).then(bytes => {
    const { n, low, size } = scene.frames[k], rows = Math.ceil(bytes.length / WIDTH), full = new Uint8Array(WIDTH * rows);
    full.set(bytes);
    scene.frames[k].data = null;
    frames[k] = { n, texture: textureOf(gl.R8UI, WIDTH, rows, 0, gl.RED_INTEGER, gl.UNSIGNED_BYTE, full), low: new Float32Array(low), size: new Float32Array(size) };
  });

  let due = false, field = 0, shown = images, cutAt = 0;
  const fit = () => { // the canvas has the pixels of its place on the page
    const ratio = Math.min(devicePixelRatio || 1, 2), width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const half = state.zoom * Math.max(scene.high / 2, scene.wide / 2 * height / width); // length from the middle to the upper edge
    scale[0] = height / (width * half);
    scale[1] = 1 / half;
    scale[2] = 1 / scene.deep;
    return 2 * half / height;
  };
  const draw = () => {
    due = false;
    const frame = frames[state.frame], pixel = fit(), n = frame.n;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform3fv(uniform.low, frame.low);
    gl.uniform3fv(uniform.size, frame.size);
    gl.uniform3fv(uniform.center, center);
    gl.uniform3fv(uniform.scale, scale);
    gl.uniform3fv(uniform.cut, cut);
    gl.uniform1f(uniform.cutAt, cutAt);
    gl.uniform1f(uniform.least, 0.8 * pixel);
    gl.uniform1i(uniform.row, field);
    gl.uniform1i(uniform.shown, shown);
    gl.uniformMatrix3fv(uniform.turn, false, turn);
    gl.bindTexture(gl.TEXTURE_2D, frame.texture);
    gl.uniform1i(uniform.n, n);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * n * images);
  };
  const redraw = () => {
    if (!due) { due = true; requestAnimationFrame(draw); }
  };
  const ruler = () => { // a length of 1, 2 or 5 times a power of ten, at most a fifth of the width
    const pixel = fit() * canvas.width / canvas.clientWidth, most = 0.2 * pixel * canvas.clientWidth, power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].find(k => k * power <= most) * power;
    control("ruler").style.width = `${length / pixel}px`;
    control("length").textContent = `${Number(length.toPrecision(1))} ${scene.unit}`;
  };
  const turned = () => { pose(); redraw(); };
  const zoom = by => {
    state.zoom = Math.min(Math.max(state.zoom * by, 0.005), 20);
    ruler();
    redraw();
  };
  const look = (right, upward) => { // by angles
    state.yaw -= right;
    state.pitch = Math.min(Math.max(state.pitch + upward, -1.57), 1.57);
    turned();
  };
  const shift = (right, upward) => { // by pixels of the page
    const length = fit() * canvas.height / canvas.clientHeight;
    for (let k = 0; k < 3; k++) center[k] -= length * (right * turn[k] + upward * turn[3 + k]);
    redraw();
  };
  let asked = 0;
  const show = async k => {
    asked = k;
    await unpackFrame(k);
    if (asked !== k) return; // the slider went on
    state.frame = k;
    control("time").value = k;
    control("when").textContent = scene.frames[k].when;
    root.dataset.frame = k;
    redraw();
  };

  // colors and their legend
  const legend = () => {
    const { name, ticks, parts } = scene.fields[field], box = control("legend"), color = k => `rgb(${table.subarray(4 * (256 * field + k), 4 * (256 * field + k) + 3).join()})`;
    box.replaceChildren();
    if (parts) {
      for (const [k, text] of parts) {
        const item = make("li", text, box), dot = document.createElement("i");
        dot.style.background = color(k);
        item.prepend(dot);
      }
      return;
    }
    const item = make("li", name, box), bar = make("span", "", item);
    bar.className = "legend";
    bar.style.background = `linear-gradient(to right, ${Array.from({ length: 33 }, (_, k) => color(Math.min(8 * k, 255))).join()})`;
    for (const [text, at] of ticks) make("b", text, bar).style.left = `${100 * at}%`;
  };
  scene.fields.forEach(({ name }, k) => { make("option", name, control("color")).value = k; });
  const choose = k => { field = k; control("color").value = k; legend(); redraw(); };
  control("color").addEventListener("change", event => choose(Number(event.target.value)));

  // cut: what is beyond a plane, or short of it, is left out
  const slice = () => {
    const way = control("cut").value, axis = "xyz".indexOf(way[0]), sign = way.endsWith(">") ? 1 : -1;
    cut.fill(0);
    control("place").disabled = axis < 0;
    if (axis >= 0) {
      const at = scene.least[axis] + (scene.most[axis] - scene.least[axis]) * control("place").value / 1000;
      cut[axis] = sign;
      cutAt = sign * at;
      control("where").textContent = `${Number(at.toPrecision(3))} ${scene.unit}`;
    } else {
      cutAt = 0;
      control("where").textContent = "";
    }
    redraw();
  };
  control("cut").value = scene.cut;
  control("cut").addEventListener("change", slice);
  control("place").addEventListener("input", slice);
  const middle = "xyz".indexOf(scene.cut[0]);
  if (middle >= 0) control("place").value = 1000 * (scene.cutAt - scene.least[middle]) / (scene.most[middle] - scene.least[middle]);
  control("mirror").closest("label").hidden = images === 1;
  control("mirror").addEventListener("change", event => { shown = event.target.checked ? images : 1; redraw(); });

  // time
  let playing = 0;
  const step = async () => {
    const mine = playing; // stopped and begun again in between, another goes on
    await show((state.frame + 1) % scene.frames.length);
    if (playing && playing === mine) playing = setTimeout(step, state.frame === scene.frames.length - 1 ? 1500 : 150);
  };
  const stop = () => { clearTimeout(playing); playing = 0; control("play").textContent = "play"; };
  control("play").addEventListener("click", () => {
    if (playing) return stop();
    control("play").textContent = "stop";
    playing = setTimeout(step, 0);
  });
  control("time").max = scene.frames.length - 1;
  control("time").addEventListener("input", event => { stop(); show(Number(event.target.value)); });

  // mouse, fingers, keys
  const fingers = new Map();
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener("pointermove", event => {
    const old = fingers.get(event.pointerId);
    if (!old) return;
    const here = [event.clientX, event.clientY], [dx, dy] = [here[0] - old[0], here[1] - old[1]];
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      zoom(Math.hypot(old[0] - other[0], old[1] - other[1]) / Math.max(Math.hypot(here[0] - other[0], here[1] - other[1]), 1));
      shift(dx / 2, -dy / 2);
    } else if (event.shiftKey || event.buttons & 2) shift(dx, -dy);
    else look(0.008 * dx, 0.008 * dy);
    fingers.set(event.pointerId, here);
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, event => fingers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => { // of a reader on the way down the page it stays the page's
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    zoom(Math.exp(0.001 * event.deltaY));
  }, { passive: false });
  const KEYS = { ArrowLeft: () => look(-0.1, 0), ArrowRight: () => look(0.1, 0), ArrowUp: () => look(0, -0.1), ArrowDown: () => look(0, 0.1), "+": () => zoom(0.8), "-": () => zoom(1.25) };
  canvas.addEventListener("keydown", event => {
    if (!KEYS[event.key]) return;
    event.preventDefault();
    KEYS[event.key]();
  });
  control("home").addEventListener("click", () => { home(); ruler(); turned(); });
  canvas.addEventListener("webglcontextlost", () => root.classList.remove("on")); // back to the still picture

  state.frame = scene.first;
  await unpackFrame(scene.first);
  root.classList.add("on");
  home();
  pose();
  ruler();
  slice();
  choose(scene.color);
  await show(scene.first);
  new ResizeObserver(() => {
    if (!canvas.clientWidth) return; // on paper
    ruler();
    redraw();
  }).observe(canvas);
  for (let k = 0; k < scene.frames.length; k++) await unpackFrame(k);
  root.dataset.ready = scene.frames.length;
}

const found = document.querySelector(".scene");
if (found) start(found).catch(problem => { found.classList.remove("on"); console.error(problem); });
