// Films of motions: boxes in perspective on a canvas, with a play button, a time slider and a rotatable view.

const films = numbers.records.flatMap(r => r.scenes?.films ?? []);
const FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];  // -x +x -y +y -z +z
const FACE_COLORS = [[213, 94, 0], [213, 94, 0], [0, 114, 178], [0, 114, 178], [230, 190, 60], [0, 158, 115]];

// The point v after a pose: R(Q) v + p, with Q = x y z w.
function placed([px, py, pz, x, y, z, w], [a, b, c]) {
  const tx = 2 * (y * c - z * b), ty = 2 * (z * a - x * c), tz = 2 * (x * b - y * a);
  return [px + a + w * tx + y * tz - z * ty, py + b + w * ty + z * tx - x * tz, pz + c + w * tz + x * ty - y * tx];
}

const corners = link => [...Array(8).keys()].map(k => {
  const s = [k & 4 ? 1 : -1, k & 2 ? 1 : -1, k & 1 ? 1 : -1].map((sign, i) => sign * link.half[i]);
  return [0, 1, 2].map(i => link.centre[i] + link.axes[3 * i] * s[0] + link.axes[3 * i + 1] * s[1] + link.axes[3 * i + 2] * s[2]);
});

class Player {
  constructor(film, home) {
    this.film = film;
    this.time = 0;
    this.turn = .7; this.lift = .35;
    this.length = (film.frames.length - 1) * film.interval;
    this.boxes = film.links.map(corners);
    const points = film.frames.flatMap((f, n) => n % 5 ? [] : this.solid(n));
    if (film.ground !== null) points.push([0, 0, film.ground]);
    const low = [0, 1, 2].map(i => Math.min(...points.map(p => p[i]))), high = [0, 1, 2].map(i => Math.max(...points.map(p => p[i])));
    this.middle = low.map((l, i) => (l + high[i]) / 2);
    this.radius = Math.max(.01, ...points.map(p => Math.hypot(...p.map((x, i) => x - this.middle[i]))));
    this.canvas = element("canvas", {role: "img", tabindex: "0", "aria-label": `${film.name}: ${film.what}. Drag or use the arrow keys to turn the view.`});
    this.button = element("button", {type: "button"}, "Play");
    this.scrub = element("input", {type: "range", min: 0, max: film.frames.length - 1, step: 1, value: 0, "aria-label": "time"});
    this.clock = element("output", {});
    home.append(element("div", {class: "film"}, element("h3", {}, film.name), this.canvas,
      element("div", {class: "film-controls"}, this.button, this.scrub, this.clock),
      element("p", {class: "note"}, `${film.what}; ${short(this.length)} s by ${film.integrator}. Each box has its body’s mass and inertia.`)));
    this.button.addEventListener("click", () => this.playing ? this.pause() : this.play());
    this.scrub.addEventListener("input", () => { this.pause(); this.show(this.scrub.value * film.interval); });
    this.canvas.addEventListener("pointerdown", e => { this.drag = [e.clientX, e.clientY]; this.canvas.setPointerCapture(e.pointerId); });
    this.canvas.addEventListener("pointermove", e => {
      if (!this.drag) return;
      this.look((e.clientX - this.drag[0]) / 120, (e.clientY - this.drag[1]) / 120);
      this.drag = [e.clientX, e.clientY];
    });
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => { this.drag = null; });
    this.canvas.addEventListener("keydown", e => {
      const by = {ArrowLeft: [-.1, 0], ArrowRight: [.1, 0], ArrowUp: [0, -.1], ArrowDown: [0, .1]}[e.key];
      if (by) { this.look(...by); e.preventDefault(); }
    });
    new ResizeObserver(() => this.show(this.time)).observe(this.canvas);
  }
  look(turn, lift) {
    this.turn -= turn;
    this.lift = Math.min(1.5, Math.max(-.2, this.lift + lift));
    this.show(this.time);
  }
  // All corners and joints in film frame n, in world coordinates.
  solid(n) {
    return this.film.frames[n].flatMap((pose, i) => [...this.boxes[i], ...this.film.links[i].joints].map(p => placed(pose, p)));
  }
  play() {
    if (this.time >= this.length) this.time = 0;
    this.playing = true;
    this.button.textContent = "Pause";
    let last = null;
    const tick = now => {
      if (!this.playing) return;
      this.show(this.time + (last === null ? 0 : (now - last) / 1000));
      last = now;
      if (this.time >= this.length) this.pause(); else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
  pause() { this.playing = false; this.button.textContent = "Play"; }

  show(time) {
    this.time = Math.min(time, this.length);
    const n = Math.round(this.time / this.film.interval), {canvas, film} = this;
    this.scrub.value = n;
    this.clock.textContent = `${this.time.toFixed(2)} s`;
    const ratio = Math.max(2, devicePixelRatio), width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width) return;
    if (canvas.width !== Math.round(width * ratio)) { canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio); }
    const ctx = canvas.getContext("2d");
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    const ca = Math.cos(this.turn), sa = Math.sin(this.turn), cb = Math.cos(this.lift), sb = Math.sin(this.lift);
    const scale = .46 * Math.min(width, height) / this.radius, far = 5 * this.radius;
    const seen = p => {  // screen x, y, and depth towards the viewer
      const [x, y, z] = p.map((v, i) => v - this.middle[i]);
      const side = -sa * x + ca * y, out = ca * x + sa * y, depth = cb * out + sb * z, up = -sb * out + cb * z;
      const k = scale * far / (far - depth);
      return [width / 2 + k * side, height / 2 - k * up, depth];
    };
    const line = (points, color, thick) => {
      ctx.strokeStyle = color; ctx.lineWidth = thick;
      ctx.beginPath();
      points.map(seen).forEach(([x, y], i) => i ? ctx.lineTo(x, y) : ctx.moveTo(x, y));
      ctx.stroke();
    };
    if (film.ground !== null) {
      const step = this.radius / 3, g = film.ground, [mx, my] = this.middle;
      for (let i = -4; i <= 4; ++i) {
        line([[mx + i * step, my - 4 * step, g], [mx + i * step, my + 4 * step, g]], "#d8d8d8", 1);
        line([[mx - 4 * step, my + i * step, g], [mx + 4 * step, my + i * step, g]], "#d8d8d8", 1);
      }
    }
    const tip = this.tip ??= film.links.length > 1 ? null : this.furthest();
    if (tip) {
      const from = Math.max(0, n - 60);
      line(film.frames.slice(from, n + 1).map(f => placed(f[0], tip)), "#8a8a8a", 1.5);
    }
    const faces = [];
    film.frames[n].forEach((pose, i) => {
      const p = this.boxes[i].map(c => placed(pose, c)), s = p.map(seen);
      FACES.forEach((face, f) => {
        const [a, b, c] = face.map(k => s[k]);
        if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) >= 0) return;  // hidden: it faces away
        const q = face.map(k => p[k]), u = q[1].map((v, k) => v - q[0][k]), v = q[3].map((w, k) => w - q[0][k]);
        const normal = u[0] * v[1] - u[1] * v[0], area = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], normal) || 1;
        const light = .72 + .28 * Math.abs(normal) / area;
        faces.push({depth: face.reduce((sum, k) => sum + s[k][2], 0), points: face.map(k => s[k]), color: FACE_COLORS[f].map(x => Math.round(x * light))});
      });
      const {centre, joints} = film.links[i];
      for (const joint of joints.length ? joints : [centre]) line([placed(pose, [0, 0, 0]), placed(pose, joint)], "#444", 2.5);
    });
    for (const {points, color} of faces.sort((a, b) => a.depth - b.depth)) {
      ctx.fillStyle = `rgb(${color})`; ctx.strokeStyle = "#1b1b1b"; ctx.lineWidth = .8;
      ctx.beginPath();
      points.forEach(([x, y], i) => i ? ctx.lineTo(x, y) : ctx.moveTo(x, y));
      ctx.closePath(); ctx.fill(); ctx.stroke();
    }
  }
  furthest() {  // the end of a single body's longest axis; the path of this point is drawn
    const link = this.film.links[0], i = link.half.indexOf(Math.max(...link.half));
    return [0, 1, 2].map(k => link.centre[k] + link.axes[3 * k + i] * link.half[i]);
  }
}

document.querySelectorAll(".films").forEach(home => {
  const own = JSON.parse(home.dataset.films);
  whenOpened(home, () => own.forEach(i => new Player(films[i], home)));
});
