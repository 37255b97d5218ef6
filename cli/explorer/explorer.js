// What the page does: one state, and everything shown drawn from it.

const NARROW = 700; // pixels of a window, below which figures have less beside their frames

const BARE = 16; // pixels to the right of frames on a page without colour bars

const explorer = {
  looks: {},

  // Called by Bokeh when all figures are there.
  start(study, variables, parts) {
    this.study = new Study(study, variables);
    this.parts = parts;
    const { axes, solver, kind } = this.study;
    this.at = axes.map((axis) => (axis.name === "solver" ? 0 : Math.floor((axis.values.length - 1) / 2)));
    const free = axes.map((_, i) => i).filter((i) => i !== solver);
    free.sort((one, other) => this.study.sizes[other] - this.study.sizes[one]);
    [this.x, this.y] = [free[0], free[1]];
    this.over = this.study.parameters.filter((parameter) => parameter.places);
    this.held = false;
    this.whole = false;
    this.drawn = variables.slice(0, 2).map((variable, i) => this.choiceOf(i));
    this.complain(address.read(this));
    this.marked = () => 0;
    this.showTable = buildTable(this.study);
    this.marked = buildLegend(this.study, () => this.later("everything"));
    this.sliders = buildSliders(this.study, this.at, (axis, place) => {
      this.at[axis] = place;
      this.hold(true);
      this.later(kind === "maps" && (axis === this.x || axis === this.y) ? "scene" : "everything");
    });
    if (kind === "curves") {
      this.planes = new Planes(this.study, parts.planes);
      for (const i of this.hidden) this.planes.hidden.add(i);
    } else {
      this.startFigures();
    }
    downloads.build(this);
    const fit = () => {
      const narrow = window.innerWidth <= NARROW;
      const size = narrow ? "11px" : "13px";
      for (const figure of this.figures()) {
        figure.setv({ min_border_left: narrow ? 78 : LEFT, min_border_right: !parts.maps ? BARE : narrow ? 66 : RIGHT });
        for (const part of [...figure.below, ...figure.left, ...figure.right]) {
          if ("axis_label_text_font_size" in part.properties) part.axis_label_text_font_size = size;
          part.major_label_text_font_size = size;
        }
      }
    };
    const [{ min_border_left: LEFT, min_border_right: RIGHT }] = this.figures();
    window.addEventListener("resize", fit);
    fit();
    this.hold(this.held);
    theme.follow(() => {
      for (const figure of this.figures()) theme.dress(figure);
      const list = document.getElementById("lines");
      if (kind === "curves") this.planes.legend(list, () => this.later("everything"));
      else buildSolvers(this.study, list);
      this.draw("everything");
    });
    window.addEventListener("hashchange", () => {
      const [now, own] = [location.hash.slice(1), address.own ?? ""].map((words) => new URLSearchParams(words).toString());
      if (now !== own) location.reload();
    });
    document.documentElement.dataset.ready = "true";
  },

  // Say what of the address is wrong.
  complain(said) {
    const place = document.getElementById("wrong");
    place.hidden = !said.length;
    if (said.length) place.textContent = `The address of this page does not fit it: ${said.join("; ")}.`;
  },

  // Maps and sections, and the lists that choose what is in them.
  startFigures() {
    const { study, parts } = this;
    this.maps = (parts.maps ?? []).map((part) => new ValueMap(study, part, parts.ranges));
    this.sections = parts.sections.map((both) =>
      Object.fromEntries(Object.entries(both).map(([side, part]) => [side, new Section(study, part)])),
    );
    this.buildChoosers();
    if (this.maps.length) {
      this.fitRanges();
      for (const range of Object.values(parts.ranges)) range.change.connect(() => this.later("maps"));
      for (const part of parts.maps) {
        for (const name of ["inner_width", "inner_height"]) {
          part.figure.properties[name].change.connect(() => this.later("maps"));
        }
      }
    }
  },

  // All figures of the page.
  figures() {
    const sections = (this.parts.sections ?? []).flatMap((both) => Object.values(both));
    return [...(this.parts.maps ?? []), ...sections, ...(this.parts.planes ?? [])].map((part) => part.figure);
  },

  // The variable that a map shows at first: force and energy, in units if they have them.
  choiceOf(i) {
    const placeOf = (name) => this.study.variables.findIndex((one) => one.name === name);
    const usual = ["pull_off_force", "dissipated_energy"].map((name) => Math.max(placeOf(name), placeOf(`${name}_si`)));
    const units = ["pull_off_force_si", "dissipated_energy_si"].map(placeOf);
    const wanted = units[0] >= 0 ? units : usual;
    const variable = wanted[0] >= 0 && wanted[i] >= 0 ? wanted[i] : Math.min(i, this.study.variables.length - 1);
    return this.choiceOfVariable(variable);
  },

  buildChoosers() {
    const { study } = this;
    const place = document.getElementById("axes");
    const named = study.axes.map((axis, i) => [i, axis.title]);
    const other = { x: "y", y: "x" };
    if (study.kind === "maps") {
      for (const side of ["x", "y"]) {
        const choose = (axis) => {
          if (this[other[side]] === axis) this[other[side]] = this[side];
          this[side] = axis;
          document.getElementById("along-x").value = this.x;
          document.getElementById("along-y").value = this.y;
          this.fitRanges();
          this.later("everything");
        };
        place.append(chooser(`along-${side}`, `${side} axis`, named, this[side], choose));
      }
      place.append(
        chooser("span", "colours", [[0, "range of this map"], [1, "range of all scenes"]], Number(this.whole), (whole) => {
          this.whole = Boolean(whole);
          this.later("maps");
        }),
      );
    } else if (this.over.length > 1) {
      this.overNow ??= 0;
      const options = this.over.map((parameter, i) => [i, parameter.title]);
      place.append(chooser("along-x", "plot against", options, this.overNow, (i) => {
        this.overNow = i;
        this.later("everything");
      }));
    }
    this.drawn.forEach((choice, i) => {
      const head = document.getElementById(`head-${i}`);
      const box = element("input", { type: "checkbox", id: `log-${i}` });
      const options = study.variables.map((variable, j) => [j, withUnit(variable.title, variable.unit)]);
      const update = () => {
        box.disabled = study.variables[choice.variable].leastPositive === null;
        choice.log = choice.log && !box.disabled;
        box.checked = choice.log;
      };
      box.addEventListener("change", () => {
        choice.log = box.checked;
        this.later("everything");
      });
      head.append(chooser(`shown-${i}`, "quantity", options, choice.variable, (variable) => {
        Object.assign(choice, this.choiceOfVariable(variable));
        update();
        this.later("everything");
      }));
      head.append(element("div", { className: "box" }, box, element("label", { htmlFor: `log-${i}` }, "logarithmic")));
      head.append(element("output", { className: "now", id: `now-${i}`, title: "in this scene" }));
      update();
    });
  },

  // How a variable is shown at first: in colours that rise by ratios if its values differ much.
  choiceOfVariable(variable) {
    const { least, greatest } = this.study.variables[variable];
    return { variable, log: least > 0 && greatest > 8 * least };
  },

  // Set the ranges of the maps to the whole of both axes.
  fitRanges() {
    for (const side of ["x", "y"]) {
      const { edges } = this.study.axes[this[side]];
      const [start, end] = [edges[0], edges[edges.length - 1]];
      this.parts.ranges[side].setv({ start, end, reset_start: start, reset_end: end });
    }
  },

  // Draw before the next frame, once, whatever asks for it.
  later(what) {
    const ranks = ["scene", "maps", "everything"];
    if (this.waiting !== undefined) {
      if (ranks.indexOf(what) > ranks.indexOf(this.waiting)) this.waiting = what;
      return;
    }
    this.waiting = what;
    requestAnimationFrame(() => {
      const wanted = this.waiting;
      this.waiting = undefined;
      this.draw(wanted);
    });
  },

  // Draw the scene alone, the maps too, or everything.
  draw(what) {
    const { study, at, x, y } = this;
    const number = study.numberOf(at);
    this.showTable(at, number);
    const maps = study.kind === "maps";
    study.axes.forEach((_, i) => this.sliders[i].show(at[i], maps && i === x ? "x axis" : maps && i === y ? "y axis" : ""));
    document.documentElement.dataset.scene = number;
    address.write(this);
    if (study.kind === "curves") {
      if (what !== "everything") return;
      this.planes.draw(number);
      this.parts.planes.forEach((part, i) => {
        this.name(part.figure, `plane${i}`, study.labels[part.x], study.labels[part.y]);
      });
      return;
    }
    const marked = this.marked();
    this.drawn.forEach((choice, i) => {
      const variable = study.variables[choice.variable];
      document.getElementById(`now-${i}`).textContent = short(variable.values[number]);
      if (maps && what !== "scene") {
        this.looks[`map${i}.bar`] = this.maps[i].paint(variable, { at, x, y, log: choice.log, whole: this.whole, marked });
        this.name(this.parts.maps[i].figure, "map", this.axisWords(study.axes[x]), this.axisWords(study.axes[y]));
        [this.looks["map.x"], this.looks["map.y"]] = [study.axes[x], study.axes[y]];
      }
      if (maps) this.maps[i].point(at, x, y);
      for (const [side, section] of Object.entries(this.sections[i])) {
        const axis = maps ? this[side] : this.lineAxis();
        const over = study.kind === "points" ? this.over[this.overNow ?? 0] : undefined;
        const place = `section${i}${side}`;
        this.looks[`${place}.x`] = over ?? study.axes[axis];
        this.looks[`${place}.y`] = section.draw(variable, { at, axis, over, log: choice.log, marked });
        const title = withUnit(variable.symbol, variable.unit);
        this.name(section.part.figure, place, this.axisWords(over ?? study.axes[axis]), title);
      }
    });
  },

  // The axis of a page of lines or points.
  lineAxis() {
    return this.study.axes.findIndex((axis) => axis.name !== "solver");
  },

  axisWords(axis) {
    return withUnit(axis.symbol, axis.unit);
  },

  // Label the axes of a figure.
  name(figure, place, x, y) {
    const [below] = figure.below;
    const [left] = figure.left;
    if (below.axis_label !== x) below.axis_label = x;
    if (left.axis_label !== y) left.axis_label = y;
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
    const at = [...this.at];
    if (which === "map") {
      const [x, y] = [cellAt(this.study.axes[this.x].edges, event.x), cellAt(this.study.axes[this.y].edges, event.y)];
      if (x < 0 || y < 0) return null;
      [at[this.x], at[this.y]] = [x, y];
    } else {
      const side = which.slice(-1);
      at[this.study.kind === "maps" ? this[side] : this.lineAxis()] = this.sections[i][side].nearest(event);
    }
    return at;
  },

  hover(which, i, event) {
    if (this.held || which !== "map" && this.study.kind === "maps") return;
    this.go(this.placeOf(which, i, event));
  },

  // A tap holds a cell; one more on the same cell releases it.
  tap(which, i, event) {
    const at = this.placeOf(which, i, event);
    if (!at) return;
    const same = at.every((place, axis) => place === this.at[axis]);
    this.hold(!(this.held && same));
    this.go(at);
  },

  go(at) {
    if (!at || at.every((place, axis) => place === this.at[axis])) return;
    this.at = at;
    const moved = this.study.kind === "maps" ? "scene" : "everything";
    this.later(moved);
  },

  hold(held) {
    this.held = held;
    address.write(this);
    const words = document.getElementById("held");
    if (words) words.textContent = held ? "held: tap the cell again to release it" : "follows the pointer";
  },
};
