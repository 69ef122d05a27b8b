// A canvas that shows a part of the scene: walls, particles, what is drawn over them; zoom and pan.
const MOST_HEIGHT = 0.68;  // of the window, of a picture that takes the page's width
const OUTLINE = 1.5;  // [pixels of the page]
const GAP = 0.4;  // in spacings: an outline closes what is twice as wide, as between particles in disorder
const cssColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

class Stage {
  // `home`: the box shown at first. `disc`: radius of a particle in spacings; 0.7 covers a square lattice without holes.
  constructor(canvas, home, walls, bodies, {disc = 0.7, tall = false} = {}) {
    Object.assign(this, {canvas, home, walls, bodies, disc, tall, factor: 1, over: []});
    this.context = canvas.getContext("2d", {willReadFrequently: true});
    this.fit();
  }

  // The canvas takes the proportions of its home, within the window: a tall one its height, any other its width.
  fit() {
    const [x0, y0, x1, y1] = this.home, ratio = window.devicePixelRatio || 1, holder = this.canvas.parentElement;
    const slenderness = (y1 - y0) / (x1 - x0);
    let width, height;
    if (this.tall) {
      height = Math.max(480, Math.min(window.innerHeight * 0.82, 860));
      width = Math.max(110, Math.min(height / slenderness, 0.42 * holder.closest(".scene").clientWidth));
      holder.style.width = `${width}px`;
    } else {
      width = Math.max(1, holder.clientWidth);
      height = Math.max(220, Math.min(window.innerHeight * MOST_HEIGHT, width * slenderness * 1.06));
    }
    this.canvas.style.height = `${height}px`;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.ratio = ratio;
    this.scale = 0.97 * Math.min(this.canvas.width / (x1 - x0), this.canvas.height / (y1 - y0));
    this.centre = [(x0 + x1) / 2, (y0 + y1) / 2];
  }

  toPixel(x, y) {
    return [this.canvas.width / 2 + (x - this.centre[0]) * this.scale, this.canvas.height / 2 - (y - this.centre[1]) * this.scale];
  }
  toScene(px, py) {
    return [this.centre[0] + (px - this.canvas.width / 2) / this.scale, this.centre[1] - (py - this.canvas.height / 2) / this.scale];
  }
  zoom(factor, px, py) {
    const [x, y] = this.toScene(px, py);
    this.scale *= factor;
    const [nx, ny] = this.toScene(px, py);
    this.move(x - nx, y - ny);
  }
  move(dx, dy) {
    this.centre = [this.centre[0] + dx, this.centre[1] + dy];
  }

  async draw(time) {
    const bodies = this.bodies.filter(({style}) => style !== "hidden");
    const frames = await Promise.all(bodies.map((body) => body.frame(body.indexAt(time))));
    const {width, height} = this.canvas;
    this.context.clearRect(0, 0, width, height);
    this.drawWalls(time);
    const image = this.context.getImageData(0, 0, width, height);
    this.shown = [];
    bodies.forEach((body, i) => {
      body.adapt(frames[i]);
      const places = body.places(frames[i], this.factor), field = frames[i][2 + body.chosen];
      if (body.style === "outlined") return this.drawOutline(image, body, places);
      this.drawBody(image, body, places, field);
      this.shown.push({body, places, field});
    });
    this.context.putImageData(image, 0, 0);
    for (const draw of this.over) draw(this, time);
    this.drawScaleBar();
  }

  drawWalls(time) {
    for (const wall of this.walls) {
      this.context.fillStyle = cssColour(wall.poses.length ? "--moving" : wall.work_piece ? "--piece" : "--wall");
      this.trace(wall, time);
      this.context.fill("evenodd");
    }
  }

  outlineWalls(walls, time) {
    this.context.strokeStyle = cssColour("--second");
    this.context.lineWidth = OUTLINE * this.ratio;
    for (const wall of walls) {
      this.trace(wall, time);
      this.context.stroke();
    }
  }

