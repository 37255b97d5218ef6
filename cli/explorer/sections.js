// Sections: the values along one axis through a scene, a line for each solver; or points over a parameter.

const STROKES = [["solid", 2], ["9 5", 2], ["2 4", 2.2], ["9 4 2 4", 2]];
const LINE_COLOURS = ["#31327a", "#1f7a6d", "#8a8a00", "#555555"];

// Add a row to the columns of a source of data.
function push(columns, row) {
  for (const [name, value] of Object.entries(row)) (columns[name] ??= []).push(value);
}

function setRange(range, start, end) {
  range.setv({ start, end, reset_start: start, reset_end: end });
}

class Section {
  constructor(study, part) {
    Object.assign(this, { study, part });
  }

  // Draw a variable along an axis through a scene; `over` gives the places if the axis has none of its own.
  draw(variable, { at, axis, over, log, marked }) {
    const { study, part } = this;
    const look = over ?? study.axes[axis];
    this.look = look;
    const place = (value) => (log ? Math.log10(value) : value);
    const scattered = study.kind === "points";
    const solvers = study.solver >= 0 && study.solver !== axis ? study.axes[study.solver].values : [""];
    const size = study.sizes[axis];
    const lines = { xs: [], ys: [], colour: [], dash: [], width: [] };
    const dots = { x: [], y: [], marker: [], size: [], fill: [], colour: [] };
    const gaps = [];
    let [low, high] = [Infinity, -Infinity];
    const bits = marked & study.bitsOf(variable);
    solvers.forEach((_, solver) => {
      const own = [...at];
      if (solvers.length > 1) own[study.solver] = solver;
      const start = study.numberOf(own) - own[axis] * study.strides[axis];
      const colour = LINE_COLOURS[solver % LINE_COLOURS.length];
      const heights = Array.from({ length: size }, (_, i) => place(variable.values[start + i * study.strides[axis]]));
      const on = heights.map((_, i) => !scattered && look.places[i] !== look.infinity);
      if (solvers.length === 1 || solver === at[study.solver]) this.heights = heights;
      heights.forEach((y, i) => {
        if (!Number.isFinite(y)) {
          heights[i] = NaN;
          gaps.push(look.places[i]);
          return;
        }
        [low, high] = [Math.min(low, y), Math.max(high, y)];
        const flags = study.status[start + i * study.strides[axis]] & bits;
        if (!flags && on[i] && size > 60) return;
        const flag = flags ? 31 - Math.clz32(flags) : -1;
        const marker = flags ? POINTS[flag] : scattered ? ["circle", "triangle", "square"][solver % 3] : "circle";
        push(dots, { x: look.places[i], y, marker, size: flags || !on[i] ? 7 : 4, fill: flags ? "white" : colour, colour });
      });
      const [dash, width] = STROKES[solver % STROKES.length];
      const [xs, ys] = [Array.from(look.places), heights].map((all) => all.filter((_, i) => on[i]));
      if (xs.length) push(lines, { xs, ys, colour, dash, width });
    });
    if (!(low <= high)) [low, high] = [0, 1];
    const pad = 0.08 * (high - low) || 0.05 * (Math.abs(high) || 1);
    for (const x of gaps) push(dots, { x, y: low - 0.6 * pad, marker: "x", size: 7, fill: "white", colour: "#888888" });
    part.lines.data = lines;
    part.dots.data = dots;
    this.fit("y", low - pad, high + pad);
    const [first, last] = [look.ends[0], look.infinity ?? look.ends[1]];
    const slack = 0.03 * (last - first) || 0.5;
    this.fit("x", first - slack, last + slack);
    const value = place(variable.values[study.numberOf(at)]);
    const x = look.places[at[axis]];
    part.here.data = { x: [x], y: [Number.isFinite(value) ? value : NaN], at: [x] };
    return lookOf(log);
  }

  // Set a range unless it is so already: what a reader has zoomed into stays while the scene moves.
  fit(side, start, end) {
    if (this[side] !== `${start} ${end}`) setRange(this.part.figure[`${side}_range`], start, end);
    this[side] = `${start} ${end}`;
  }

  // The item of the axis next to a place in the figure; of points the nearest dot.
  nearest(event) {
    const { x_range: across, y_range: upwards } = this.part.figure;
    const distances = Array.from(this.look.places, (place, i) => {
      const above = this.study.kind === "points" && Number.isFinite(this.heights[i]) ? this.heights[i] - event.y : 0;
      return Math.hypot((place - event.x) / (across.end - across.start), above / (upwards.end - upwards.start));
    });
    return distances.reduce((best, distance, i) => (distance < distances[best] ? i : best), 0);
  }
}
