// What the page does: one state, and everything shown drawn from it.

const explorer = {
  looks: {},

  // Called by Bokeh when all figures are there.
  start(study, variables, parts) {
    Object.assign(this, { study: new Study(study, variables), parts, held: false, whole: false });
    const { axes, solver, sizes, kind, parameters } = this.study;
    this.at = axes.map((axis, i) => (i === solver ? 0 : Math.floor((axis.values.length - 1) / 2)));
    const free = axes.map((_, i) => i).filter((i) => i !== solver);
    [this.x, this.y] = free.sort((one, other) => sizes[other] - sizes[one]);
    this.over = parameters.find((parameter) => parameter.places);
    this.drawn = variables.slice(0, 2).map((_, i) => this.choiceOf(i));
    if (kind === "curves") this.planes = new Planes(this.study, parts.planes);
    const wrong = address.read(this);
    if (wrong.length) {
      const place = document.getElementById("wrong");
      place.textContent = `This page has nothing, or no such value, for what its address has: ${wrong.join("; ")}.`;
      place.hidden = false;
    }
    const all = () => this.later("everything");
    this.showTable = buildTable(this.study);
    this.sliders = buildSliders(this.study, this.at, (axis, place) => {
      this.hold(true);
      this.go(this.at.with(axis, place), kind === "maps" && (axis === this.x || axis === this.y) ? "scene" : "everything");
    });
    const list = document.getElementById("lines");
    if (kind === "curves") {
      this.planes.legend(list, all);
    } else {
      this.marked = buildLegend(this.study, all);
      this.startFigures(list, all);
    }
    downloads.build(this);
    this.hold(this.held);
    this.draw("everything");
    window.addEventListener("hashchange", () => {
      if (location.hash.slice(1) !== address.own) location.reload();
    });
    document.documentElement.dataset.ready = "true";
  },

  // Maps and sections, the line of each solver, and the lists that choose what is drawn.
  startFigures(list, all) {
    const { study, parts } = this;
    if (study.solver >= 0) {
      study.axes[study.solver].values.forEach((words, i) => {
        const [dash, width] = STROKES[i % STROKES.length];
        list.append(lineEntry(words, LINE_COLOURS[i % LINE_COLOURS.length], dash === "solid" ? "" : dash, width));
      });
      list.hidden = false;
    }
    this.maps = parts.maps.map((part) => new ValueMap(study, part, parts.ranges));
    this.sections = parts.sections.map((both) =>
      Object.fromEntries(Object.entries(both).map(([side, part]) => [side, new Section(study, part)])),
    );
    this.buildChoosers(all);
    if (!this.maps.length) return;
    this.fitRanges();
    const again = () => this.later("maps");
    for (const range of Object.values(parts.ranges)) range.change.connect(again);
    for (const { figure } of parts.maps) {
      for (const name of ["inner_width", "inner_height"]) figure.properties[name].change.connect(again);
    }
  },

  // How a variable is shown at first: in colours that rise by ratios if its values differ much.
  choiceOf(variable) {
    const { least, greatest } = this.study.variables[variable];
    return { variable, log: least > 0 && greatest > 8 * least };
  },

  // Put an axis along a side; the one that was there takes the place of that which is.
  put(side, axis) {
    if (axis < 0 || axis === this.study.solver || this.study.kind !== "maps") return;
    const other = side === "x" ? "y" : "x";
    if (this[other] === axis) this[other] = this[side];
    this[side] = axis;
  },

  buildChoosers(all) {
    const { study } = this;
    const place = document.getElementById("axes");
    if (study.kind === "maps") {
      for (const side of ["x", "y"]) {
        const choose = (axis) => {
          this.put(side, axis);
          for (const each of ["x", "y"]) document.getElementById(`along-${each}`).value = this[each];
          this.fitRanges();
          all();
        };
        place.append(chooser(`along-${side}`, `${side} axis`, study.axes.map((axis) => axis.title), this[side], choose));
      }
      place.append(chooser("span", "colours", ["range of this map", "range of all scenes"], Number(this.whole), (whole) => {
        this.whole = Boolean(whole);
        this.later("maps");
      }));
    } else if (this.over) {
      const known = study.parameters.filter((parameter) => parameter.places);
      place.append(chooser("along-x", "plot against", known.map((one) => one.title), known.indexOf(this.over), (i) => {
        this.over = known[i];
        all();
      }));
    }
    this.drawn.forEach((choice, i) => {
      const box = element("input", { type: "checkbox", id: `log-${i}` });
      const update = () => {
        box.disabled = study.variables[choice.variable].leastPositive === null;
        box.checked = choice.log = choice.log && !box.disabled;
        all();
      };
      box.addEventListener("change", () => {
        choice.log = box.checked;
        all();
      });
      const options = study.variables.map((variable) => withUnit(variable.title, variable.unit));
      document.getElementById(`head-${i}`).append(
        chooser(`shown-${i}`, "quantity", options, choice.variable, (variable) => {
          Object.assign(choice, this.choiceOf(variable));
          update();
        }),
        element("div", { className: "box" }, box, element("label", { htmlFor: box.id }, "logarithmic")),
        element("output", { className: "now", id: `now-${i}`, title: "in this scene" }),
      );
      update();
    });
  },

  // Set the ranges of the maps to the whole of both axes.
  fitRanges() {
    for (const side of ["x", "y"]) {
      const { edges } = this.study.axes[this[side]];
      setRange(this.parts.ranges[side], edges[0], edges.at(-1));
    }
  },

  // Draw before the next frame, once, whatever asks for it: the scene alone, the maps too, or everything.
  later(what) {
    const ranks = ["scene", "maps", "everything"];
    if (this.waiting === undefined) {
      requestAnimationFrame(() => {
        const wanted = this.waiting;
        this.waiting = undefined;
        this.draw(wanted);
      });
    }
    this.waiting = ranks[Math.max(ranks.indexOf(what), ranks.indexOf(this.waiting))];
  },

  draw(what) {
    const { study, at, x, y, parts } = this;
    const number = study.numberOf(at);
    const maps = study.kind === "maps";
    this.showTable(at, number);
    this.sliders.forEach((show, i) => show(at[i], maps && i === x ? "x axis" : maps && i === y ? "y axis" : ""));
    document.documentElement.dataset.scene = number;
    address.write(this);
    if (study.kind === "curves") {
      this.planes.draw(number);
      parts.planes.forEach((part) => this.name(part.figure, study.labels[part.x], study.labels[part.y]));
      return;
    }
    const marked = this.marked();
    const words = (entry) => withUnit(entry.symbol, entry.unit);
    this.drawn.forEach((choice, i) => {
      const variable = study.variables[choice.variable];
      document.getElementById(`now-${i}`).textContent = short(variable.values[number]);
      if (maps && what !== "scene") {
        this.looks[`map${i}.bar`] = this.maps[i].paint(variable, { at, x, y, log: choice.log, whole: this.whole, marked });
        this.name(parts.maps[i].figure, words(study.axes[x]), words(study.axes[y]));
        [this.looks["map.x"], this.looks["map.y"]] = [study.axes[x], study.axes[y]];
      }
      if (maps) this.maps[i].point(at, x, y);
      for (const [side, section] of Object.entries(this.sections[i])) {
        const over = study.kind === "points" ? this.over : undefined;
        const along = over ?? study.axes[this[side]];
        this.looks[`section${i}${side}.x`] = along;
        this.looks[`section${i}${side}.y`] = section.draw(variable, { at, axis: this[side], over, log: choice.log, marked });
        this.name(section.part.figure, words(along), words(variable));
      }
    });
  },

  // Label the axes of a figure.
  name({ below: [below], left: [left] }, x, y) {
    below.axis_label = x;
    left.axis_label = y;
  },

  // Ticks for Bokeh.
  ticks(place, start, end) {
    return ticksOf(this.looks[place] ?? lookOf(false), Math.min(start, end), Math.max(start, end));
  },

  tickWords(place, tick) {
    return tickWords(this.looks[place] ?? lookOf(false), tick);
  },

  // The place along each axis that a pointer is at, null if it is at none.
  placeOf(which, i, event) {
    if (which !== "map") return this.at.with(this[which], this.sections[i][which].nearest(event));
    const [x, y] = [cellAt(this.study.axes[this.x].edges, event.x), cellAt(this.study.axes[this.y].edges, event.y)];
    return x < 0 || y < 0 ? null : this.at.with(this.x, x).with(this.y, y);
  },

  hover(which, i, event) {
    const at = this.held || (which !== "map" && this.study.kind === "maps") ? null : this.placeOf(which, i, event);
    if (at) this.go(at);
  },

  // A tap holds a cell; one more on the same cell releases it.
  tap(which, i, event) {
    const at = this.placeOf(which, i, event);
    if (!at) return;
    this.hold(!(this.held && at.join() === this.at.join()));
    this.go(at);
  },

  go(at, what = this.study.kind === "maps" ? "scene" : "everything") {
    if (at.join() === this.at.join()) return;
    this.at = at;
    this.later(what);
  },

  hold(held) {
    this.held = held;
    address.write(this);
    const words = document.getElementById("held");
    if (words) words.textContent = held ? "held: tap the cell again to release it" : "follows the pointer";
  },
};
