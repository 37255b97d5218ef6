// Maps: every pixel has the colour of its cell, so that uneven axes are drawn as they are.

const HATCH = 8; // pixels from stripe to stripe
const [DARK, LIGHT, PALE] = [0xff262626, 0xffffffff, 0xffc8c8a0]; // alpha, blue, green, red

// The colour of a pixel where there is no value: grey with crossed stripes.
function gapColour(x, y, period) {
  return (x + y) % period < 1 || (x - y + 4096 * period) % period < 1 ? 0xff9a9a9a : 0xffd4d4d4;
}

class ValueMap {
  constructor(study, part, ranges) {
    Object.assign(this, { study, part, ranges });
    this.Pixels = part.image.data.image[0].constructor;
    this.colours = Uint32Array.from(study.palette, (text) => {
      const [red, green, blue] = [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
      return (0xff000000 | (blue << 16) | (green << 8) | red) >>> 0;
    });
  }

  // The lowest and the highest value on the map, or of all scenes, as places along the colours.
  limits(variable, start, x, y, { log, whole }) {
    const { strides, sizes } = this.study;
    let [low, high] = [Infinity, -Infinity];
    if (whole) [low, high] = [log ? variable.leastPositive : variable.least, variable.greatest];
    for (let j = 0; !whole && j < sizes[y]; j++) {
      for (let i = 0; i < sizes[x]; i++) {
        const value = variable.values[start + j * strides[y] + i * strides[x]];
        if (!(log ? value > 0 : value === value)) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (low === null || !(low <= high)) [low, high] = log ? [1, 1] : [0, 0];
    if (log) [low, high] = [Math.log10(low), Math.log10(high)];
    const pad = high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? 0 : 0.05 * (Math.abs(high) || 1);
    return [low - pad, high + pad];
  }

  // Draw a variable over axes x and y, at the places of the others; the bits of `marked` are hatched.
  paint(variable, { at, x, y, log, whole, marked }) {
    const { study, part, colours, ranges } = this;
    const { strides, axes } = study;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const pixelsOf = (size) => Math.round(Math.min(2000, Math.max(40, size * ratio)));
    const cellsAlong = (axis, { start, end }, size) =>
      Int32Array.from({ length: size }, (_, i) => cellAt(axis.edges, start + ((i + 0.5) * (end - start)) / size));
    const [width, height] = [pixelsOf(part.figure.inner_width), pixelsOf(part.figure.inner_height)];
    const [columns, rows] = [cellsAlong(axes[x], ranges.x, width), cellsAlong(axes[y], ranges.y, height)];
    const start = study.numberOf(at) - at[x] * strides[x] - at[y] * strides[y];
    const [low, high] = this.limits(variable, start, x, y, { log, whole });
    const shadeOf = (value) => {
      if (Number.isNaN(value)) return -1;
      if (log && value <= 0) return -2;
      return Math.max(0, Math.min(255, Math.floor((((log ? Math.log10(value) : value) - low) / (high - low)) * 256)));
    };
    const period = Math.round(HATCH * ratio);
    const bits = marked & study.bitsOf(variable);
    const pixels = new Uint32Array(width * height);
    let [shades, before] = [[], -1];
    for (let j = 0; j < height; j++) {
      if (rows[j] < 0) continue;
      const row = start + rows[j] * strides[y];
      if (rows[j] !== before) shades = Array.from({ length: study.sizes[x] }, (_, i) => shadeOf(variable.values[row + i * strides[x]]));
      before = rows[j];
      for (let i = 0; i < width; i++) {
        if (columns[i] < 0) continue;
        const shade = shades[columns[i]];
        let colour = shade >= 0 ? colours[shade] : shade === -1 ? gapColour(i, j, period) : LIGHT;
        const flags = shade === -1 ? 0 : study.status[row + columns[i] * strides[x]] & bits;
        for (let k = 0; flags >> k; k++) {
          if ((flags >> k) & 1 && MARKS[k](i, j, period)) colour = shade >= 0 && shade < 90 ? LIGHT : DARK;
        }
        pixels[j * width + i] = colour;
      }
    }
    part.mapper.setv({ low, high });
    const [xs, ys] = [ranges.x, ranges.y];
    const image = [new this.Pixels(pixels, [height, width])];
    part.image.data = { image, x: [xs.start], y: [ys.start], dw: [xs.end - xs.start], dh: [ys.end - ys.start] };
    return lookOf(log);
  }

  // Mark the cell of a scene.
  point(at, x, y) {
    const [along, up] = [this.study.axes[x], this.study.axes[y]];
    const [left, right] = along.edges.slice(at[x], at[x] + 2);
    const [bottom, top] = up.edges.slice(at[y], at[y] + 2);
    const cell = { x: along.places[at[x]], y: up.places[at[y]], left, right, bottom, top };
    this.part.cell.data = Object.fromEntries(Object.entries(cell).map(([name, value]) => [name, [value]]));
  }
}
