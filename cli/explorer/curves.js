// Curves of one scene: each line full, its jumps thin and dashed, its unstable parts light.

class Planes {
  constructor(study, parts) {
    Object.assign(this, { study, parts, hidden: new Set() });
    this.byName = Object.fromEntries(study.variables.map((variable) => [variable.name, variable]));
  }

  // The row of a variable that belongs to a scene.
  row(name, number) {
    const variable = this.byName[name];
    return variable?.values.subarray(number * variable.length, (number + 1) * variable.length);
  }

  draw(number) {
    for (const part of this.parts) {
      const lines = { xs: [], ys: [], colour: [], dash: [], width: [] };
      this.study.tracks.forEach((track, i) => {
        const [along, up] = [this.row(track[part.x], number), this.row(track[part.y], number)];
        if (this.hidden.has(i) || !along || !up) return;
        for (const { kind, xs, ys } of this.runs(track, along, up, number)) {
          const [dash, width] = kind === "jump" ? [track.jumpDash, track.jumpWidth] : [track.dash, track.width];
          push(lines, { xs, ys, colour: kind === "falls" ? track.faded : track.colour, dash: dash.join(" ") || "solid", width });
        }
      });
      part.lines.data = lines;
      for (const [range, all, share] of [[part.figure.x_range, lines.xs, 0.04], [part.figure.y_range, lines.ys, 0.05]]) {
        const [low, high] = all.flat().reduce(([least, most], one) => [Math.min(least, one), Math.max(most, one)], [Infinity, -Infinity]);
        const pad = share * (high - low) || 0.5;
        setRange(range, low <= high ? low - pad : 0, low <= high ? high + pad : 1);
      }
    }
  }

  // Cut a line into runs of steps that look the same.
  runs(track, along, up, number) {
    const jumps = this.row(track.flag, number);
    const unloading = track.unloading === null ? undefined : this.row("path_unloading", number);
    const depths = track.curve.endsWith("equilibrium") ? this.row(track.indentation, number) : undefined;
    const found = [];
    let run = null;
    for (let i = 1; i < along.length; i++) {
      const own = unloading === undefined || (unloading[i] === 1) === track.unloading;
      if (!own || !Number.isFinite(along[i - 1] + up[i - 1] + along[i] + up[i])) {
        run = null;
        continue;
      }
      const kind = jumps?.[i] === 1 ? "jump" : depths && depths[i] < depths[i - 1] ? "falls" : "line";
      if (run?.kind !== kind) found.push((run = { kind, xs: [along[i - 1]], ys: [up[i - 1]] }));
      run.xs.push(along[i]);
      run.ys.push(up[i]);
    }
    return found;
  }

  // The legend: each line with its look, and a box to show or hide it.
  legend(list, act) {
    this.study.tracks.forEach((track, i) => {
      const box = element("input", { type: "checkbox", id: `track-${i}`, checked: !this.hidden.has(i) });
      box.addEventListener("change", () => {
        this.hidden[box.checked ? "delete" : "add"](i);
        act();
      });
      list.append(lineEntry(track.label, track.colour, track.dash.join(" "), track.width, box));
    });
    const own = this.study.tracks.find((track) => track.curve === "equilibrium");
    if (own) list.append(lineEntry("equilibrium, unstable", own.faded, own.dash.join(" "), own.width));
    const jumping = this.study.tracks.find((track) => this.byName[track.flag]);
    if (jumping) list.append(lineEntry("jump", "#333333", jumping.jumpDash.join(" "), jumping.jumpWidth));
    list.hidden = false;
  }
}
