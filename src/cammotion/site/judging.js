// What is said to an answer and to a prediction. Python has decided it when the page was built, or
// decides it by the same steps: `verdicts.py` and `teaching/prediction.py`. How a prediction is
// read stands before this file, as PREDICTED: `teaching/prediction_words.py`.

const GROUPED =
  /^([-+−]?[1-9]\d{0,2}([.,'’ \u00a0\u202f])\d{3}(?:\2\d{3})*)(?:(?!\2)[.,](\d+))?$/; // 4,420.8
const WITH_UNIT = /\d\s*[\p{L}%°]/u;
const LARGEST = 1e12,
  CLOSE = 0.02,
  IN_TIMES = 1.95,
  SHOWN = 60;

/** What is said to a typed answer, "" to none. No number is named but the typed one: any may be
 * the right one of some exercise. */
export function answerTo(table, typed, { format, readings }) {
  const found = readings(withoutMarks(typed.trim()));
  if (!typed.trim()) return "";
  if (found.length === 1) return verdict(table, found[0], format);
  if (found.length)
    return `“${typed}” may be ${found.join(" or ")}: write it with a point, or with no mark.`;
  const how = WITH_UNIT.test(typed) ? "it alone, without its unit" : "one number, in digits alone";
  return `“${typed}” is no number: write ${how}.`;
}

/** A typed number without the marks that part its thousands, where it is plain which these are. */
function withoutMarks(typed) {
  const [, whole, mark, part] = typed.match(GROUPED) ?? [];
  if (!whole || (!part && /^[^.,]*[.,][^.,]*$/.test(whole))) return typed;
  return whole.replaceAll(mark, "") + (part ? `.${part}` : "");
}

/** What an exercise's table says to a number; … in it is how many percent the number is off. */
export function verdict({ off, edges, places, said }, given, format) {
  const above = edges.findIndex((edge) => given < edge);
  const text = said[places[above < 0 ? edges.length : above]];
  return text.replace("off by …", () => `off by ${format(100 * Math.abs(given / off - 1), ".2g")}`);
}

const patterns = {};

/** The numbers that a typed prediction may be: one, none, or two that make sense. */
export function numbersIn({ asked, low, high }, typed, readings) {
  const question = plainly(asked);
  const where = PREDICTED.whereAsked.filter(([asks]) => has(question, asks));
  const said = written(plainly(typed), where.map(([, ...row]) => row));
  const found = [...said.matchAll(pattern(PREDICTED.number))];
  if (found.length !== 1 || !isKnown(said, found[0], question)) return [];
  const [[, whole, value, over]] = found;
  const isChange = said.includes("%") && !question.includes("%") && value.startsWith("-");
  if (isChange || (over && has(question, PREDICTED.counted))) return [];
  const parts = partsOf(question, said, Boolean(over && !whole));
  const numbers = readings(value)
    .flatMap((a) => readings(over ?? "1").filter((b) => b !== 0).map((b) => a / b))
    .map((one) => (Number(whole ?? 0) + one) / parts)
    .filter((one) => isBelieved(one, question) && low <= Math.abs(one));
  const sensible = numbers.filter((one) => Math.abs(one) <= high);
  return sensible.length ? sensible : numbers;
}

/** By what a number is divided, so that a share is in the unit that is asked for. */
function partsOf(question, said, isFraction) {
  if (!question.includes("%")) return said.includes("%") ? 100 : 1;
  return isFraction && !said.includes("%") ? 0.01 : 1;
}

function isBelieved(number, question) {
  if (has(question, PREDICTED.counted) && number % 1) return false;
  return number === 0 || (1 / LARGEST <= Math.abs(number) && Math.abs(number) <= LARGEST);
}

/** A text in small letters, with what may be written in many ways in one of them. */
function plainly(text) {
  return written(written(text, PREDICTED.signs).toLowerCase().normalize("NFKC"), PREDICTED.plainly);
}

function written(text, rows) {
  return rows.reduce((now, [source, plain]) => now.replace(pattern(source), plain), text);
}

/** Whether what stands beside a number says nothing else than what is asked. */
function isKnown(said, { 0: number, index }, question) {
  const rest = said.slice(index + number.length),
    [remark = ""] = all(rest, PREDICTED.remark),
    behind = all(rest.slice(0, rest.length - remark.length), PREDICTED.part);
  const [telling, notOwn] = [PREDICTED.telling, PREDICTED.notOwn].map(listed),
    told = all(remark, PREDICTED.part).filter((part) => telling.includes(part)),
    own = all(question, PREDICTED.word).filter((word) => !notOwn.includes(word));
  const known = [...own, ...listed(PREDICTED.plain), ...knownWhere(PREDICTED.beside, question)],
    knownBehind = [...known, ...knownWhere(PREDICTED.behind, question)];
  return (
    all(said.slice(0, index), PREDICTED.part).every((part) => known.includes(part)) &&
    [...behind, ...told].every((part) => knownBehind.includes(part))
  );
}

function knownWhere(rows, question) {
  return rows.filter(([asks]) => has(question, asks)).flatMap(([, known]) => listed(known));
}

function pattern(source) {
  return (patterns[source] ??= new RegExp(source, "gu"));
}

function has(text, source) {
  return text.search(pattern(source)) >= 0;
}

function all(text, source) {
  return text.match(pattern(source)) ?? [];
}

function listed(words) {
  return words.trim().split(/\s+/);
}

/** What a typed prediction may be, "" unless that is more than one number. */
export function unclear(made, text, { readings }) {
  const numbers = numbersIn(made, text, readings);
  if (numbers.length < 2) return "";
  const said = numbers.map((number) => Number(number.toPrecision(12))).join(" or ");
  return `“${shortened(text)}” may be ${said}: write it with a point, or with no mark.`;
}

function shortened(text) {
  const letters = [...text];
  return letters.length > SHOWN ? `${letters.slice(0, SHOWN - 3).join("")}...` : text;
}

/** How far off a typed prediction is, "" where that is not one number beside another. */
export function howFar(made, text, { format, readings }) {
  const numbers = numbersIn(made, text, readings);
  if (numbers.length !== 1) return "";
  const [number] = numbers,
    right = made.true;
  if (made.isPlace) {
    const off = Math.abs(number - right[0]);
    return off ? `${format(off, "g")} place${off === 1 ? "" : "s"} off` : "as good as right";
  }
  if (number === 0) return "too little";
  const isClose = right.some((value) => Math.abs(Math.abs(number) / value - 1) <= made.near);
  if (number < 0) return isClose ? "right but for its sign" : "of the wrong sign";
  if (isClose) return "as good as right";
  const ratio = number / right[0],
    too = ratio > 1 ? "too much" : "too little",
    times = Math.max(ratio, 1 / ratio);
  if (times < IN_TIMES) return `${format(100 * Math.abs(ratio - 1), ".0f")} % ${too}`;
  const mayBeShare = made.asked.includes("percent") && !plainly(text).includes("%");
  if (mayBeShare && Math.abs(100 * ratio - 1) <= CLOSE)
    return "right, if it is a share (in percent it is a hundred times that)";
  return `${Number(format(times, ".2g"))} times ${too}`;
}
