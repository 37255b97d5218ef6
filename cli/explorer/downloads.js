// What a reader takes away: the values shown, the study of the scene, and the call in Python.

const downloads = {
  build(explorer) {
    const stem = explorer.study.file.replace(/\.[^.]*$/, "");
    for (const [id, words, title, end, write] of [
      ["csv", "CSV", "the values shown", ".csv", this.csv],
      ["toml", "Study", "a study of this scene alone", "-scene.toml", this.toml],
      ["py", "Python", "the call that solves this scene", "-scene.py", this.python],
    ]) {
      const button = element("button", { type: "button", id: `save-${id}`, title }, words);
      button.addEventListener("click", () => this.save(stem + end, write.call(this, explorer)));
      document.getElementById("downloads").append(button);
    }
  },

  save(name, text) {
    const href = URL.createObjectURL(new Blob([text], { type: "text/plain;charset=utf-8" }));
    element("a", { href, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(href), 10000);
  },

  // The scenes shown, one a line: those of the map, of the line, all points; of curves the points of the scene.
  csv(explorer) {
    const { study, at } = explorer;
    const plain = (value) => (Number.isNaN(value) ? "" : value === Infinity ? "inf" : String(value));
    const six = (value) => plain(Number.isFinite(value) ? Number(value.toPrecision(6)) : value);
    const head = (entries) => entries.map((entry) => withUnit(entry.name, entry.unit));
    const number = study.numberOf(at);
    if (study.kind === "curves") {
      const rows = study.variables.filter((variable) => variable.curve);
      const cell = ({ values, length }, i) => (i < length ? six(values[number * length + i]) : "");
      const lines = Array.from({ length: Math.max(...rows.map((one) => one.length)) }, (_, i) => rows.map((one) => cell(one, i)).join());
      return [head(rows).join(), ...lines.filter((line) => /[^,]/.test(line)), ""].join("\n");
    }
    const moving = study.kind === "maps" ? [explorer.y, explorer.x] : [explorer.x];
    const places = moving.reduce((all, axis) => all.flatMap((one) => Array.from({ length: study.sizes[axis] }, (_, i) => one.with(axis, i))), [at]);
    const lines = places.map((place) => [
      ...study.axes.map((axis, i) => plain(axis.values[place[i]])),
      ...study.parameters.map((parameter) => plain(study.parameterAt(parameter, place))),
      ...study.variables.map((variable) => six(variable.values[study.numberOf(place)])),
      study.status[study.numberOf(place)],
    ].join());
    return [[...head([...study.axes, ...study.parameters, ...study.variables]), "status"].join(), ...lines, ""].join("\n");
  },

  toml({ study, at }) {
    const { head, given, tables } = study.scene;
    const written = { parameters: [], physical: [] };
    for (const [name, text] of Object.entries(tables)) written[name] = [text];
    for (const [name, table] of Object.entries(given)) {
      const axis = study.axes.findIndex((one) => one.name === name);
      const entry = study.axes[axis] ?? study.parameters.find((one) => one.name === name);
      if (!entry) continue;
      const value = axis >= 0 ? entry.values[at[axis]] : study.parameterAt(entry, at);
      const digits = value === Infinity ? "inf" : String(entry.unit ? Number(value.toPrecision(12)) : value);
      const number = /^\d+$/.test(digits) ? `${digits}.0` : digits;
      (written[table] ??= []).push(`${name} = ${entry.unit && value !== Infinity ? `"${digits} ${entry.unit}"` : number}`);
    }
    const parts = Object.entries(written).filter(([, lines]) => lines.length);
    return [head, ...parts.map(([name, lines]) => `[${name}]\n${lines.join("\n")}\n`)].join("\n");
  },

  python(explorer) {
    return `import tomllib\n\nimport gradhesion as gr\n\nstudy = r'''\n${this.toml(explorer)}'''\nscene = gr.run(tomllib.loads(study))\nprint(scene)\n`;
  },
};
