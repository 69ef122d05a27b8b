// The particles of all participants on a canvas: decoding of frames, colours, drawing, zoom.
const NO_VALUE = 65535;
const MAPS = {
  fluid: ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"],
  solid: ["#1b0c41", "#4a0c6b", "#781c6d", "#a52c60", "#cf4446", "#ed6925", "#fb9b06", "#f7d13d", "#fcffa4"],
  signed: ["#1f4e9c", "#3f7fc4", "#7fb2de", "#bcd6ea", "#dedede", "#f2c4ae", "#e58a6b", "#cc4b3b", "#96172b"],
};
const NOT_FINITE = [255, 0, 255];

// 256 colours, linear between those of the map.
function colourTable(name) {
  const anchors = MAPS[name].map((hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)));
  return Array.from({length: 256}, (_, i) => {
    const at = i / 255 * (anchors.length - 1), k = Math.min(Math.floor(at), anchors.length - 2);
    return anchors[k].map((c, j) => Math.round(c + (at - k) * (anchors[k + 1][j] - c)));
  });
}

async function inflate(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// One participant: its frames, decoded when first shown, and how it is coloured.
class Body {
  constructor(content) {
    Object.assign(this, content);
    this.decoded = new Map();
    this.fitted = false;  // the colours span the values of the frame, not of the run
    this.choose(0);
  }

  // Columns of codes: x, y, then a column a quantity.
  async frame(index) {
    if (!this.decoded.has(index)) {
      const planes = await inflate(this.frames[index]);
      const count = planes.length / 2, rows = count / (2 + this.quantities.length);
      const codes = new Uint16Array(count);
      for (let i = 0; i < count; ++i) codes[i] = planes[i] | planes[count + i] << 8;
      this.decoded.set(index, Array.from({length: 2 + this.quantities.length}, (_, k) => codes.subarray(k * rows, (k + 1) * rows)));
    }
    return this.decoded.get(index);
  }

  // The last frame at or before `time`.
  indexAt(time) {
    let index = 0;
    while (index + 1 < this.times.length && this.times[index + 1] <= time * (1 + 1e-9) + 1e-12) ++index;
    return index;
  }

  choose(quantity) {
    this.chosen = quantity;
    const q = this.quantities[quantity];
    if (!q) return;
    // A quantity of either sign gets colours that show where it is zero.
    this.signed = q.low < 0 && q.high > 0 && Math.min(-q.low, q.high) > 0.1 * Math.max(-q.low, q.high);
    this.table = colourTable(this.signed ? "signed" : MAPS[this.name] ? this.name : "fluid");
    this.span(q.low, q.high);
  }

  span(low, high) {
    const largest = Math.max(-low, high);
    [this.low, this.high] = this.signed ? [-largest, largest] : [low, high];
  }

  // Takes the range of the colours from a frame, if that is wished.
  adapt(columns) {
    if (!this.fitted) return;
    let low = NO_VALUE, high = 0;
    for (const code of columns[2 + this.chosen])
      if (code !== NO_VALUE) { low = Math.min(low, code); high = Math.max(high, code); }
    if (low < NO_VALUE) this.span(this.value(low), this.value(Math.max(high, low + 1)));
  }

  value(code) {
    const q = this.quantities[this.chosen];
    return code === NO_VALUE ? null : q.low + code / (NO_VALUE - 1) * (q.high - q.low);
  }

  // Colour of each code, in steps of 256 codes.
  palette() {
    return Array.from({length: 257}, (_, i) => {
      const share = (this.value(Math.min(i * 256, NO_VALUE - 1)) - this.low) / (this.high - this.low);
      return this.table[Math.max(0, Math.min(255, Math.round(share * 255)))];
    });
  }
}

// Discs of `radius` pixels as lists of (dx, dy, cover), one for each quarter-pixel position of the centre.
function discs(radius) {
  return Array.from({length: 16}, (_, k) => {
    const cx = (k % 4 + 0.5) / 4, cy = (Math.floor(k / 4) + 0.5) / 4, reach = Math.ceil(radius) + 1, pixels = [];
    for (let dy = -reach; dy <= reach; ++dy)
      for (let dx = -reach; dx <= reach; ++dx) {
        const cover = Math.min(1, Math.max(0, radius + 0.5 - Math.hypot(dx + 0.5 - cx, dy + 0.5 - cy)));
        if (cover > 0.02) pixels.push(dx, dy, cover);
      }
    return Float32Array.from(pixels);
  });
}

class Stage {
  constructor(canvas, content, bodies) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", {willReadFrequently: true});
    this.bodies = bodies;
    this.walls = content.walls;
    this.home = content.view;
    this.fit();
  }

  // The canvas takes the scene's proportions, within the window.
  fit() {
    const [x0, y0, x1, y1] = this.home;
    const width = Math.max(1, this.canvas.parentElement.clientWidth), ratio = window.devicePixelRatio || 1;
    const height = Math.max(220, Math.min(window.innerHeight * 0.68, width * (y1 - y0) / (x1 - x0) * 1.06));
    this.canvas.style.height = `${height}px`;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
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
    const frames = await Promise.all(this.bodies.map((body) => body.frame(body.indexAt(time))));
    const {width, height} = this.canvas;
    this.context.clearRect(0, 0, width, height);
    this.drawWalls(time);
    const image = this.context.getImageData(0, 0, width, height);
    this.bodies.forEach((body, i) => {
      body.adapt(frames[i]);
      this.drawBody(image, body, frames[i]);
    });
    this.context.putImageData(image, 0, 0);
    this.shown = frames;
  }

  drawWalls(time) {
    this.context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--wall");
    for (const {box, path} of this.walls) {
      const [dx, dy] = displacement(path, time);
      const [x0, y0] = this.toPixel(box[0] + dx, box[3] + dy), [x1, y1] = this.toPixel(box[2] + dx, box[1] + dy);
      this.context.fillRect(x0, y0, x1 - x0, y1 - y0);
    }
  }

  drawBody(image, body, columns) {
    const [xs, ys] = columns, field = columns[2 + body.chosen], palette = body.palette();
    const [ox, oy, ex, ey] = body.box, {width, height} = this.canvas, pixels = image.data;
    // Discs of this size cover a square lattice without holes.
    const masks = discs(Math.max(0.7, 0.6 * body.spacing * this.scale));
    for (let i = 0; i < xs.length; ++i) {
      if (xs[i] === NO_VALUE) continue;
      const [px, py] = this.toPixel(ox + xs[i] / (NO_VALUE - 1) * (ex - ox), oy + ys[i] / (NO_VALUE - 1) * (ey - oy));
      const left = Math.floor(px), top = Math.floor(py);
      const mask = masks[Math.floor((px - left) * 4) + 4 * Math.floor((py - top) * 4)];
      const colour = !field ? palette[0] : field[i] === NO_VALUE ? NOT_FINITE : palette[field[i] >> 8];
      for (let k = 0; k < mask.length; k += 3) {
        const x = left + mask[k], y = top + mask[k + 1];
        if (x < 0 || x >= width || y < 0 || y >= height) continue;
        const at = 4 * (y * width + x), cover = mask[k + 2];
        // Over what is there; an empty pixel takes the colour and is as opaque as it is covered.
        const below = pixels[at + 3] / 255 * (1 - cover), alpha = cover + below;
        for (let c = 0; c < 3; ++c) pixels[at + c] = (colour[c] * cover + pixels[at + c] * below) / alpha;
        pixels[at + 3] = 255 * alpha;
      }
    }
  }

  // The particle nearest to a place, if it lies under the mouse: {body, x, y, code}.
  nearest(x, y) {
    let found = null;
    this.bodies.forEach((body, b) => {
      if (!this.shown) return;
      const [xs, ys] = this.shown[b], [ox, oy, ex, ey] = body.box;
      let least = (0.7 * body.spacing) ** 2;
      for (let i = 0; i < xs.length; ++i) {
        const px = ox + xs[i] / (NO_VALUE - 1) * (ex - ox), py = oy + ys[i] / (NO_VALUE - 1) * (ey - oy);
        const distance = (px - x) ** 2 + (py - y) ** 2;
        if (distance < least) { least = distance; found = {body, x: px, y: py, code: this.shown[b][2 + body.chosen]?.[i]}; }
      }
    });
    return found;
  }
}

function displacement(path, time) {
  let k = 0;
  while (k + 1 < path.length && path[k + 1][0] <= time) ++k;
  if (!path.length) return [0, 0];
  if (k + 1 === path.length) return path[k].slice(1);
  const share = Math.max(0, (time - path[k][0]) / (path[k + 1][0] - path[k][0]));
  return [1, 2].map((c) => path[k][c] + share * (path[k + 1][c] - path[k][c]));
}
