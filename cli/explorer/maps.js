// Maps: every pixel has the colour of its cell, so that uneven axes are drawn as they are.

const HATCH = 8; // pixels from stripe to stripe
const DARK = 0xff262626; // alpha, blue, green, red
const LIGHT = 0xffffffff;
const PALE = 0xffc8c8a0;
const GAP = 0xffd4d4d4;
const GAP_STRIPE = 0xff9a9a9a;

// The colour of a pixel where there is no value: grey with crossed stripes.
function gapColour(x, y, period) {
  return (x + y) % period < 1 || (x - y + 4096 * period) % period < 1 ? GAP_STRIPE : GAP;
}

// The colours of a palette as pixels.
function pixelsOf(palette) {
  return Uint32Array.from(palette, (text) => {
    const number = parseInt(text.slice(1), 16);
    return (0xff000000 | ((number & 0xff) << 16) | (number & 0xff00) | (number >> 16)) >>> 0;
  });
}

// The cell under each pixel of a side.
function cellsAlong(axis, start, end, size) {
  const cells = new Int32Array(size);
  for (let i = 0; i < size; i++) cells[i] = cellAt(axis.edges, start + ((i + 0.5) * (end - start)) / size);
  return cells;
}

class ValueMap {
  constructor(study, part, ranges) {
    Object.assign(this, { study, part, ranges, colours: pixelsOf(study.palette) });
    this.Pixels = part.image.data.image[0].constructor;
  }

  // The lowest and highest colour: those of all scenes, or of the cells of this map.
  limits(variable, log, at, x, y, whole) {
    if (whole) return [log ? variable.leastPositive : variable.least, variable.greatest];
    let [low, high] = [Infinity, -Infinity];
    const { strides, sizes } = this.study;
    const start = this.study.numberOf(at) - at[x] * strides[x] - at[y] * strides[y];
    for (let j = 0; j < sizes[y]; j++) {
      for (let i = 0; i < sizes[x]; i++) {
        const value = variable.values[start + j * strides[y] + i * strides[x]];
        if (!(log ? value > 0 : value === value)) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    return low <= high ? [low, high] : [log ? 1 : 0, 1];
  }

  // Draw a variable over axes x and y, at the places of the others.
  paint(variable, { at, x, y, log, whole, marked }) {
    const { study, part, colours } = this;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.round(Math.min(2000, Math.max(40, part.figure.inner_width * ratio)));
    const height = Math.round(Math.min(2000, Math.max(40, part.figure.inner_height * ratio)));
    const [xs, ys] = [this.ranges.x, this.ranges.y];
    const columns = cellsAlong(study.axes[x], xs.start, xs.end, width);
    const rows = cellsAlong(study.axes[y], ys.start, ys.end, height);
    const place = log ? Math.log10 : (value) => value;
    let [low, high] = this.limits(variable, log, at, x, y, whole).map(place);
    if (low === null || !(high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high)))) {
      [low, high] = [low - 0.05 * (Math.abs(low) || 1), high + 0.05 * (Math.abs(high) || 1)];
    }
    const period = Math.round(HATCH * ratio);
    const start = study.numberOf(at) - at[x] * study.strides[x] - at[y] * study.strides[y];
    const bits = marked & study.bitsOf(variable);
    const pixels = new Uint32Array(width * height);
    const painted = new Int16Array(study.sizes[x]);
    let before = -1;
    for (let j = 0; j < height; j++) {
      if (rows[j] < 0) continue;
      const row = start + rows[j] * study.strides[y];
      if (rows[j] !== before) {
        before = rows[j];
        for (let i = 0; i < painted.length; i++) {
          const value = variable.values[row + i * study.strides[x]];
          painted[i] = Number.isNaN(value) ? -1 : log && value <= 0 ? -2 : this.shade((place(value) - low) / (high - low));
        }
      }
      for (let i = 0; i < width; i++) {
        if (columns[i] < 0) continue;
        const shade = painted[columns[i]];
        let colour = shade >= 0 ? colours[shade] : shade === -1 ? gapColour(i, j, period) : LIGHT;
        const flags = study.status[row + columns[i] * study.strides[x]] & bits;
        if (flags && shade !== -1) {
          for (let k = 0; flags >> k; k++) {
            if ((flags >> k) & 1 && MARKS[k](i, j, period)) colour = shade >= 0 && shade < 90 ? LIGHT : DARK;
          }
        }
        pixels[j * width + i] = colour;
      }
    }
    part.mapper.setv({ low, high });
    part.image.data = {
      image: [new this.Pixels(pixels, [height, width])],
      x: [xs.start], y: [ys.start], dw: [xs.end - xs.start], dh: [ys.end - ys.start],
    };
    return lookOf(log);
  }

  // The number of a colour, from 0 to 1 along the palette.
  shade(part) {
    return Math.max(0, Math.min(255, Math.floor(part * 256)));
  }

  // Mark the cell of a scene.
  point(at, x, y) {
    const [along, up] = [this.study.axes[x], this.study.axes[y]];
    this.part.cell.data = {
      x: [along.places[at[x]]], y: [up.places[at[y]]],
      left: [along.edges[at[x]]], right: [along.edges[at[x] + 1]],
      bottom: [up.edges[at[y]]], top: [up.edges[at[y] + 1]],
    };
  }
}
