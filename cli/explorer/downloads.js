// What a reader takes away: a picture, the values shown, the study of the scene, and the call in Python.

const downloads = {
  build(explorer) {
    const place = document.getElementById("downloads");
    const stem = explorer.study.file.replace(/\.[^.]*$/, "");
    const add = (id, words, title, act) => {
      const button = element("button", { type: "button", id: `save-${id}`, title }, words);
      button.addEventListener("click", act);
      place.append(button);
    };
    add("png", "PNG", "picture of all figures", () => this.picture(explorer, `${stem}.png`));
    add("csv", "CSV", "the values shown", () => this.save(`${stem}.csv`, this.csv(explorer), "text/csv"));
    if (!explorer.study.scene) return;
    add("toml", "Study", "a study of this scene alone", () => this.save(`${stem}-scene.toml`, this.toml(explorer), "text/plain"));
    add("py", "Python", "the call that solves this scene", () => this.save(`${stem}-scene.py`, this.python(explorer), "text/plain"));
  },

  save(name, content, type) {
    const blob = content instanceof Blob ? content : new Blob([content], { type: `${type};charset=utf-8` });
    const link = element("a", { href: URL.createObjectURL(blob), download: name });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  },

  // All figures, where they stand on the page.
  picture(explorer, name) {
    const figures = explorer.figures();
    const views = figures.map((figure) => Bokeh.index.find_one(figure));
    const boxes = views.map((view) => view.el.getBoundingClientRect());
    const [left, top] = [Math.min(...boxes.map((box) => box.left)), Math.min(...boxes.map((box) => box.top))];
    const [right, bottom] = [Math.max(...boxes.map((box) => box.right)), Math.max(...boxes.map((box) => box.bottom))];
    const layers = views.map((view) => view.export("png", true).canvas);
    const ratio = layers[0].width / boxes[0].width;
    const canvas = element("canvas", { width: Math.round((right - left) * ratio), height: Math.round((bottom - top) * ratio) });
    const context = canvas.getContext("2d");
    context.fillStyle = theme.paper.back;
    context.fillRect(0, 0, canvas.width, canvas.height);
    layers.forEach((layer, i) => {
      context.drawImage(layer, (boxes[i].left - left) * ratio, (boxes[i].top - top) * ratio);
    });
    canvas.toBlob((blob) => this.save(name, blob));
  },

  // The scenes shown, one a line: those of the map, of the line, all points; of curves the points of the scene.
  csv(explorer) {
    const { study, at } = explorer;
    const entries = [...study.axes, ...study.parameters];
    const head = (entry) => (entry.unit ? `${entry.name} (${entry.unit})` : entry.name);
    const plain = (value) => (typeof value === "string" ? value : Number.isNaN(value) ? "" : value === Infinity ? "inf" : String(value));
    const number6 = (value) => (typeof value === "number" && Number.isFinite(value) ? Number(value.toPrecision(6)) : value);
    if (study.kind === "curves") {
      const number = study.numberOf(at);
      const rows = study.variables.filter((variable) => variable.curve);
      const longest = Math.max(...rows.map((variable) => variable.length));
      const cell = (variable, i) => (i < variable.length ? plain(number6(variable.values[number * variable.length + i])) : "");
      const lines = Array.from({ length: longest }, (_, i) => rows.map((variable) => cell(variable, i)).join());
      return [rows.map(head).join(), ...lines.filter((line) => /[^,]/.test(line))].join("\n") + "\n";
    }
    const moving = study.kind === "maps" ? [explorer.y, explorer.x] : [explorer.lineAxis()];
    const places = moving.reduce(
      (all, axis) => all.flatMap((one) => Array.from({ length: study.sizes[axis] }, (_, i) => one.with(axis, i))),
      [at],
    );
    const lines = places.map((place) => {
      const number = study.numberOf(place);
      return [
        ...study.axes.map((axis, i) => plain(axis.values[place[i]])),
        ...study.parameters.map((parameter) => plain(study.parameterAt(parameter, place))),
        ...study.variables.map((variable) => plain(number6(variable.values[number]))),
        study.status[number],
      ].join();
    });
    return [[...entries, ...study.variables].map(head).concat("status").join(), ...lines].join("\n") + "\n";
  },

  // The parameters that give the scene, each with its table and its value as TOML has it.
  given(explorer) {
    const { study, at } = explorer;
    const found = [];
    for (const [name, table] of Object.entries(study.scene.given)) {
      const axis = study.axes.findIndex((one) => one.name === name);
      const parameter = study.parameters.find((one) => one.name === name);
      const entry = axis >= 0 ? study.axes[axis] : parameter;
      if (!entry) continue;
      const value = axis >= 0 ? entry.values[at[axis]] : study.parameterAt(entry, at);
      const digits = value === Infinity ? "inf" : String(entry.unit ? Number(value.toPrecision(12)) : value);
      found.push({ name, table, digits, unit: value === Infinity ? "" : entry.unit });
    }
    return found;
  },

  toml(explorer) {
    const { scene } = explorer.study;
    const tables = { parameters: [], physical: [], ...Object.fromEntries(Object.entries(scene.tables).map(([name, text]) => [name, [text]])) };
    for (const { name, table, digits, unit } of this.given(explorer)) {
      const number = /^[\d.]+$/.test(digits) && !digits.includes(".") ? `${digits}.0` : digits;
      (tables[table] ??= []).push(`${name} = ${unit ? `"${digits} ${unit}"` : number}`);
    }
    const parts = Object.entries(tables).filter(([, lines]) => lines.length);
    return [scene.head, ...parts.map(([name, lines]) => `[${name}]\n${lines.join("\n")}\n`)].join("\n");
  },

  python(explorer) {
    const { scene, kind } = explorer.study;
    const values = this.given(explorer).map(({ name, digits, unit }) => {
      return `        ${name}=${digits === "inf" ? 'float("inf")' : unit ? `"${digits} ${unit}"` : digits},\n`;
    });
    const lines = ["    dict(\n", ...values, "    ),\n", `    ${scene.outputs},\n`, ...scene.keywords.map((one) => `    ${one},\n`)];
    return `import gradhesion as gr\n\nscene = gr.${kind === "curves" ? "curves" : "solve"}(\n${lines.join("")})\nprint(scene)\n`;
  },
};
