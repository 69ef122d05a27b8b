// Joins the page: player, colour choices, charts.
const content = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

class Player {
  // `followers`: what else follows the time by moveTo.
  constructor(stages, times, followers) {
    Object.assign(this, {stages, times, followers, bars: [], drawn: [], playing: false, drawing: false, wanted: 0});
    byId("time").max = times.length - 1;
    byId("time").addEventListener("input", () => this.show(+byId("time").value));
    byId("play").addEventListener("click", () => this.toggle());
    byId("whole").addEventListener("click", () => this.fit());
    let width = 0;
    new ResizeObserver(([{contentRect}]) => {
      if (contentRect.width === width) return;  // the stages' own height
      width = contentRect.width;
      this.fit();
    }).observe(byId("scene"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    for (const stage of stages) this.listenTo(stage);
    this.listenToKeys();
    this.show(this.nearest(content.telling.time));
  }

  fit() {
    for (const stage of this.stages) stage.fit();
    this.redraw();
  }

  get time() { return this.times[this.wanted]; }

  // The index of the frame nearest to a time; null, which stands for no end, is the last.
  nearest(time) {
    if (time === null) return this.times.length - 1;
    return this.times.reduce((best, t, k) => Math.abs(t - time) < Math.abs(this.times[best] - time) ? k : best, 0);
  }

  show(index) {
    this.wanted = Math.max(0, Math.min(this.times.length - 1, index));
    byId("time").value = this.wanted;
    byId("now").textContent = `${this.time.toFixed(4)} s`;
    for (const follower of this.followers) follower.moveTo(this.time);
    this.redraw();
  }

  // Draws the wanted frame; one drawing at a time, the last wish wins.
  async redraw() {
    this.stale = true;
    if (this.drawing) return;
    this.drawing = true;
    while (this.stale) {
      this.stale = false;
      for (const stage of this.stages) await stage.draw(this.time);
      for (const update of [...this.bars, ...this.drawn]) update();
    }
    this.drawing = false;
    for (const {canvas} of this.stages) canvas.dataset.frame = this.wanted;
  }

  toggle() {
    this.playing = !this.playing;
    byId("play").textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return this.paused?.();
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

  listenTo(stage) {
    const {canvas} = stage;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [(event.clientX - box.left) * canvas.width / box.width, (event.clientY - box.top) * canvas.height / box.height];
    };
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      stage.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
      this.redraw();
    }, {passive: false});
    let last = null;
    canvas.addEventListener("pointerdown", (event) => { last = place(event); canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointerup", () => { last = null; });
    canvas.addEventListener("pointerleave", () => { byId("readout").textContent = ""; });
    canvas.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (last) {
        stage.move((last[0] - at[0]) / stage.scale, (at[1] - last[1]) / stage.scale);
        last = at;
        this.redraw();
      }
      this.tell(stage.nearest(...stage.toScene(...at)), ...stage.toScene(...at));
    });
  }

  listenToKeys() {
    document.addEventListener("keydown", (event) => {
      if (["INPUT", "SELECT", "BUTTON", "SUMMARY"].includes(event.target.tagName)) return;
      if (event.key === " ") this.toggle();
      else if (event.key === "ArrowRight") this.show(this.wanted + 1);
      else if (event.key === "ArrowLeft") this.show(this.wanted - 1);
      else return;
      event.preventDefault();
    });
  }

