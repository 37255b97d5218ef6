// What stands around the figures: axes to choose, sliders, the table of a scene, and the legends.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

// A list to choose from, with its label.
function chooser(id, label, options, chosen, act) {
  const list = element("select", { id, title: label });
  list.append(...options.map((words, value) => element("option", { value, selected: value === chosen }, words)));
  list.addEventListener("change", () => act(Number(list.value)));
  return element("div", { className: "chooser" }, element("label", { htmlFor: id }, label), list);
}

// A slider for each axis; the arrow keys move it from value to value.
function buildSliders(study, at, act) {
  return study.axes.map((axis, i) => {
    const id = `axis-${axis.name}`;
    const shown = element("output", { id: `${id}-value` });
    const role = element("span", { className: "role" });
    const input = element("input", { type: "range", id, min: 0, max: axis.values.length - 1, step: 1, value: at[i] });
    input.addEventListener("input", () => act(i, Number(input.value)));
    const label = element("label", { htmlFor: id, title: axis.name }, axis.title);
    document.getElementById("sliders").append(element("div", { className: "slider" }, label, role, shown, input));
    return (number, along) => {
      const words = inWords(axis, axis.values[number]);
      input.value = number;
      input.setAttribute("aria-valuetext", words);
      shown.textContent = words;
      role.textContent = along;
    };
  });
}

// The table of all parameters and values of one scene; what is returned shows a scene in it.
function buildTable(study) {
  const body = document.querySelector("#values tbody");
  const show = [];
  const group = (words) => body.append(element("tr", {}, element("th", { colSpan: 3, scope: "rowgroup" }, words)));
  const add = (entry, valueAt, words = entry.title) => {
    const cell = element("td", { id: `value-${entry.name}` });
    const unit = element("td", { className: "unit" });
    body.append(element("tr", {}, element("th", { scope: "row", title: entry.name }, words), cell, unit));
    show.push((at, number) => {
      const value = valueAt(at, number);
      const word = value === Infinity && entry.infinite;
      cell.textContent = word || short(value);
      unit.textContent = word ? "" : entry.unit;
    });
  };
  group("Parameters");
  study.axes.forEach((axis, i) => add(axis, (at) => axis.values[at[i]]));
  study.parameters.forEach((parameter) => add(parameter, (at) => study.parameterAt(parameter, at)));
  const single = study.variables.filter((variable) => !variable.curve);
  const slopes = single.filter((variable) => variable.sensitivity);
  if (single.length > slopes.length) group("Values");
  for (const variable of single.filter((one) => !one.sensitivity)) add(variable, (_, number) => variable.values[number]);
  for (const of of new Set(slopes.map((one) => one.sensitivity.of))) {
    const own = slopes.filter((one) => one.sensitivity.of === of);
    group(`Sensitivities ${own[0].symbol.split("/")[0]}/d ln p (k and ν: /dp)`);
    const sizes = (number) => own.map((one) => (one.sensitivity.plain ? 0 : Math.abs(one.values[number]) || 0));
    for (const [i, one] of own.entries()) {
      add(one, (_, number) => one.values[number], one.sensitivity.to);
      const cell = body.lastChild.children[1];
      show.push((_, number) => {
        const all = sizes(number);
        cell.classList.toggle("strongest", all[i] > 0 && all[i] === Math.max(...all));
      });
    }
  }
  const status = element("td", { id: "value-status", colSpan: 2 });
  body.append(element("tr", {}, element("th", { scope: "row", title: "status" }, "status"), status));
  return (at, number) => {
    for (const one of show) one(at, number);
    status.replaceChildren(...study.statusAt(number).map((words) => element("div", {}, words)));
  };
}

// The marks of flags that occur, each with a box to show or hide it; what is returned says which are shown: of doubts at first.
function buildLegend(study, act) {
  const list = document.getElementById("flags");
  let marked = study.flags.reduce((bits, flag) => (flag.doubtful ? bits | flag.bit : bits), 0);
  study.flags.forEach((flag, i) => {
    if (!(study.found & flag.bit) || flag.failed) return;
    const box = element("input", { type: "checkbox", id: `flag-${i}`, checked: flag.doubtful });
    box.addEventListener("change", () => {
      marked ^= flag.bit;
      act();
    });
    const words = flag.doubtful ? `${flag.words} (the value may not hold)` : flag.words;
    list.append(element("li", {}, box, ...looks(study, i), element("label", { htmlFor: box.id }, words)));
  });
  if (study.variables.some((variable) => variable.gaps)) list.append(element("li", {}, ...looks(study, -1), "no value"));
  list.hidden = !list.children.length;
  return () => marked;
}

// How a flag is marked, in maps and in sections (-1: no value).
function looks(study, flag) {
  const letter = element("span", { className: "letter", "aria-hidden": "true" }, LETTERS.at(flag));
  if (study.kind !== "maps") return [letter];
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const [width, height, period] = [28, 16, HATCH].map((size) => Math.round(size * ratio));
  const canvas = element("canvas", { width, height, className: "swatch", "aria-hidden": "true" });
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const colourAt = (x, y) => (flag < 0 ? gapColour(x, y, period) : MARKS[flag](x, y, period) ? DARK : PALE);
  for (let i = 0; i < pixels.length; i++) pixels[i] = colourAt(i % width, height - Math.floor(i / width));
  context.putImageData(image, 0, 0);
  return [canvas, letter];
}

// A line and what it stands for; with a box that shows or hides it, if there is something to do then.
function lineEntry(words, colour, dash, width, box) {
  const look = `stroke="${colour}" stroke-width="${width}" stroke-dasharray="${dash}"`;
  const drawing = `<svg width="40" height="10" aria-hidden="true"><line x1="0" y1="5" x2="40" y2="5" ${look}/></svg>`;
  const item = element("li", { innerHTML: drawing });
  if (box) item.prepend(box);
  item.append(box ? element("label", { htmlFor: box.id }, words) : words);
  return item;
}
