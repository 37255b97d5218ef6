// The study: where a scene has its values, and what its status says.

// Bokeh's arrays as those of the language, since a part of one of Bokeh's is the whole.
function plainArray(values) {
  if (!ArrayBuffer.isView(values)) return values;
  const Plain = { float32: Float32Array, float64: Float64Array, uint16: Uint16Array }[values.dtype];
  return new Plain(values.buffer, values.byteOffset, values.length);
}

class Study {
  constructor(study, variables) {
    Object.assign(this, study, { variables, status: plainArray(study.status) });
    for (const entry of [...this.axes, ...this.parameters, ...variables]) {
      for (const name of ["values", "places", "few"]) entry[name] = plainArray(entry[name]);
    }
    this.sizes = this.axes.map((axis) => axis.values.length);
    this.strides = this.sizes.map((_, i) => this.sizes.slice(i + 1).reduce((all, size) => all * size, 1));
    for (const axis of this.axes) axis.edges = edgesOf(axis.places);
    this.solver = this.axes.findIndex((axis) => axis.name === "solver");
  }

  // The number of a scene, from its place along each axis.
  numberOf(at) {
    return at.reduce((number, place, i) => number + place * this.strides[i], 0);
  }

  // The value of a parameter that is no axis; one that follows from axes varies along these alone.
  parameterAt(parameter, at) {
    return parameter.values[parameter.axes.reduce((number, axis) => number * this.sizes[axis] + at[axis], 0)];
  }

  // The bits of the status that are of interest to a variable.
  bitsOf(variable) {
    return this.flags.reduce((bits, flag) => (flag.doubtful && !(variable.doubts & flag.bit) ? bits : bits | flag.bit), 0);
  }

  // The status of a scene in words.
  statusAt(number) {
    const words = this.flags.filter((flag) => this.status[number] & flag.bit).map((flag) => flag.words);
    return words.length ? words : ["nothing to report"];
  }
}

// How each flag is marked in a map, by its number: whether a pixel belongs to the mark, of which p is the period.
const rising = (x, y, p) => (x + y) % p < p / 5;
const falling = (x, y, p) => (x - y + 4096 * p) % p < p / 5;
const level = (x, y, p) => y % p < p / 5;
const upright = (x, y, p) => x % p < p / 5;
const crossed = (...pixel) => rising(...pixel) || falling(...pixel);
const MARKS = [
  rising,
  falling,
  (x, y, p) => x % p < p / 3.5 && y % p < p / 3.5,
  level,
  upright,
  crossed,
  crossed,
  (...pixel) => level(...pixel) || upright(...pixel),
  (x, y, p) => y % p < p / 2.5,
  (x, y, p) => x % p < p / 2.5,
];

// And in a section: its open marker, and the letter that is like it; the last is that of no value.
const POINTS = ["circle", "square", "diamond", "triangle", "inverted_triangle", "hex", "x", "star", "plus", "square_pin"];
const LETTERS = "○□◇△▽⬡×☆＋▣×";
