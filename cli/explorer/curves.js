// Curves of one scene: each line full, its jumps thin and dashed, its unstable parts light.

class Planes {
  constructor(study, parts) {
    Object.assign(this, { study, parts });
    this.hidden = new Set();
    this.byName = Object.fromEntries(study.variables.map((variable) => [variable.name, variable]));
  }

  // The row of a variable that belongs to a scene.
  row(name, number) {
    const variable = this.byName[name];
    return variable?.values.subarray(number * variable.length, (number + 1) * variable.length);
  }

  draw(number) {
    return this.parts.map((part) => {
      const lines = { xs: [], ys: [], colour: [], dash: [], width: [] };
      let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
      for (const [i, track] of this.study.tracks.entries()) {
        if (this.hidden.has(i)) continue;
        const [along, up] = [this.row(track[part.x], number), this.row(track[part.y], number)];
        if (!along || !up) continue;
        for (const run of this.runs(track, along, up, number)) {
          const [faded, jump] = [run.kind === "falls", run.kind === "jump"];
          lines.xs.push(run.xs);
          lines.ys.push(run.ys);
          lines.colour.push(faded ? theme.faded(track) : theme.seen(track.colour));
          lines.dash.push((jump ? track.jumpDash : track.dash).join(" ") || "solid");
          lines.width.push(jump ? track.jumpWidth : track.width);
          for (const x of run.xs) [left, right] = [Math.min(left, x), Math.max(right, x)];
          for (const y of run.ys) [low, high] = [Math.min(low, y), Math.max(high, y)];
        }
      }
      part.lines.data = lines;
      if (!(left <= right)) [left, right, low, high] = [0, 1, 0, 1];
      const [aside, above] = [0.04 * (right - left) || 0.5, 0.05 * (high - low) || 0.5];
      const set = (range, start, end) => range.setv({ start, end, reset_start: start, reset_end: end });
      set(part.figure.x_range, left - aside, right + aside);
      set(part.figure.y_range, low - above, high + above);
      return lines;
    });
  }

  // Cut a line into runs of steps that look the same.
  runs(track, along, up, number) {
    const jumps = this.row(track.flag, number);
    const unloading = track.unloading === null ? undefined : this.row("path_unloading", number);
    const depths = track.curve.endsWith("equilibrium") ? this.row(track.indentation, number) : undefined;
    const found = [];
    let run = null;
    for (let i = 1; i < along.length; i++) {
      const whole = Number.isFinite(along[i - 1] + up[i - 1] + along[i] + up[i]);
      const own = unloading === undefined || (unloading[i] === 1) === track.unloading;
      if (!whole || !own) {
        run = null;
        continue;
      }
      const kind = jumps?.[i] === 1 ? "jump" : depths && depths[i] < depths[i - 1] ? "falls" : "line";
      if (!run || run.kind !== kind) {
        run = { kind, xs: [along[i - 1]], ys: [up[i - 1]] };
        found.push(run);
      }
      run.xs.push(along[i]);
      run.ys.push(up[i]);
    }
    return found;
  }

  // The legend: each line with its look, and a box to show or hide it.
  legend(list, act) {
    const boxes = this.study.tracks.map((track, i) => {
      const box = element("input", { type: "checkbox", id: `track-${i}`, checked: !this.hidden.has(i) });
      box.addEventListener("change", () => {
        if (box.checked) this.hidden.delete(i);
        else this.hidden.add(i);
        act();
      });
      return box;
    });
    list.replaceChildren();
    const entries = this.study.tracks.map((track, i) => [track.label, theme.seen(track.colour), track.dash, track.width, boxes[i]]);
    if (this.study.tracks.some((track) => track.curve === "equilibrium")) {
      const own = this.study.tracks.find((track) => track.curve === "equilibrium");
      entries.push(["equilibrium, unstable", theme.faded(own), own.dash, own.width]);
    }
    const jumping = this.study.tracks.find((track) => this.byName[track.flag]);
    if (jumping) entries.push(["jump", theme.seen("#333333"), jumping.jumpDash, jumping.jumpWidth]);
    for (const [label, colour, dash, width, box] of entries) {
      list.append(lineEntry(label, colour, dash.join(" "), width, box));
    }
    list.hidden = false;
  }
}
