// The particles of a participant: decoding of frames, colours, discs.
const NO_VALUE = 65535;
const MAPS = {
  fluid: ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"],
  solid: ["#1b0c41", "#4a0c6b", "#781c6d", "#a52c60", "#cf4446", "#ed6925", "#fb9b06", "#f7d13d", "#fcffa4"],
  signed: ["#1f4e9c", "#3f7fc4", "#7fb2de", "#bcd6ea", "#dedede", "#f2c4ae", "#e58a6b", "#cc4b3b", "#96172b"],
};
const NOT_FINITE = [255, 0, 255], WITHOUT_VALUES = [128, 128, 128];

const nearestTo = (time, times) => times.reduce((best, t, k) => Math.abs(t - time) < Math.abs(times[best] - time) ? k : best, 0);
const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.trim().slice(i, i + 2), 16));

// 256 colours, linear between those of the map.
function colourTable(name) {
  const anchors = MAPS[name].map(channels);
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

async function codes(base64) {
  const planes = await inflate(base64), count = planes.length / 2, all = new Uint16Array(count);
  for (let i = 0; i < count; ++i) all[i] = planes[i] | planes[count + i] << 8;
  return all;
}

// One participant: its frames, decoded when first shown, and how it is coloured.
class Body {
  constructor(content) {
    Object.assign(this, content);
    this.decoded = new Map();
    this.style = "coloured";  // or "outlined", or "hidden"
    this.fitted = false;  // the colours span the values of the frame, not of the run
    this.choose(0);
  }

  // Columns of codes: x, y, then a column a quantity.
  async frame(index) {
    if (!this.decoded.has(index)) {
      const all = await codes(this.frames[index]), rows = all.length / (2 + this.quantities.length);
      this.decoded.set(index, Array.from({length: 2 + this.quantities.length}, (_, k) => all.subarray(k * rows, (k + 1) * rows)));
    }
    return this.decoded.get(index);
  }

  // Where the particles of a frame are, x before y of each, nan of those that are not drawn. A displacement below half
  // a spacing is drawn `factor` times as large; what is farther, one sees.
  places(columns, factor = 1) {
    const [xs, ys] = columns, [ox, oy, ex, ey] = this.box, places = new Float64Array(2 * xs.length);
    for (let i = 0; i < xs.length; ++i) {
      places[2 * i] = xs[i] === NO_VALUE ? NaN : ox + xs[i] / (NO_VALUE - 1) * (ex - ox);
      places[2 * i + 1] = oy + ys[i] / (NO_VALUE - 1) * (ey - oy);
    }
    if (factor === 1 || !this.displacement) return places;
    const {columns: [kx, ky], low, high} = this.displacement;
    const metres = (k, axis, i) => low[axis] + columns[k][i] / (NO_VALUE - 1) * (high[axis] - low[axis]);
    for (let i = 0; i < xs.length; ++i) {
      const dx = metres(kx, 0, i), dy = metres(ky, 1, i);
      if (Math.hypot(dx, dy) > 0.5 * this.spacing) continue;
      places[2 * i] += (factor - 1) * dx;
      places[2 * i + 1] += (factor - 1) * dy;
    }
    return places;
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
    this.signed = q.signed;
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
    if (!this.quantities.length) return [WITHOUT_VALUES];
    return Array.from({length: 257}, (_, i) => {
      const share = (this.value(Math.min(i * 256, NO_VALUE - 1)) - this.low) / (this.high - this.low);
      return this.table[Math.max(0, Math.min(255, Math.round(share * 255)))];
    });
  }
}

// Discs of `radius` pixels as lists of (dx, dy, cover), one for each quarter-pixel position of the centre.
const CENTRED = 10;
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