  tell(found, x, y) {
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
  for (const [name, list] of Object.entries(content.others)) {
    // What the coupler tells is of the exchange and of the machine: for who looks for it.
    const folded = name === "coupler" && html("details", {}, byId("audits").querySelector("details"));
    if (folded) html("summary", {}, folded, "Series of the coupler");
    else html("h3", {}, byId("others"), name);
    add(html("div", {class: "charts"}, folded || byId("others")), list);
  }
  byId("others").hidden = !Object.keys(content.others).some((name) => name !== "coupler");
  return charts;
}

// From 0 to the end of the run, of which the references may go on.
function span() {
  const all = [...content.compared, ...Object.values(content.others).flat()].flatMap((chart) => chart.lines);
  const ends = all.filter((line) => line.kind === "line" && line.points.length).map((line) => line.points.at(-1)[0]);
  const starts = all.filter((line) => line.kind === "line" && line.points.length).map((line) => line.points[0][0]);
  return ends.length ? [Math.min(...starts), Math.max(...ends)] : [0, 1];
}

// What stands beside the picture: what moves by prescription, and what happened along the surface.
const BESIDE = {...WIDE, width: 600, height: 168};

function makeBeside() {
  const followers = content.motions.map((chart) => new Chart(byId("beside"), chart, [0, content.end], BESIDE));
  if (!content.along.quantities) return {followers};
  const along = new Along(byId("beside"), content.along, BESIDE);
  return {followers: [...followers, along], along};
}

function makeStages(bodies) {
  const [x0, y0, x1, y1] = content.view;
  const tall = (content.motions.length > 0 || content.near !== null) && y1 - y0 > 1.4 * (x1 - x0);
  byId("scene").classList.toggle("tall", tall);
  byId("near").hidden = !content.near;
  byId("beside").hidden = !byId("beside").children.length;
  const whole = new Stage(byId("particles"), content.view, content.walls, bodies, {tall});
  if (!content.near) return [whole];
  const near = new Stage(byId("enlarged"), content.near, content.walls, bodies, {tall, disc: 0.43});
  whole.over.push(() => whole.outline(near));
  return [whole, near];
}

// The displacement of a solid that moves less than the eye sees can be exaggerated.
function offerExaggeration(near, bodies, changed) {
  const solid = bodies.find((body) => body.displacement);
  if (!near || !solid) return;
  const {low, high, typical} = solid.displacement;
  if (!(typical > 0) || typical > 0.3 * solid.spacing) return;
  const wished = solid.spacing / typical, power = 10 ** Math.floor(Math.log10(wished));
  const most = [5, 2, 1].find((s) => s * power <= wished) * power;
  byId("exaggeration").hidden = false;
  for (const factor of [1, most / 10, most].filter((f) => f >= 1))
    html("option", {value: factor}, byId("factor"), factor === 1 ? "as it is" : `× ${rounded(factor)}`);
  byId("factor").value = near.factor = most;
  byId("factor").addEventListener("change", () => { near.factor = +byId("factor").value; changed(); });
}

// What is drawn otherwise than it is, for people.
function tellDrawn(near, along) {
  const solid = near.factor > 1 ? `Displacement of the solid: drawn ${rounded(near.factor)} times as large.` : "";
  byId("drawn").textContent = `${along?.quantity ? along.bandText(near) : ""} ${solid}`;
}

const {followers, along} = makeBeside();
const charts = makeCharts(span());
const bodies = content.bodies.map((body) => new Body(body));
const times = [...new Set(bodies.flatMap((body) => body.times))].sort((a, b) => a - b);
byId("motion").hidden = !times.length;
if (times.length) {
  const stages = makeStages(bodies), near = stages[1];
  if (content.telling.mark) for (const stage of stages) stage.over.push((_, time) => stage.mark(content.telling.mark, time));
  const player = new Player(stages, times, [...followers, ...charts]);
  new Saver(player);
  for (const body of bodies)
    if (body.quantities.length) player.bars.push(colourChoice(byId("colours"), body, () => player.redraw()));
  const redraw = () => {
    if (near) tellDrawn(near, along);
    player.redraw();
  };
  offerExaggeration(near, bodies, redraw);
  if (near) tellDrawn(near, along);
  if (along) {
    const choose = async () => {
      await along.choose(+along.select.value);
      along.moveTo(player.time);
      redraw();
    };
    along.select.addEventListener("change", choose);
    if (near) near.over.push((stage) => along.draw(stage));
    choose();
  }
}