  // The rings of a wall as the context's path.
  trace(wall, time) {
    const place = placing(wall, time);
    this.context.beginPath();
    for (const ring of wall.rings.length ? wall.rings : [cornersOf(wall)]) {
      ring.forEach((corner, k) => this.context[k ? "lineTo" : "moveTo"](...this.toPixel(...place(corner))));
      this.context.closePath();
    }
  }

  drawBody(image, body, places, field) {
    const palette = body.palette(), pixels = image.data;
    this.coverBy(body, places, (i, pixel, cover) => {
      const colour = !field ? palette[0] : field[i] === NO_VALUE ? NOT_FINITE : palette[field[i] >> 8], at = 4 * pixel;
      // Over what is there; an empty pixel takes the colour and is as opaque as it is covered.
      const below = pixels[at + 3] / 255 * (1 - cover), alpha = cover + below;
      for (let c = 0; c < 3; ++c) pixels[at + c] = (colour[c] * cover + pixels[at + c] * below) / alpha;
      pixels[at + 3] = 255 * alpha;
    });
  }

  // The edge of what drawBody would fill, without the gaps between neighbours.
  drawOutline(image, body, places) {
    const colour = channels(cssColour("--second")), pixels = image.data;
    for (const pixel of edgeOf(this.areaOf(body, places), this.canvas.width, Math.max(1, Math.round(OUTLINE * this.ratio)))) {
      for (let c = 0; c < 3; ++c) pixels[4 * pixel + c] = colour[c];
      pixels[4 * pixel + 3] = 255;
    }
  }

  // 1 for each pixel that a body covers: its discs are drawn larger, which closes gaps, and what that adds is taken off.
  areaOf(body, places) {
    const {width, height} = this.canvas, more = GAP * body.spacing * this.scale, area = new Uint8Array(width * height);
    this.coverBy(body, places, (_, pixel, cover) => { if (cover > 0.5) area[pixel] = 1; }, more);
    const disc = discs(more)[CENTRED], taken = area.slice();
    for (const pixel of edgeOf(area, width, 1)) {
      const x = pixel % width, y = Math.floor(pixel / width);
      for (let k = 0; k < disc.length; k += 3) {
        const px = x + disc[k], py = y + disc[k + 1];
        if (disc[k + 2] > 0.5 && px >= 0 && px < width && py >= 0 && py < height) taken[py * width + px] = 0;
      }
    }
    return taken;
  }

  // Tells `paint` every pixel of each particle's disc, `more` pixels wider: (number of the particle, pixel, cover).
  coverBy(body, places, paint, more = 0) {
    const {width, height} = this.canvas;
    const radius = Math.max(0.7, this.disc * body.spacing * this.scale) + more, masks = discs(radius);
    for (let i = 0; 2 * i < places.length; ++i) {
      const [px, py] = this.toPixel(places[2 * i], places[2 * i + 1]);
      const left = Math.floor(px), top = Math.floor(py);
      if (!(px > -radius && px < width + radius && py > -radius && py < height + radius)) continue;
      const mask = masks[Math.floor((px - left) * 4) + 4 * Math.floor((py - top) * 4)];
      for (let k = 0; k < mask.length; k += 3) {
        const x = left + mask[k], y = top + mask[k + 1];
        if (x >= 0 && x < width && y >= 0 && y < height) paint(i, y * width + x, mask[k + 2]);
      }
    }
  }

  // A round length that takes a quarter of the width or less.
  drawScaleBar() {
    const {context, ratio, canvas} = this;
    const power = 10 ** Math.floor(Math.log10(0.3 * canvas.width / this.scale));
    const length = [5, 2, 1].map((s) => s * power).find((s) => s * this.scale <= 0.3 * canvas.width) || power;
    const label = length >= 1 ? `${text(length)} m` : length >= 1e-3 * 0.999 ? `${text(length * 1e3)} mm` : `${text(length * 1e6)} µm`;
    const x = 8 * ratio, y = canvas.height - 9 * ratio;
    context.font = `${12 * ratio}px system-ui, "DejaVu Sans", sans-serif`;
    const wide = Math.max(length * this.scale, context.measureText(label).width);
    context.globalAlpha = 0.8;
    context.fillStyle = cssColour("--paper");
    context.fillRect(x - 5 * ratio, y - 20 * ratio, wide + 10 * ratio, 26 * ratio);
    context.globalAlpha = 1;
    context.fillStyle = cssColour("--ink");
    context.fillRect(x, y, length * this.scale, 2 * ratio);
    context.fillText(label, x, y - 6 * ratio);
  }

