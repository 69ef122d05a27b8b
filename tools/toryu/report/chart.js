// Line charts: axes, legend with the values under the mouse; over time with marks at the player's time.
const SVG = "http://www.w3.org/2000/svg";
const WIDE = {width: 520, height: 250, left: 58, right: 12, top: 12, bottom: 34};

function svg(name, attributes, parent) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
}

function html(name, attributes, parent, text) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  if (parent) parent.append(element);
  return element;
}

// Round numbers that cover low..high in about `count` steps.
function ticks(low, high, count) {
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((s) => s * power).find((s) => s >= raw * 0.999);
  const all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) all.push(i * step);
  return {all, step};
}

// A number for the eye; on an axis with as many decimals as its `step` asks for.
function text(value, step) {
  if (value === null || value === undefined) return "–";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (step === undefined) return size < 1e-3 || size >= 1e6 ? value.toExponential(3) : String(+value.toPrecision(4));
  if (size >= 1e6 || step < 1e-5) return value.toExponential(1);
  const decimals = Math.ceil(-Math.log10(step) - 1e-9) + (step.toExponential().startsWith("2.5") ? 1 : 0);
  return value.toFixed(Math.max(0, decimals));
}

function range(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (v !== null) { low = Math.min(low, v); high = Math.max(high, v); }
  if (low > high || (low === 0 && high === 0)) return [0, 1];
  if (low > 0 && low < 0.6 * high) low = 0;
  if (high < 0 && high > 0.6 * low) high = 0;
  const margin = (high - low || Math.abs(high) || 1) * 0.05;
  return [low === 0 ? 0 : low - margin, high === 0 ? 0 : high + margin];
}

// The value of a line at `x`, linear between its points.
function valueAt(points, x) {
  let low = 0, high = points.length - 1;
  if (high < 0 || x < points[0][0]) return null;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (points[middle][0] <= x) low = middle; else high = middle - 1;
  }
  const [x0, v0] = points[low], [x1, v1] = points[Math.min(low + 1, points.length - 1)];
  return v0 === null || v1 === null || x1 === x0 ? v0 : v0 + (v1 - v0) * Math.min(1, (x - x0) / (x1 - x0));
}

const colourOf = (i) => `var(--c${i % 7})`;

// A figure with a caption, a legend and axes that span `across` and `up`; `along` names the axis below.
class Plot {
  constructor(parent, {title, unit}, along, across, up, size = WIDE) {
    const figure = this.figure = html("figure", {}, parent);
    this.caption = html("figcaption", {}, figure, title);
    if (unit) html("span", {class: "unit"}, this.caption, "  " + unit);
    this.legend = html("div", {class: "legend"}, figure);
    this.size = size;
    this.along = along;
    this.picture = svg("svg", {viewBox: `0 0 ${size.width} ${size.height}`, role: "img", "aria-label": title}, figure);
    this.span(across, up);
  }

  span([start, end], [low, high]) {
    const {width, height, left, right, top, bottom} = this.size;
    this.x = (value) => left + (value - start) / (end - start || 1) * (width - left - right);
    this.y = (value) => height - bottom - (value - low) / (high - low) * (height - top - bottom);
    this.atPixel = (x) => start + (x - left) / (width - left - right) * (end - start);
    this.picture.replaceChildren();
    this.axes([start, end], [low, high]);
  }

  axes([start, end], [low, high]) {
    const {width, height, left, right, bottom} = this.size;
    const up = ticks(low, high, height > 200 ? 5 : 4), across = ticks(start, end, 8);
    for (const value of up.all) {
      const y = this.y(value);
      svg("line", {class: "grid", x1: left, x2: width - right, y1: y, y2: y}, this.picture);
      svg("text", {x: left - 7, y: y + 4, "text-anchor": "end"}, this.picture).textContent = text(value, up.step);
    }
    const base = height - bottom;
    svg("line", {class: "axis", x1: left, x2: width - right, y1: base, y2: base}, this.picture);
    for (const value of across.all) {
      const x = this.x(value);
      svg("line", {class: "axis", x1: x, x2: x, y1: base, y2: base + 4}, this.picture);
      svg("text", {x, y: base + 17, "text-anchor": "middle"}, this.picture).textContent = text(value, across.step);
    }
    svg("text", {x: width - right, y: height - 3, "text-anchor": "end"}, this.picture).textContent = this.along;
  }

