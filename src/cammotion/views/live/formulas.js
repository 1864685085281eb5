// What a live figure computes: its formulas, which SymPy has printed, its numbers and its curves.
// In a formula x is what runs, or the pointer's x, and y the pointer's y; c0, c1, ... are the
// settings, p0, ... the pinned settings, q0, ... what follows from them. `formulas.py` does the
// same by the same steps.

const SAMPLES = 200,
  HALVINGS = 60,
  NARROWINGS = 48,
  POLE = 1e-7,
  GOLDEN = (Math.sqrt(5) - 1) / 2;
const TICKS = 4,
  SPIKE = 20,
  NEAR = 1e-9,
  HUGE = 1e300;
const MATH = Object.getOwnPropertyNames(Math);
// nothing else is ever run, whoever has written a description: numbers, these words and signs,
// the names of the figure's values, and functions of one z; no dot, bracket, quote, or lone =
const WORDS = new Set([...MATH, "NaN", "Infinity", "largest", "place_of_largest", "inverse"]);
const SIGNS = new Set("+ - * / % < > <= >= == != === !== ! && || ( ) , ? :".split(" ").concat(" "));
const PARTS = /\d[\d.]*(?:e[+-]?\d+)?|\(z\d+\)=>|[\w$]+|[-=<>!&|+*\/]+|[^]/g;
const OWN = /^(?:\d+(?:\.\d*)?(?:e[+-]?\d+)?|\(z\d+\)=>|[cpqfz]\d+|[xy])$/;

function check(formula) {
  for (const part of String(formula).match(PARTS) ?? []) {
    if (!OWN.test(part) && !WORDS.has(part) && !SIGNS.has(part))
      throw new Error(`This is no formula of a figure, since ${part} is in it: ${formula}`);
  }
}

/** Where f is largest from low to high, and how large: the best of the samples, then narrowed. */
function search(f, low, high) {
  const at = (i) => low + (i * (high - low)) / SAMPLES;
  let best = 0,
    value = -Infinity;
  for (let i = 0; i <= SAMPLES; i++) {
    const y = f(at(i));
    if (y > value) [best, value] = [i, y];
  }
  if (!best) value = f(low); // which is no number where none of the samples is
  let a = at(Math.max(best - 1, 0)),
    b = at(Math.min(best + 1, SAMPLES));
  for (let i = 0; i < NARROWINGS; i++) {
    const c = b - (b - a) * GOLDEN,
      d = a + (b - a) * GOLDEN;
    if (f(c) > f(d)) b = d;
    else a = c;
  }
  const between = (a + b) / 2,
    there = f(between);
  if (!(there > value)) return [at(best), value];
  const near = POLE * (high - low),
    beside = Math.max(f(between - near), f(between + near));
  return [between, there > 100 * Math.abs(beside) ? Infinity : there]; // it grows without end
}
export const largest = (f, low, high) => search(f, low, high)[1];
export const place_of_largest = (f, low, high) => search(f, low, high)[0];

/** Where the monotone f has a value, by halving; NaN if it is nowhere from low to high. */
export function inverse(f, low, high, value) {
  const sign = f(high) >= f(low) ? 1 : -1,
    past = (x) => sign * (f(x) - value);
  if (!(past(low) <= 0 && past(high) >= 0)) return NaN;
  for (let i = 0; i < HALVINGS; i++) {
    const middle = (low + high) / 2;
    if (past(middle) < 0) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** A function of settings and pinned settings that returns the formulas as functions of x, y. */
export function compile({ quantities, formulas, controls }) {
  [...quantities, ...formulas].forEach(check);
  const names = (letter) => `[${controls.map((_, i) => letter + i)}]`;
  const body =
    quantities.map((q, i) => `const q${i}=${q};`).join("") +
    `const ${formulas.map((f, i) => `f${i}=(x,y)=>${f}`)};return [${formulas.map((_, i) => `f${i}`)}]`;
  return new Function(
    `{${MATH}}`,
    "largest,place_of_largest,inverse",
    `return (${names("c")},${names("p")})=>{${body}}`,
  )(Math, largest, place_of_largest, inverse);
}

/** A number as Python's format writes it, by ".3f" or ".4g", with a true minus; what is
 * written as 0 has none. */
export function format(value, spec) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value < 0 ? "−∞" : "∞";
  const [, digits = 6, kind] = spec.match(/^(?:\.(\d+))?([fg])$/);
  const size = (kind === "f" ? fixed : general)(Math.abs(value), Number(digits));
  return value < 0 && /[1-9]/.test(size) ? `−${size}` : size;
}
function fixed(size, digits) {
  if (size >= 1e21) return BigInt(size) + (digits ? `.${"0".repeat(digits)}` : "");
  return toEven(size.toFixed(digits), size.toFixed(100), digits);
}
function general(size, digits) {
  const last = Math.max(digits, 1) - 1,
    short = (text) => text.replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  const [rounded, power] = size.toExponential(last).split("e");
  if (power >= -4 && power <= last) return short(fixed(size, last - power));
  const mantissa = toEven(rounded, size.toExponential(100).split("e")[0], last);
  return `${short(mantissa)}e${power[0].replace("-", "−")}${power.slice(1).padStart(2, 0)}`;
}
/** What JavaScript has rounded, or the even neighbour, as Python rounds a half. */
function toEven(rounded, exact, digits) {
  const end = exact.indexOf(".") + 1 + digits,
    kept = digits ? exact.slice(0, end) : exact.slice(0, end - 1);
  return /^50*$/.test(exact.slice(end)) && kept.at(-1) % 2 === 0 ? kept : rounded;
}
export const plain = (value) => format(Number(value.toPrecision(12)), ".12g");

/** The power of ten that is taken out of the numbers of an axis, which have room for four digits,
 * three after a minus, and a point; 0 where they have room, and where the label has no unit to take
 * it. */
export function powerOf(numbers, label) {
  const isLong = numbers.some((value) => /e|.{6}|\d{5}|−\d{4}/.test(plain(value)));
  if (!isLong || !/\bin [^\s\d]/.test(label)) return 0;
  return Math.floor(Math.log10(Math.max(...numbers.map(Math.abs))) + NEAR);
}

/** A label with a power of ten before its unit: "way in 10⁻³ mm". */
export function withPower(label, power) {
  const high = String(power).replace(/./g, (sign) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign] ?? "⁻");
  return power ? label.replace(/\bin (?=[^\s\d])(?!.*\bin [^\s\d])/, `in 10${high} `) : label;
}

