// The state of the page in its address, so that a link shows a colleague what its sender saw.

const PATIENCE = 400; // milliseconds without a change, after which the address is written: browsers limit how often

const KNOWN = ["x", "y", "colours", "show", "log", "hide", "held"]; // what an address has beside axes

const NEAR = 1e-9; // how far a value may be from one of its axis, over its size: it is written to 12 digits

const address = {
  // Write the state when it has not changed for a while.
  write(explorer) {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => {
      this.own = this.text(explorer);
      history.replaceState(null, "", `#${this.own}`);
    }, PATIENCE);
  },

  text(explorer) {
    const { study } = explorer;
    const words = new URLSearchParams();
    study.axes.forEach((axis, i) => words.set(axis.name, this.value(axis.values[explorer.at[i]])));
    if (study.kind === "maps") {
      words.set("x", study.axes[explorer.x].name);
      words.set("y", study.axes[explorer.y].name);
      if (explorer.whole) words.set("colours", "all");
    }
    if (study.kind === "points" && explorer.over.length) words.set("x", explorer.over[explorer.overNow ?? 0].name);
    if (study.kind === "curves") {
      if (explorer.planes.hidden.size) words.set("hide", [...explorer.planes.hidden].join());
    } else {
      words.set("show", explorer.drawn.map((choice) => study.variables[choice.variable].name).join());
      words.set("log", explorer.drawn.map((choice) => Number(choice.log)).join());
    }
    if (explorer.held) words.set("held", "1");
    return words.toString();
  },

  value(value) {
    return typeof value === "string" ? value : String(Number(value.toPrecision(12)));
  },

  // Take the state from the address, `#...` before `?...`; what it does not have stays as it is, and what it has wrong too,
  // which is returned in words.
  read(explorer) {
    const { study } = explorer;
    const words = new URLSearchParams(location.search);
    for (const [name, word] of new URLSearchParams(location.hash.slice(1))) words.set(name, word);
    this.own = location.hash.slice(1);
    const wrong = [...words.keys()].filter((name) => !KNOWN.includes(name) && !study.axes.some((axis) => axis.name === name));
    const said = wrong.map((name) => `${name} is no axis of this page`);
    study.axes.forEach((axis, i) => {
      const word = words.get(axis.name);
      if (word === null) return;
      const wanted = word.trim() === "" ? NaN : /^(inf|unbounded)$/i.test(word) ? Infinity : Number(word);
      let best = axis.values.indexOf(word);
      if (best < 0 && !Number.isNaN(wanted)) {
        const apart = (value) => (value === wanted ? 0 : Math.abs(value - wanted));
        best = Array.from(axis.values).reduce((one, value, j) => (apart(Number(value)) < apart(Number(axis.values[one])) ? j : one), 0);
        const found = Number(axis.values[best]);
        if (found !== wanted && !(apart(found) <= NEAR * Math.abs(wanted))) {
          said.push(`${axis.name} has no value ${word}, and its nearest is shown, ${inWords(axis, axis.values[best])}`);
        }
      }
      if (best >= 0) explorer.at[i] = best;
      else said.push(`${axis.name} has no value ${word || "that is empty"}`);
    });
    const axisOf = (name) => study.axes.findIndex((axis) => axis.name === name && axis.name !== "solver");
    if (study.kind === "maps") {
      const [x, y] = ["x", "y"].map((side) => axisOf(words.get(side)));
      if (x >= 0 && y >= 0 && x !== y) [explorer.x, explorer.y] = [x, y];
      else if (words.has("x") || words.has("y")) {
        const sides = ["x", "y"].filter((side) => words.has(side)).map((side) => `${side} = ${words.get(side)}`);
        said.push(`${sides.join(" and ")} does not name two axes of this page`);
      }
      explorer.whole = words.get("colours") === "all";
    }
    if (study.kind === "points") {
      const over = explorer.over.findIndex((parameter) => parameter.name === words.get("x"));
      if (over >= 0) explorer.overNow = over;
      else if (words.has("x")) said.push(`x = ${words.get("x")} is no parameter that varies`);
    }
    if (study.kind === "curves") {
      const hidden = (words.get("hide") ?? "").split(",").filter(Boolean);
      explorer.hidden = hidden.map(Number).filter((i) => i in study.tracks);
      if (explorer.hidden.length < hidden.length) said.push(`hide = ${words.get("hide")} names lines that are not there`);
    } else {
      const logs = (words.get("log") ?? "").split(",");
      (words.get("show") ?? "").split(",").forEach((name, i) => {
        const variable = study.variables.findIndex((one) => one.name === name);
        if (variable < 0 && name) said.push(`${name} is no quantity of this page`);
        if (variable < 0 || i >= explorer.drawn.length) return;
        explorer.drawn[i] = explorer.choiceOfVariable(variable);
        if (logs[i]) explorer.drawn[i].log = logs[i] === "1" && study.variables[variable].leastPositive !== null;
      });
    }
    explorer.held = words.get("held") === "1";
    return said;
  },
};