  pathOf(points) {
    let path = "", pen = "M";
    for (const [x, v] of points) {
      if (v === null) { pen = "M"; continue; }
      path += `${pen}${this.x(x).toFixed(2)},${this.y(v).toFixed(2)}`;
      pen = "L";
    }
    return path;
  }

  legendItem(label, colour, kind, value) {
    const item = html("span", {}, this.legend);
    html("i", {class: kind, style: `background:${colour};border-color:${colour}`}, item);
    item.append(label);
    if (value !== undefined) html("b", {}, item, "  " + text(value));
  }

  // Calls back with the place under the mouse on the axis below, null when it leaves.
  listen(show) {
    this.picture.addEventListener("mousemove", (event) => {
      const box = this.picture.getBoundingClientRect();
      show(this.atPixel((event.clientX - box.left) * this.size.width / box.width));
    });
    this.picture.addEventListener("mouseleave", () => show(null));
  }
}

const MOST_POINTS = 3000;  // of a line that grows: more than a chart has pixels

// Of every four points the smallest and the largest, in order; the last one always.
function thinned(points) {
  const kept = [];
  for (let i = 0; i < points.length - 1; i += 4) {
    const part = points.slice(i, Math.min(i + 4, points.length - 1)), values = part.map(([, v]) => v).filter((v) => v !== null);
    const least = part.find(([, v]) => v === Math.min(...values)), most = part.find(([, v]) => v === Math.max(...values));
    kept.push(...part.filter((point) => point === least || point === most || !values.length));
  }
  return [...kept, points.at(-1)];
}

// Lines over time.
class Chart extends Plot {
  constructor(parent, content, [start, end], size) {
    const inside = content.lines.flatMap((line) => line.points.filter((p) => p[0] <= end).map((p) => p[1]));
    super(parent, content, "time  s", [start, end], range(inside), size);
    this.content = content;
    this.drawLines();
    for (const note of content.notes || []) html("div", {class: "note"}, this.figure, note);
    this.listen((time) => this.show(time));
    this.show(null);
  }

  drawLines() {
    const {content} = this;
    content.lines.forEach((line, i) => this.draw(line, colourOf(i)));
    const {height, top, bottom} = this.size;
    this.mark = svg("line", {class: "now", y1: top, y2: height - bottom, visibility: "hidden"}, this.picture);
    this.dots = content.lines.map((line, i) => line.kind === "line" &&
      svg("circle", {class: "dot", r: 3.5, fill: colourOf(i), visibility: "hidden"}, this.picture));
  }

  // Draws anew after points were added, over the time from `start` to `end`; a line of too many is thinned.
  grow([start, end]) {
    for (const line of this.content.lines) if (line.points.length > MOST_POINTS) line.points = thinned(line.points);
    const inside = this.content.lines.flatMap((line) => line.points.filter((p) => p[0] <= end).map((p) => p[1]));
    this.span([start, end], range(inside));
    this.drawLines();
  }

  draw(line, colour) {
    if (line.kind !== "points") {
      svg("path", {class: "line", d: this.pathOf(line.points), stroke: colour}, this.picture);
      return;
    }
    for (const [t, v] of line.points) {
      if (v === null || this.x(t) > this.size.width - this.size.right + 1) continue;
      svg("circle", {cx: this.x(t), cy: this.y(v), r: 3.6, fill: "var(--paper)", stroke: colour, "stroke-width": 1.8}, this.picture);
    }
  }

  // The legend, with values at `time` if it is not null.
  show(time) {
    this.legend.replaceChildren();
    this.content.lines.forEach((line, i) => this.legendItem(line.label, colourOf(i), line.kind,
      time !== null && line.kind === "line" ? valueAt(line.points, time) : undefined));
    if (time !== null) html("span", {}, this.legend, `at ${text(time)} s`);
  }

  // Marks the player's time.
  moveTo(time) {
    const x = this.x(time), seen = x <= this.size.width - this.size.right + 0.5;
    this.mark.setAttribute("x1", x);
    this.mark.setAttribute("x2", x);
    this.mark.setAttribute("visibility", seen ? "visible" : "hidden");
    this.dots.forEach((dot, i) => {
      if (!dot) return;
      const points = this.content.lines[i].points, value = valueAt(points, time);
      dot.setAttribute("visibility", seen && value !== null && time <= points.at(-1)[0] ? "visible" : "hidden");
      if (value === null) return;
      dot.setAttribute("cx", x);
      dot.setAttribute("cy", this.y(value));
    });
  }
}
