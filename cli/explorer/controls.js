// What stands around the figures: axes to choose, sliders, the table of a scene, and the legend.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && name !== "list" && name !== "for") made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

// A list to choose from, with its label.
function chooser(id, label, options, chosen, act) {
  const list = element("select", { id, title: label });
  options.forEach(([value, words]) => list.append(element("option", { value, selected: value === chosen }, words)));
  list.addEventListener("change", () => act(Number(list.value)));
  return element("div", { className: "chooser" }, element("label", { htmlFor: id }, label), list);
}

// A slider for each axis; the arrow keys move it from value to value.
function buildSliders(study, at, act) {
  const place = document.getElementById("sliders");
  return study.axes.map((axis, i) => {
    const id = `axis-${axis.name}`;
    const shown = element("output", { id: `${id}-value`, htmlFor: id });
    const role = element("span", { className: "role" });
    const input = element("input", { type: "range", id, min: 0, max: axis.values.length - 1, step: 1, value: at[i] });
    input.addEventListener("input", () => act(i, Number(input.value)));
    const label = element("label", { htmlFor: id, title: axis.name }, axis.title);
    place.append(element("div", { className: "slider" }, label, role, shown, input));
    return {
      show(number, along) {
        const words = inWords(axis, axis.values[number]);
        input.value = number;
        input.setAttribute("aria-valuetext", words);
        shown.textContent = words;
        role.textContent = along;
      },
    };
  });
}

const SLOPES = "d ln F/d ln p of each parameter p; of k and ν d ln F/dp";

// The table of all parameters and values of one scene.
function buildTable(study) {
  const body = document.querySelector("#values tbody");
  const cells = [];
  const add = (entry, valueAt) => {
    const cell = element("td", { id: `value-${entry.name}` });
    const head = element("th", { scope: "row", title: entry.name }, entry.title);
    const unit = element("td", { className: "unit" });
    body.append(element("tr", {}, head, cell, unit));
    cells.push((at, number) => {
      const value = valueAt(at, number);
      const word = value === Infinity && entry.infinite;
      cell.textContent = word || short(value);
      unit.textContent = word ? "" : entry.unit;
    });
  };
  const group = (words) => body.append(element("tr", {}, element("th", { colSpan: 3, scope: "rowgroup" }, words)));
  group("Parameters");
  study.axes.forEach((axis, i) => add(axis, (at) => axis.values[at[i]]));
  study.parameters.forEach((parameter) => add(parameter, (at) => study.parameterAt(parameter, at)));
  const single = study.variables.filter((variable) => variable.length === 1 && !variable.curve);
  const values = single.filter((variable) => !variable.sensitivity);
  if (values.length) group("Values");
  values.forEach((variable) => add(variable, (_, number) => variable.values[number]));
  const slopes = single.filter((variable) => variable.sensitivity);
  if (slopes.length) cells.push(addSensitivities(body, slopes));
  const status = element("td", { id: "value-status", colSpan: 2 });
  body.append(element("tr", {}, element("th", { scope: "row", title: "status" }, "status"), status));
  return (at) => {
    const number = study.numberOf(at);
    cells.forEach((show) => show(at, number));
    status.replaceChildren(...study.statusAt(number).map((words) => element("div", {}, words)));
  };
}

// Sensitivities: a line for each parameter, a column for each value, the strongest of a column marked.
function addSensitivities(body, slopes) {
  const columns = [...new Set(slopes.map((one) => one.sensitivity.of))];
  const show = [];
  const table = element("table", { className: "slopes" });
  body.append(element("tr", {}, element("td", { colSpan: 3, className: "whole" }, table)));
  for (const [first, second] of [columns.slice(0, 2), columns.slice(2, 4)].filter((pair) => pair.length)) {
    const pair = [first, second].filter(Boolean).map((of) => slopes.filter((one) => one.sensitivity.of === of));
    const heads = pair.map((own) => element("td", {}, own[0].symbol.split("/")[0]));
    table.append(element("tr", { className: "heads" }, element("th", { scope: "rowgroup", title: SLOPES }, "Sensitivities to"), ...heads));
    pair[0].forEach((one, i) => {
      const made = pair.map((own) => element("td", { id: `value-${own[i].name}`, title: own[i].title }));
      table.append(element("tr", {}, element("th", { scope: "row", title: one.title }, one.sensitivity.to), ...made));
      show.push(...made.map((cell, j) => [cell, pair[j][i], pair[j]]));
    });
  }
  return (_, number) => {
    for (const [cell, own, all] of show) {
      const sizes = all.filter((one) => !one.sensitivity.plain).map((one) => Math.abs(one.values[number]) || 0);
      const size = own.sensitivity.plain ? 0 : Math.abs(own.values[number]) || 0;
      cell.textContent = short(own.values[number], 4);
      cell.classList.toggle("strongest", size > 0 && size === Math.max(...sizes));
    }
  };
}

// The marks of flags that occur, each with a box to show or hide it; doubtful values are marked from the start.
function buildLegend(study, act) {
  if (study.kind === "curves") return () => 0;
  const list = document.getElementById("flags");
  let marked = study.flags.reduce((bits, flag) => (flag.doubtful ? bits | flag.bit : bits), 0);
  study.flags.forEach((flag, i) => {
    if (!(study.found & flag.bit) || flag.failed) return;
    const box = element("input", { type: "checkbox", id: `flag-${i}`, checked: Boolean(marked & flag.bit) });
    box.addEventListener("change", () => {
      marked ^= flag.bit;
      act();
    });
    const words = flag.doubtful ? `${flag.words} (the value may not hold)` : flag.words;
    list.append(element("li", {}, box, ...looks(study, i), element("label", { htmlFor: `flag-${i}` }, words)));
  });
  const gaps = study.variables.some((variable) => variable.gaps);
  if (gaps) list.append(element("li", {}, ...looks(study, -1), "no value"));
  list.hidden = !list.children.length;
  return () => marked;
}

// How a flag is marked, in maps and in sections (-1: no value).
function looks(study, flag) {
  const letter = element("span", { className: "letter" }, LETTERS.at(flag));
  letter.setAttribute("aria-hidden", "true");
  return study.kind === "maps" ? [swatch(flag), letter] : [letter];
}

// A small picture of how a flag is marked in a map.
function swatch(flag) {
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const [width, height] = [Math.round(28 * ratio), Math.round(16 * ratio)];
  const canvas = element("canvas", { width, height, className: "swatch" });
  canvas.setAttribute("aria-hidden", "true");
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const period = Math.round(HATCH * ratio);
  const colourAt = (x, y) => (flag < 0 ? gapColour(x, y, period) : MARKS[flag](x, y, period) ? DARK : PALE);
  for (let i = 0; i < pixels.length; i++) pixels[i] = colourAt(i % width, height - Math.floor(i / width));
  context.putImageData(image, 0, 0);
  return canvas;
}

// The line of each solver.
function buildSolvers(study, list) {
  list.replaceChildren();
  if (study.solver < 0) return;
  study.axes[study.solver].values.forEach((words, i) => {
    const [dash, width] = STROKES[i % STROKES.length];
    list.append(lineEntry(words, theme.seen(LINE_COLOURS[i % LINE_COLOURS.length]), dash === "solid" ? "" : dash, width));
  });
  list.hidden = false;
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
