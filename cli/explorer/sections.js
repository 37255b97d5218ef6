// Sections: the values along one axis through a scene, a line for each solver; or points over a parameter.

const MOST_DOTS = 60;
const STROKES = [["solid", 2], ["9 5", 2], ["2 4", 2.2], ["9 4 2 4", 2]];
const LINE_COLOURS = ["#31327a", "#1f7a6d", "#8a8a00", "#555555"];

class Section {
  constructor(study, part) {
    Object.assign(this, { study, part });
  }

  // Draw a variable along an axis through a scene; `over` gives the places if the axis has none of its own.
  draw(variable, { at, axis, over, log, marked }) {
    const { study, part } = this;
    const look = over ?? study.axes[axis];
    this.look = look;
    const place = log ? Math.log10 : (value) => value;
    const scattered = study.kind === "points";
    const solvers = study.solver >= 0 && study.solver !== axis ? study.axes[study.solver].values : [""];
    const lines = { xs: [], ys: [], colour: [], dash: [], width: [] };
    const dots = { x: [], y: [], marker: [], size: [], fill: [], colour: [] };
    const gaps = [];
    let [low, high] = [Infinity, -Infinity];
    const bits = marked & study.bitsOf(variable);
    this.heights = [];
    solvers.forEach((_, solver) => {
      const own = [...at];
      if (solvers.length > 1) own[study.solver] = solver;
      own[axis] = 0;
      const start = study.numberOf(own);
      const colour = theme.seen(LINE_COLOURS[solver % LINE_COLOURS.length]);
      const [xs, ys] = [[], []];
      const size = study.sizes[axis];
      for (let i = 0; i < size; i++) {
        const number = start + i * study.strides[axis];
        let y = place(variable.values[number]);
        if (!Number.isFinite(y)) {
          y = NaN;
          gaps.push(look.places[i]);
        } else {
          if (y < low) low = y;
          if (y > high) high = y;
        }
        if (solvers.length === 1 || solver === at[study.solver]) this.heights.push(y);
        const beyond = look.places[i] === look.infinity;
        if (!scattered && !beyond) {
          xs.push(look.places[i]);
          ys.push(y);
        }
        const flags = study.status[number] & bits;
        if (Number.isNaN(y) || !(flags || scattered || beyond || size <= MOST_DOTS)) continue;
        const flag = flags ? 31 - Math.clz32(flags) : -1;
        dots.x.push(look.places[i]);
        dots.y.push(y);
        dots.marker.push(flag >= 0 ? POINTS[flag] : scattered ? ["circle", "triangle", "square"][solver % 3] : "circle");
        dots.size.push(flag >= 0 ? 7 : scattered || beyond ? 7 : 4);
        dots.fill.push(flag >= 0 ? "white" : colour);
        dots.colour.push(colour);
      }
      if (xs.length) {
        const [dash, width] = STROKES[solver % STROKES.length];
        for (const [name, value] of Object.entries({ xs, ys, colour, dash, width })) lines[name].push(value);
      }
    });
    if (!(low <= high)) [low, high] = [0, 1];
    const pad = 0.08 * (high - low) || 0.05 * (Math.abs(high) || 1);
    for (const x of gaps) {
      for (const [name, value] of Object.entries({ x, y: low - 0.6 * pad, marker: "x", size: 7, fill: "white", colour: "#888888" })) {
        dots[name].push(value);
      }
    }
    part.lines.data = lines;
    part.dots.data = dots;
    this.setRange("y", low - pad, high + pad);
    const along = look.places;
    const [first, last] = [look.ends[0], look.infinity ?? look.ends[1]];
    const slack = 0.03 * (last - first) || 0.5;
    this.setRange("x", first - slack, last + slack);
    const value = place(variable.values[study.numberOf(at)]);
    part.here.data = { x: [along[at[axis]]], y: [Number.isFinite(value) ? value : NaN], at: [along[at[axis]]] };
    return lookOf(log);
  }

  // Set a range unless it is so already: what a reader has zoomed into stays while the scene moves.
  setRange(side, start, end) {
    const range = this.part.figure[`${side}_range`];
    const key = `${side} ${start} ${end}`;
    if (this[side] === key) return;
    this[side] = key;
    range.setv({ start, end, reset_start: start, reset_end: end });
  }

  // The item of the axis next to a place in the figure; of points the nearest dot.
  nearest(event) {
    const { x_range: across, y_range: upwards } = this.part.figure;
    const [width, height] = [across.end - across.start, upwards.end - upwards.start];
    const scattered = this.study.kind === "points";
    let [best, least] = [0, Infinity];
    this.look.places.forEach((place, i) => {
      const above = scattered && Number.isFinite(this.heights[i]) ? (this.heights[i] - event.y) / height : 0;
      const distance = Math.hypot((place - event.x) / width, above);
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  }
}
