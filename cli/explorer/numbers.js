// Numbers as people read them, and round ticks for an axis.

// Write a value to some digits, as "0.123456" or "1.5×10⁻⁷".
function short(value, digits = 6) {
  if (typeof value === "string") return value;
  if (Number.isNaN(value)) return "no value";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const [front, power] = value.toExponential(digits - 1).split("e");
  if (value === 0 || (power >= -4 && power < 6)) return String(Number(value.toPrecision(digits))).replace("-", "−");
  const tens = "10" + String(Number(power)).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]);
  const factor = String(Number(front)).replace("-", "−");
  return factor === "1" ? tens : `${factor}×${tens}`;
}

// Write a value of an axis or a parameter with its unit, an infinite one by its word.
function inWords(entry, value) {
  return value === Infinity && entry.infinite ? entry.infinite : [short(value), entry.unit].filter(Boolean).join(" ");
}

function withUnit(text, unit) {
  return unit ? `${text} (${unit})` : text;
}

// Round numbers between two others, `count` or fewer.
function roundNumbers(start, end, count) {
  const rough = (end - start) / count;
  if (!(rough > 0) || !Number.isFinite(rough)) return [start];
  const ten = 10 ** Math.floor(Math.log10(rough));
  const step = ten * ([1, 2, 2.5, 5].find((one) => one * ten >= rough) ?? 10);
  const found = [];
  for (let i = Math.ceil(start / step - 1e-9); i * step <= end + 1e-9 * step; i++) found.push(i * step);
  return found;
}

// Ticks of a logarithmic axis, whose places are powers of ten.
function powerTicks(start, end, count) {
  const decades = end - start;
  if (decades < 0.95) return roundNumbers(10 ** start, 10 ** end, count).filter((one) => one > 0).map(Math.log10);
  const factors = decades < 2.4 ? [1, 2, 5] : decades < 4 ? [1, 3] : [1];
  const step = Math.max(1, Math.ceil(decades / count));
  const powers = Array.from({ length: Math.ceil(decades) + 2 }, (_, i) => Math.floor(start) + i);
  const found = powers.filter((power) => power % step === 0).flatMap((power) => factors.map((one) => power + Math.log10(one)));
  return found.filter((one) => one >= start - 1e-9 && one <= end + 1e-9);
}

// What an axis of values looks like, of which no place has a meaning of its own.
function lookOf(log) {
  return { log, listed: false, infinity: null, ends: [-Infinity, Infinity], few: [], values: [] };
}

// Ticks of an axis between two places: its own values where they are few, round numbers otherwise, and infinity.
function ticksOf(look, start, end, count = 6) {
  const inside = (place) => place >= start && place <= end;
  const apart = (end - start) / 16;
  const few = Array.from(look.few);
  const long = Math.max(4, ...few.map((one) => tickWords(look, one).length)) / 4; // long numbers need more room
  if (few.length && few.every((one, i) => i === 0 || one - few[i - 1] >= long * apart)) return few.filter(inside);
  if (look.listed) return Array.from(look.places).filter((one) => inside(one) && one % Math.ceil((end - start) / 12 || 1) === 0);
  const found = (look.log ? powerTicks : roundNumbers)(start, end, count).filter((one) => one <= look.ends[1] + apart / 8);
  return look.infinity !== null && inside(look.infinity) ? [...found, look.infinity] : found;
}

// The words at a tick.
function tickWords(look, place) {
  if (look.listed) return look.values[Math.round(place)] ?? "";
  if (look.infinity !== null && Math.abs(place - look.infinity) < 1e-9 * (1 + Math.abs(place))) return "∞";
  const value = look.log ? 10 ** place : place;
  return short(Math.abs(value) < 1e-12 ? 0 : Number(value.toPrecision(4)), 4);
}

// The edges of cells about their places: half-way between them.
function edgesOf(places) {
  if (places.length === 1) return [places[0] - 0.5, places[0] + 0.5];
  const [first, last] = [2 * places[0] - places[1], 2 * places.at(-1) - places.at(-2)];
  const wide = [first, ...places, last];
  return wide.slice(1).map((place, i) => 0.5 * (place + wide[i]));
}

// The cell that a place is in, -1 if it is in none.
function cellAt(edges, place) {
  if (!(place >= edges[0] && place <= edges.at(-1))) return -1;
  return Math.max(0, Math.min(edges.length - 2, edges.findLastIndex((edge) => edge <= place)));
}