/** The numbers that a typed text may be, none for what is no number. A decimal comma is a point;
 * one comma before three digits may also part thousands. */
export function readings(text) {
  const typed = text.trim().replaceAll("−", "-");
  const point = typed.replace(",", ".");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(point)) return [];
  const isTwo = /^[+-]?[1-9]\d{0,2},\d{3}$/.test(typed);
  return isTwo ? [Number(point), Number(typed.replace(",", ""))] : [Number(point)];
}

/** The sentences of a figure: of each the first alternative whose condition holds. */
export function sentences({ sentences, controls }, now, settings, clock) {
  const words = (piece) =>
    typeof piece === "string"
      ? piece
      : "choice" in piece
        ? controls[piece.choice].options[settings[piece.choice]]
        : format(Number(now[piece.formula](clock)), piece.spec);
  return sentences
    .map((alternatives) => alternatives.find(({ when }) => when === null || now[when](clock)))
    .map((said) => (said ? said.pieces.map(words).join("") : ""))
    .filter((text) => text);
}

/** Settings with some of them changed: kept in their ranges, while the others give way. */
export function change({ controls }, make, settings, changes) {
  const within = (i, value) => Math.min(controls[i].high, Math.max(controls[i].low, value));
  const changed = settings.map((value, i) => (i in changes ? within(i, changes[i]) : value));
  const limited = controls.map((_, i) => i).filter((i) => controls[i].most !== null);
  const others = limited.filter((i) => !(i in changes));
  for (const i of [...others, ...limited]) {
    // the others first, then what has been moved
    const high = make(changed, changed)[controls[i].most]();
    if (high < changed[i]) changed[i] = within(i, high); // and not where it is no number
  }
  return changed;
}

/** Round limits for an axis, and a step: they hold the values, but no spikes beside a pole. */
export function limits(values) {
  const sorted = values.filter((value) => Math.abs(value) < HUGE).sort((a, b) => a - b),
    last = sorted.length - 1;
  if (last < 0) return [0, 1, 0.25];
  let [low, high] = [sorted[0], sorted[last]];
  const few = sorted[Math.floor(0.05 * last)],
    most = sorted[Math.ceil(0.95 * last)];
  const usual = most - few;
  if (usual > 0 && high - low > SPIKE * usual) {
    [low, high] = [Math.max(low, few - usual), Math.min(high, most + usual)];
  }
  const isFlat = high - low <= NEAR * Math.max(Math.abs(low), Math.abs(high));
  if (low > 0 && (isFlat || low < high / 2)) low = 0;
  if (high < 0 && (isFlat || high > low / 2)) high = 0;
  if (!(high - low > 1 / HUGE)) [low, high] = [0, 1];
  const step = tick(high - low);
  return [Math.floor(low / step + NEAR) * step, Math.ceil(high / step - NEAR) * step, step];
}
/** A round step of which about four make a width. */
export function tick(width) {
  const size = (width / TICKS) * (1 - NEAR),
    decade = 10 ** Math.floor(Math.log10(size));
  return [1, 2, 2.5, 5, 10].find((step) => step * decade >= size) * decade;
}
/** How far an arrow key moves a point: a power of ten, of which 50 to 500 make an axis. */
export const nudge = ([low, high]) => 10 ** Math.floor(Math.log10((high - low) / 50));

/** The points of a line, where the clock stands: its joints from both sides, and the ends of what is real, by halving. */
export function trace({ over, where, y, x, joints }, now, clock) {
  const [low, high] = over.map((i) => now[i]()),
    gap = NEAR * (high - low);
  const isThere = (place) => where === null || now[where](place, clock) > 0;
  const at = (place) => [
    x === null ? place : now[x](place, clock),
    isThere(place) ? now[y](place, clock) : NaN,
    place,
  ];
  const isReal = ([a, b]) => Number.isFinite(a) && Number.isFinite(b);
  const places = Array.from({ length: SAMPLES + 1 }, (_, i) => low + (i * (high - low)) / SAMPLES);
  for (const joint of joints.map((i) => now[i]())) {
    if (joint > low && joint < high) places.push(joint - gap, joint + gap);
  }
  if (joints.length) places.sort((a, b) => a - b);
  const points = [];
  let before = null;
  for (const point of places.map(at)) {
    const real = isReal(point);
    if (before && real !== isReal(before)) {
      const edge = edgeOf(...(real ? [point, before] : [before, point]), at, isReal);
      points.push(...(real ? [[NaN, NaN], edge] : [edge, [NaN, NaN]]));
    }
    if (real) points.push(point);
    before = point;
  }
  return points;
}
function edgeOf([, , inside], [, , outside], at, isReal) {
  for (let i = 0; i < HALVINGS / 2; i++) {
    const middle = (inside + outside) / 2;
    if (isReal(at(middle))) inside = middle;
    else outside = middle;
  }
  return at(inside);
}