  // A ring around the particle that failed, in the last frame before.
  mark({body, particle, time, x, y}, now) {
    const of = this.bodies.find(({name}) => name === body), {context, ratio} = this;
    if (!of || of.times[of.indexAt(now)] < time) return;
    const [px, py] = this.toPixel(x, y), radius = Math.max(3 * of.spacing * this.scale, 9 * ratio);
    context.strokeStyle = context.fillStyle = cssColour("--bad");
    context.lineWidth = 2.5 * ratio;
    context.beginPath();
    context.arc(px, py, radius, 0, 2 * Math.PI);
    context.stroke();
    context.font = `600 ${13 * ratio}px system-ui, "DejaVu Sans", sans-serif`;
    const label = `particle ${particle}`, wide = context.measureText(label).width;
    context.fillText(label, px + radius + wide + 8 * ratio < this.canvas.width ? px + radius + 5 * ratio : px - radius - wide - 5 * ratio,
                     py - radius > 14 * ratio ? py - radius : py + radius + 12 * ratio);
  }

  // The outline of what another stage shows.
  outline(other) {
    const [x0, y0] = this.toPixel(...other.toScene(0, 0)), [x1, y1] = this.toPixel(...other.toScene(other.canvas.width, other.canvas.height));
    this.context.strokeStyle = cssColour("--accent");
    this.context.lineWidth = 1.5 * this.ratio;
    this.context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  }

  // The particle nearest to a place, if it lies under the mouse: {body, x, y, code}.
  nearest(x, y) {
    let found = null;
    for (const {body, places, field} of this.shown || []) {
      let least = (0.7 * body.spacing) ** 2;
      for (let i = 0; 2 * i < places.length; ++i) {
        const distance = (places[2 * i] - x) ** 2 + (places[2 * i + 1] - y) ** 2;
        if (distance < least) { least = distance; found = {body, x: places[2 * i], y: places[2 * i + 1], code: field?.[i]}; }
      }
    }
    return found;
  }
}

// The covered pixels of an area that lie within `wide` of one that is not.
function edgeOf(area, width, wide) {
  const height = area.length / width, found = [];
  for (let y = wide; y < height - wide; ++y)
    for (let x = wide; x < width - wide; ++x) {
      const pixel = y * width + x;
      if (area[pixel] && !(area[pixel - wide] && area[pixel + wide] && area[pixel - wide * width] && area[pixel + wide * width]))
        found.push(pixel);
    }
  return found;
}

// Corners of a wall that is a box, or the ellipse in it.
function cornersOf({box: [x0, y0, x1, y1], round}) {
  if (!round) return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  return Array.from({length: 96}, (_, k) => [Math.cos(k * Math.PI / 48), Math.sin(k * Math.PI / 48)]).map(([c, s]) =>
    [(x0 + x1) / 2 + c * (x1 - x0) / 2, (y0 + y1) / 2 + s * (y1 - y0) / 2]);
}

// Where a point of a wall is at `time`.
function placing({about, poses}, time) {
  if (!poses.length) return (corner) => corner;
  let k = 0;
  while (k + 2 < poses.length && poses[k + 1][0] <= time) ++k;
  const [from, to] = [poses[k], poses[Math.min(k + 1, poses.length - 1)]];
  const share = to[0] > from[0] ? Math.min(1, Math.max(0, (time - from[0]) / (to[0] - from[0]))) : 0;
  const [x, y, angle] = [1, 2, 3].map((c) => from[c] + share * (to[c] - from[c])), cos = Math.cos(angle), sin = Math.sin(angle);
  return ([px, py]) => {
    const [rx, ry] = [px - about[0], py - about[1]];
    return [x + cos * rx - sin * ry, y + sin * rx + cos * ry];
  };
}
