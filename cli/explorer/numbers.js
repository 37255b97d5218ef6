// Numbers as people read them, and round ticks for an axis.

const DIGITS = 6;

// Write a value to 6 digits, as "0.123456" or "1.5×10⁻⁷".
function short(value, digits = DIGITS) {
  if (typeof value === "string") return value;
  if (Number.isNaN(value)) return "no value";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  if (power >= -4 && power < DIGITS) return String(Number(value.toPrecision(digits))).replace("-", "−");
  const tens = "10" + String(Number(power)).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]);
  const factor = String(Number(mantissa)).replace("-", "−");
  return factor === "1" ? tens : `${factor}×${tens}`;
}

// Write a value of an axis or a parameter with its unit, an infinite one by its word.
function inWords(entry, value) {
  return value === Infinity && entry.infinite ? entry.infinite : [short(value), entry.unit].filter(Boolean).join(" ");
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
  const found = [];
  for (let power = Math.floor(start); power <= end; power++) {
    if (power % step === 0) found.push(...factors.map((one) => power + Math.log10(one)));
  }
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
  if (look.listed) {
    const step = Math.max(1, Math.ceil((end - start) / 12));
    return Array.from(look.places).filter((one) => one % step === 0 && inside(one));
  }
  const found = (look.log ? powerTicks : roundNumbers)(start, end, count).filter((one) => one <= look.ends[1] + apart / 8);
  if (look.infinity !== null && inside(look.infinity)) found.push(look.infinity);
  return found;
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
  const size = places.length;
  if (size === 1) return [places[0] - 0.5, places[0] + 0.5];
  const edges = [1.5 * places[0] - 0.5 * places[1]];
  for (let i = 1; i < size; i++) edges.push(0.5 * (places[i - 1] + places[i]));
  edges.push(1.5 * places[size - 1] - 0.5 * places[size - 2]);
  return edges;
}

// The cell that a place is in, -1 if it is in none.
function cellAt(edges, place) {
  let low = 0;
  let high = edges.length - 1;
  if (!(place >= edges[low] && place <= edges[high])) return -1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (edges[middle] <= place) low = middle;
    else high = middle;
  }
  return low;
}
