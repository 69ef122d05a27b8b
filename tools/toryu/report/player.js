// Plays the frames of a page: the time, the keys and the mouse, the choice of colours.
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
    return nearestTo(time, this.times);
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

// Five numbers from `low` to `high`, with more digits where the range is narrow: they would all be alike.
function marksBetween(low, high) {
  const apart = Math.max(Math.abs(low), Math.abs(high)) / (high - low);
  const digits = Math.min(7, 3 + Math.max(0, Math.floor(Math.log10(apart)) || 0));
  return [0, 0.25, 0.5, 0.75, 1].map((share) => {
    const value = +(low + share * (high - low)).toPrecision(digits);
    return digits > 4 ? String(value) : text(value);
  });
}

// The choice of colour of a participant, of one run or of two, with its colour bar; returns what brings the bar up to date.
function colourChoice(parent, bodies, changed) {
  const [{name, quantities}] = bodies;
  const box = html("div", {class: "colour"}, parent);
  const row = html("div", {class: "row"}, box);
  html("span", {class: "who"}, row, name);
  const select = html("select", {"aria-label": `Colour of the ${name}`, "data-body": name}, row);
  const options = quantities.map((_, i) => html("option", {value: i}, select));
  const label = html("label", {}, row, "range of this frame ");
  const fitted = html("input", {type: "checkbox"}, label);
  const scale = html("div", {class: "scale"}, box), marks = html("div", {class: "marks"}, box);
  for (const control of [select, fitted])
    control.addEventListener("change", () => {
      for (const body of bodies) {
        body.fitted = fitted.checked;
        body.choose(+select.value);
      }
      changed();
    });
  return () => {
    const body = bodies.find((one) => one.style === "coloured") || bodies[0];
    const stops = Array.from({length: 17}, (_, i) => `rgb(${body.table[Math.round(i * 255 / 16)]})`);
    scale.style.background = `linear-gradient(to right, ${stops})`;
    body.quantities.forEach((q, i) => { options[i].textContent = q.unit ? `${q.label}  [${q.unit}]` : q.label; });
    marks.replaceChildren();
    for (const mark of marksBetween(body.low, body.high)) html("span", {}, marks, mark);
  };
}

