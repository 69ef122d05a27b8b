// What happened along the surface of the work pieces: a chart over arc length that follows the player, and the same as
// a band on the surface in the enlargement.
const BAND = 0.06;  // of the shorter side of the enlargement: the band's width at the largest value

class Along {
  constructor(parent, content, size) {
    Object.assign(this, content);
    this.decoded = new Map();
    const arcs = content.contours.flatMap((contour) => contour.arc);
    this.across = [0, Math.max(...arcs)];
    this.plot = new Plot(parent, {title: ""}, `along the surface  ${content.unit}`, this.across, [0, 1], size);
    this.plot.caption.replaceChildren();
    this.select = html("select", {id: "along", "aria-label": "Drawn along the surface"}, this.plot.caption);
    content.quantities.forEach((q, i) => html("option", {value: i}, this.select, `${q.label}  [${q.unit}]`));
    this.note = html("div", {class: "note"}, this.plot.figure);
    this.plot.listen((arc) => { this.arc = arc; this.tell(); });
    this.arc = null;
  }

  // The row of values at each time.
  async choose(index) {
    if (!this.decoded.has(index)) this.decoded.set(index, await codes(this.quantities[index].codes));
    this.quantity = this.quantities[index];
    this.codes = this.decoded.get(index);
    this.prepare();
  }

  value(code) {
    const {low, high} = this.quantity;
    return code === NO_VALUE ? null : low + code / (NO_VALUE - 1) * (high - low);
  }

  // Of each contour its values in `row`.
  row(row) {
    const count = this.codes.length / this.times.length;
    let at = row * count;
    return this.contours.map(({arc}) => arc.map(() => this.value(this.codes[at++])));
  }

  mean() {
    const sums = this.contours.map(({arc}) => arc.map(() => 0));
    this.times.forEach((_, k) => this.row(k).forEach((values, c) => values.forEach((v, i) => { sums[c][i] += v / this.times.length; })));
    return sums;
  }

  // Axes, corners, and what stays: a few times of a sum, the mean of anything else.
  prepare() {
    const {plot, quantity} = this, {top, bottom, height} = plot.size, last = this.times.length - 1;
    const most = Math.max(quantity.high, quantity.low + 1e-300) * 1.06;
    plot.span(this.across, [quantity.low * 1.06, most]);
    for (const arc of new Set(this.contours.flatMap((contour) => contour.corners.map((k) => contour.arc[k].toFixed(3)))))
      svg("line", {class: "edge", x1: plot.x(arc), x2: plot.x(arc), y1: top, y2: height - bottom}, plot.picture);
    const kept = [...new Set([0.25, 0.5, 0.75, 1].map((share) => Math.round(share * last)))].filter((k) => k > 0);
    const faint = quantity.kind === "sum" ? kept.map((k) => this.row(k)) : [this.mean()];
    for (const values of faint)
      values.forEach((v, c) => svg("path", {class: "line faint", d: this.pathOf(c, v), stroke: colourOf(c)}, plot.picture));
    this.note.textContent = (quantity.kind === "sum" ? `Faint: at ${kept.map((k) => +this.times[k].toPrecision(3)).join(", ")} s.` : "Faint: mean over the run.")
      + (this.contours.some((c) => c.corners.length) ? " Dotted: the edges." : "");
    this.lines = this.contours.map((_, c) => svg("path", {class: "line", stroke: colourOf(c)}, plot.picture));
    this.row0 = null;
  }

  pathOf(contour, values) {
    return this.plot.pathOf(this.contours[contour].arc.map((arc, i) => [arc, values[i]]));
  }

  moveTo(time) {
    if (!this.codes) return;
    let k = 0;
    while (k + 1 < this.times.length && this.times[k + 1] <= time * (1 + 1e-9) + 1e-12) ++k;
    this.values = this.row(k);
    this.lines.forEach((line, c) => line.setAttribute("d", this.pathOf(c, this.values[c])));
    this.tell();
  }

  // The legend: the largest of each contour, or what is under the mouse.
  tell() {
    if (!this.values) return;
    this.plot.legend.replaceChildren();
    this.contours.forEach(({label, arc}, c) => {
      const largest = Math.max(...this.values[c]);
      const value = this.arc === null ? largest : valueAt(arc.map((s, i) => [s, this.values[c][i]]), this.arc);
      this.plot.legendItem(this.arc === null ? `${label}, largest` : label, colourOf(c), "line", value);
    });
    if (this.arc !== null) html("span", {}, this.plot.legend, `at ${text(this.arc)} ${this.unit}`);
  }

  // Metres of the band at the largest value of the run.
  reach(stage) {
    const [x0, y0, x1, y1] = stage.home;
    return BAND * Math.min(x1 - x0, y1 - y0);
  }

  // A depth goes into the work piece, all else stands on it.
  draw(stage) {
    if (!this.values) return;
    const {context} = stage, largest = Math.max(this.quantity.high, -this.quantity.low);
    const length = (this.quantity.metres ? -1 : 1) * this.reach(stage) / largest;
    this.contours.forEach((contour, c) => {
      const surface = this.surfaceOf(stage, contour), colour = cssColour(`--c${c % 7}`);
      const outer = surface.map(([x, y], i) => {
        const [nx, ny] = contour.outward[i], v = length * (this.values[c][i] ?? 0);
        return [x + v * nx, y + v * ny];
      });
      const trace = (points) => points.forEach(([x, y]) => context.lineTo(...stage.toPixel(x, y)));
      context.beginPath();
      trace(surface);
      trace(outer.slice().reverse());
      context.closePath();
      context.globalAlpha = 0.7;
      context.fillStyle = "#ffffff";  // as of what is no longer there, and no colour of the particles
      context.fill();
      context.globalAlpha = 1;
      context.lineWidth = 2 * stage.ratio;
      context.strokeStyle = colour;
      context.beginPath();
      trace(outer);
      if (contour.closed) context.closePath();
      context.stroke();
    });
  }

  // The points of a contour, moved with the solid's particles.
  surfaceOf(stage, contour) {
    const solid = stage.shown.find(({body}) => body.name === "solid");
    if (!contour.particle || !solid) return contour.point;
    return contour.point.map(([x, y], i) => {
      const k = contour.particle[i], [sx, sy] = contour.offset[i];
      return [solid.places[2 * k] + sx, solid.places[2 * k + 1] + sy];
    });
  }

  // What the band means, for people.
  bandText(stage) {
    const {label, unit, metres, high, low} = this.quantity, largest = Math.max(high, -low);
    const scale = metres ? `drawn ${rounded(this.reach(stage) / (largest * metres))} times as deep` : `at its widest ${text(+largest.toPrecision(3))} ${unit}`;
    return `Band on the surface: ${label}, ${scale}.`;
  }
}

// 234567 -> 2·10⁵
function rounded(value) {
  const power = Math.floor(Math.log10(value));
  if (power < 4) return String(+value.toPrecision(2));
  return `${+(value / 10 ** power).toFixed(1)}·10${[...String(power)].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("")}`;
}
