// The state of the page in its address, so that a link shows a colleague what its sender saw.

const address = {
  // Write the state when it has not changed for a while: browsers limit how often.
  write(explorer) {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => {
      this.own = this.text(explorer);
      history.replaceState(null, "", `#${this.own}`);
    }, 400);
  },

  text({ study, at, x, y, whole, over, drawn, planes, held }) {
    const plain = (value) => (typeof value === "string" ? value : String(Number(value.toPrecision(12))));
    const words = new URLSearchParams(study.axes.map((axis, i) => [axis.name, plain(axis.values[at[i]])]));
    const put = (name, value) => value && words.set(name, value);
    if (study.kind === "maps") {
      put("x", study.axes[x].name);
      put("y", study.axes[y].name);
      put("colours", whole && "all");
    }
    put("x", study.kind === "points" && over.name);
    put("hide", planes && [...planes.hidden].join());
    put("show", !planes && drawn.map((choice) => study.variables[choice.variable].name).join());
    put("log", !planes && drawn.map((choice) => Number(choice.log)).join());
    put("held", held && "1");
    return words.toString();
  },

  // Take the state from the address; what it has wrong stays as it is, and is returned in words.
  read(explorer) {
    const { study, drawn } = explorer;
    this.own = location.hash.slice(1);
    const words = new URLSearchParams(this.own);
    const wrong = [];
    const find = (all, name, key) => {
      const found = all.findIndex((one) => one.name === name);
      if (found < 0 && name) wrong.push(`${key} = ${name}`);
      return found;
    };
    const logs = (words.get("log") ?? "").split(",");
    for (const [name, word] of words) {
      const axis = study.axes.findIndex((one) => one.name === name);
      if (axis >= 0) this.place(explorer, axis, word, wrong);
      else if (name === "x" && study.kind === "points") explorer.over = study.parameters[find(study.parameters, word, name)] ?? explorer.over;
      else if (name === "x" || name === "y") explorer.put(name, find(study.axes, word, name));
      else if (name === "colours") explorer.whole = word === "all";
      else if (name === "held") explorer.held = word === "1";
      else if (name === "hide" && explorer.planes) {
        for (const i of word.split(",").filter(Boolean).map(Number)) i in study.tracks ? explorer.planes.hidden.add(i) : wrong.push(`hide = ${i}`);
      } else if (name === "show" && !explorer.planes) {
        word.split(",").slice(0, drawn.length).forEach((one, i) => {
          const variable = find(study.variables, one, name);
          if (variable < 0) return;
          drawn[i] = explorer.choiceOf(variable);
          if (logs[i]) drawn[i].log = logs[i] === "1" && study.variables[variable].leastPositive !== null;
        });
      } else if (name !== "log") wrong.push(`${name} = ${word}`);
    }
    return wrong;
  },

  // Put an axis at the value of a word: the nearest, with a complaint if it is another.
  place(explorer, i, word, wrong) {
    const { values } = explorer.study.axes[i];
    const wanted = word.trim() === "" ? NaN : /^(inf|unbounded)$/i.test(word) ? Infinity : Number(word);
    const apart = (value) => (value === word || value === wanted ? 0 : Math.abs(value - wanted));
    const distances = Array.from(values, apart);
    const best = distances.reduce((one, distance, j) => (distance < (distances[one] ?? Infinity) ? j : one), -1);
    if (best >= 0) explorer.at[i] = best;
    if (!(distances[best] <= 1e-9 * Math.abs(wanted)) && distances[best] !== 0) wrong.push(`${explorer.study.axes[i].name} = ${word}`);
  },
};
