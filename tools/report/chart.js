// Line charts over time: axes, legend with the values under the mouse, a mark at the player's time.
const SVG = "http://www.w3.org/2000/svg";
const CHART = {width: 520, height: 250, left: 58, right: 12, top: 12, bottom: 34};

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

// The last value of a line at or before `time`.
function valueAt(points, time) {
  let low = 0, high = points.length - 1;
  if (high < 0 || time < points[0][0]) return null;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (points[middle][0] <= time) low = middle; else high = middle - 1;
  }
  return points[low][1];
}

class Chart {
  constructor(parent, content, [start, end]) {
    this.content = content;
    const figure = html("figure", {}, parent);
    const caption = html("figcaption", {}, figure, content.title);
    if (content.unit) html("span", {class: "unit"}, caption, "  " + content.unit);
    this.legend = html("div", {class: "legend"}, figure);
    const {width, height, left, right, top, bottom} = CHART;
    this.picture = svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": content.title}, figure);
    const [low, high] = range(content.lines.flatMap((line) => line.points.filter((p) => p[0] <= end).map((p) => p[1])));
    this.x = (time) => left + (time - start) / (end - start || 1) * (width - left - right);
    this.y = (value) => height - bottom - (value - low) / (high - low) * (height - top - bottom);
    this.time = (x) => start + (x - left) / (width - left - right) * (end - start);
    this.axes([start, end], [low, high]);
    content.lines.forEach((line, i) => this.draw(line, `var(--c${i % 7})`));
    this.mark = svg("line", {class: "now", y1: top, y2: height - bottom, visibility: "hidden"}, this.picture);
    for (const note of content.notes || []) html("div", {class: "note"}, figure, note);
    this.listen();
    this.show(null);
  }

  axes([start, end], [low, high]) {
    const {width, height, left, right, top, bottom} = CHART;
    const across = ticks(low, high, 5), along = ticks(start, end, 8);
    for (const value of across.all) {
      const y = this.y(value);
      svg("line", {class: "grid", x1: left, x2: width - right, y1: y, y2: y}, this.picture);
      svg("text", {x: left - 7, y: y + 4, "text-anchor": "end"}, this.picture).textContent = text(value, across.step);
    }
    const base = height - bottom;
    svg("line", {class: "axis", x1: left, x2: width - right, y1: base, y2: base}, this.picture);
    for (const value of along.all) {
      const x = this.x(value);
      svg("line", {class: "axis", x1: x, x2: x, y1: base, y2: base + 4}, this.picture);
      svg("text", {x, y: base + 17, "text-anchor": "middle"}, this.picture).textContent = text(value, along.step);
    }
    svg("text", {x: width - right, y: height - 3, "text-anchor": "end"}, this.picture).textContent = "time  s";
  }

  draw(line, colour) {
    if (line.kind === "points") {
      for (const [t, v] of line.points) {
        if (v === null || this.x(t) > CHART.width - CHART.right + 1) continue;
        svg("circle", {cx: this.x(t), cy: this.y(v), r: 3.6, fill: "var(--paper)", stroke: colour, "stroke-width": 1.8}, this.picture);
      }
      return;
    }
    let path = "", pen = "M";
    for (const [t, v] of line.points) {
      if (v === null) { pen = "M"; continue; }
      path += `${pen}${this.x(t).toFixed(2)},${this.y(v).toFixed(2)}`;
      pen = "L";
    }
    svg("path", {class: "line", d: path, stroke: colour}, this.picture);
  }

  // The legend, with values at `time` if it is not null.
  show(time) {
    this.legend.replaceChildren();
    this.content.lines.forEach((line, i) => {
      const item = html("span", {}, this.legend);
      const colour = `var(--c${i % 7})`;
      html("i", {class: line.kind, style: `background:${colour};border-color:${colour}`}, item);
      item.append(line.label);
      if (time !== null && line.kind === "line") html("b", {}, item, "  " + text(valueAt(line.points, time)));
    });
    if (time !== null) html("span", {}, this.legend, `at ${text(time)} s`);
  }

  listen() {
    this.picture.addEventListener("mousemove", (event) => {
      const box = this.picture.getBoundingClientRect();
      this.show(this.time((event.clientX - box.left) * CHART.width / box.width));
    });
    this.picture.addEventListener("mouseleave", () => this.show(null));
  }

  // Marks the player's time.
  moveTo(time) {
    const x = this.x(time);
    this.mark.setAttribute("x1", x);
    this.mark.setAttribute("x2", x);
    this.mark.setAttribute("visibility", x <= CHART.width - CHART.right + 0.5 ? "visible" : "hidden");
  }
}
