// Joins the page: player, colour choices, charts.
const content = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

class Player {
  constructor(stage, times, charts) {
    Object.assign(this, {stage, times, charts, bars: [], playing: false, drawing: false, wanted: 0});
    byId("time").max = times.length - 1;
    byId("time").addEventListener("input", () => this.show(+byId("time").value));
    byId("play").addEventListener("click", () => this.toggle());
    byId("whole").addEventListener("click", () => { stage.fit(); this.redraw(); });
    new ResizeObserver(() => { stage.fit(); this.redraw(); }).observe(stage.canvas.parentElement);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    this.listenToCanvas();
    this.show(0);
  }

  get time() { return this.times[this.wanted]; }

  show(index) {
    this.wanted = Math.max(0, Math.min(this.times.length - 1, index));
    byId("time").value = this.wanted;
    byId("now").textContent = `${this.time.toFixed(4)} s`;
    for (const chart of this.charts) chart.moveTo(this.time);
    this.redraw();
  }

  // Draws the wanted frame; one drawing at a time, the last wish wins.
  async redraw() {
    this.stale = true;
    if (this.drawing) return;
    this.drawing = true;
    while (this.stale) {
      this.stale = false;
      await this.stage.draw(this.time);
      for (const update of this.bars) update();
    }
    this.drawing = false;
    this.stage.canvas.dataset.frame = this.wanted;
  }

  toggle() {
    this.playing = !this.playing;
    byId("play").textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return;
    if (this.wanted === this.times.length - 1) this.show(0);
    const from = this.wanted, start = performance.now();
    // The whole run takes 8 s at speed 1.
    const rate = (this.times.length - 1) / 8 / 1000;
    let shownAt = from, base = from, since = start, speed = +byId("speed").value;
    const step = (now) => {
      if (!this.playing) return;
      if (this.wanted !== shownAt || +byId("speed").value !== speed) {  // moved by hand
        base = this.wanted; since = now; speed = +byId("speed").value;
      }
      const index = Math.floor(base + (now - since) * rate * speed);
      if (index !== this.wanted) this.show(index);
      shownAt = this.wanted;
      if (this.wanted === this.times.length - 1) this.toggle(); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  listenToCanvas() {
    const {canvas} = this.stage;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [(event.clientX - box.left) * canvas.width / box.width, (event.clientY - box.top) * canvas.height / box.height];
    };
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.stage.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
      this.redraw();
    }, {passive: false});
    let last = null;
    canvas.addEventListener("pointerdown", (event) => { last = place(event); canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointerup", () => { last = null; });
    canvas.addEventListener("pointerleave", () => { byId("readout").textContent = ""; });
    canvas.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (last) {
        this.stage.move((last[0] - at[0]) / this.stage.scale, (at[1] - last[1]) / this.stage.scale);
        last = at;
        this.redraw();
      }
      this.tell(...this.stage.toScene(...at));
    });
    document.addEventListener("keydown", (event) => {
      if (["INPUT", "SELECT", "BUTTON", "SUMMARY"].includes(event.target.tagName)) return;
      if (event.key === " ") this.toggle();
      else if (event.key === "ArrowRight") this.show(this.wanted + 1);
      else if (event.key === "ArrowLeft") this.show(this.wanted - 1);
      else return;
      event.preventDefault();
    });
  }

  tell(x, y) {
    const found = this.stage.nearest(x, y);
    let line = `x ${text(found ? found.x : x)}  y ${text(found ? found.y : y)} m`;
    if (found && found.code !== undefined) {
      const q = found.body.quantities[found.body.chosen];
      line = `${found.body.name}  ${line}  ${q.label} ${text(found.body.value(found.code))} ${q.unit}`;
    }
    byId("readout").textContent = line;
  }
}

// The choice of colour of a participant with its colour bar; returns what brings the bar up to date.
function colourChoice(parent, body, changed) {
  const box = html("div", {class: "colour"}, parent);
  const row = html("div", {class: "row"}, box);
  html("span", {class: "who"}, row, body.name);
  const select = html("select", {"aria-label": `Colour of the ${body.name}`, "data-body": body.name}, row);
  body.quantities.forEach((q, i) => html("option", {value: i}, select, q.unit ? `${q.label}  [${q.unit}]` : q.label));
  const label = html("label", {}, row, "range of this frame ");
  const fitted = html("input", {type: "checkbox"}, label);
  const scale = html("div", {class: "scale"}, box), marks = html("div", {class: "marks"}, box);
  for (const control of [select, fitted])
    control.addEventListener("change", () => {
      body.fitted = fitted.checked;
      body.choose(+select.value);
      changed();
    });
  return () => {
    const stops = Array.from({length: 17}, (_, i) => `rgb(${body.table[Math.round(i * 255 / 16)]})`);
    scale.style.background = `linear-gradient(to right, ${stops})`;
    marks.replaceChildren();
    for (const share of [0, 0.25, 0.5, 0.75, 1])
      html("span", {}, marks, text(+(body.low + share * (body.high - body.low)).toPrecision(3)));
  };
}

function makeCharts(times) {
  const charts = [];
  const add = (parent, list) => { for (const one of list) charts.push(new Chart(parent, one, times)); };
  byId("compared").hidden = !content.compared.length;
  add(byId("compared").querySelector(".charts"), content.compared);
  byId("others").hidden = !Object.keys(content.others).length;
  for (const [name, list] of Object.entries(content.others)) {
    html("h3", {}, byId("others"), name);
    add(html("div", {class: "charts"}, byId("others")), list);
  }
  return charts;
}

// From 0 to the end of the run, of which the references may go on.
function span() {
  const all = [...content.compared, ...Object.values(content.others).flat()].flatMap((chart) => chart.lines);
  const ends = all.filter((line) => line.kind === "line" && line.points.length).map((line) => line.points.at(-1)[0]);
  const starts = all.filter((line) => line.kind === "line" && line.points.length).map((line) => line.points[0][0]);
  return ends.length ? [Math.min(...starts), Math.max(...ends)] : [0, 1];
}

const charts = makeCharts(span());
const bodies = content.bodies.map((body) => new Body(body));
const times = [...new Set(bodies.flatMap((body) => body.times))].sort((a, b) => a - b);
byId("motion").hidden = !times.length;
if (times.length) {
  const stage = new Stage(byId("particles"), content, bodies);
  const player = new Player(stage, times, charts);
  for (const body of bodies)
    if (body.quantities.length) player.bars.push(colourChoice(byId("colours"), body, () => player.redraw()));
}
