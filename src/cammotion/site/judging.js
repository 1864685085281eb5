// What is said to an answer and to a prediction. Python has decided it when the page was built, or
// decides it by the same steps: `verdicts.py` and `teaching/prediction.py`.

const LETTER = String.raw`[a-zµμ\u00c0-\u024f]`;
const SHARE = /%|per ?cent|prozent/i;
const NUMBER =
  /(?<![\p{L}\p{N}_.,^/*])(?<value>[-+−]?(?:\d+(?:[.,]\d+)?|\.\d+)(?:e[-+]?\d+)?)(?:\s*\/\s*(?<over>\d+(?:[.,]\d+)?|\.\d+))?(?![.,]?\d|\s*\/\s*\d)/giu;
const PART_WORDS = "half|halves|thirds?|quarters?|(?:four|fif|six|seven|eigh|nin|ten)ths?";
const UNSURE = new RegExp(
  [
    String.raw`(?<!\/s)\^|(?<!\/s)(?<!\/s\*)\*`, // but for the square of a second
    `[√×·=<>≤≥π]|(?<!${LETTER})pi(?!${LETTER})`, // what is to be reckoned out
    String.raw`\b(?:at (?:least|most)|sqrt|root|less|more|below|above|least|most|than|minimum|times)\b`,
    String.raw`\b(?:${PART_WORDS}|twice)\s+(?:(?:of|the|about)\s+)*(?=[\-+−]?\.?\d)`, // half of 4.154
    String.raw`(?:\d\s*|\band\s+an?\s+)(?:${PART_WORDS})\b`, // 2 thirds, 2 and a half
  ].join("|"),
  "giu",
);
// What is written otherwise before a text is read.
const PLAIN = [
  [/^\s*['‘](.*)['’]\s*$/u, "$1"], // 'in quotes'
  [/(?<![\d.,])(\d{1,3})[ \u00a0\u202f](\d{3})(?![.,]?\d)/g, "$1$2"], // 4 500
  [/(?<=\d)\s*½/g, ".5"],
  [/(?<=\d)\s*¼/g, ".25"],
  [/(?<=\d)\s*¾/g, ".75"],
  [new RegExp(String.raw`\s*(?:[x×*·]|times)\s*tm(?!${LETTER})`, "giu"), " tm"],
  [/(?<=\d)\s*[x×](?![\p{L}\p{N}_])/giu, " times"], // 2x
];
const PART = /(?<count>(?<![\d.,/])\d+\s*of\b)|\d\s*of\b/gi; // 0.9 of it
// 10 % lower: a share of what is to be told, and not what is left of it.
const CHANGE =
  /[-+−]\s*\.?\d|\b(?:lower|smaller|higher|larger|greater|bigger|better|worse)\b|\b(?:off|under|over|by|minus|plus)\b/i;
const GROUPED =
  /^([-+−]?[1-9]\d{0,2}([.,'’ \u00a0\u202f])\d{3}(?:\2\d{3})*)(?:(?!\2)[.,](\d+))?$/; // 4,420.8
const WITH_UNIT = /\d\s*[\p{L}%°]/u;
const UNITS = {
  m: /m|met(?:er|re)s?/,
  cm: /cm/,
  mm: /mm/,
  um: /[µμu]m|microns?/,
  inch: /inch(?:es)?|in(?!\s+[a-zµμ\u00c0-\u024f])/, // 92 in each direction
  rad: /rad(?:ians?)?/,
  deg: /deg(?:rees?)?|°/,
  min: /min(?:utes?|s)?|rpm|['\u2032\u2019]/,
  s: /s|sec(?:onds?|s)?/,
  g: /g/,
  k: /k|thousand/,
};
// A short one only at a number, at a stroke or after "per".
const UNIT = new RegExp(
  String.raw`(?:\d\s*|\/\s*|\bper\s+|(?<!${LETTER})(?=${LETTER}+\s*\/|(?!in\b)${LETTER}{2}))(?:` +
    Object.entries(UNITS).map(([name, { source }]) => `(?<${name}>${source})`).join("|") +
    `)(?!${LETTER})`,
  "giu",
);
const TIMES_THE = "times the";
const SHARES = ["percent", "fraction", TIMES_THE];
const WHOLE = "out of";
const WHOLES = [WHOLE, "place,"]; // here a stroke parts what is asked for from all there are
const LARGEST = 1e12,
  CLOSE = 0.02,
  IN_TIMES = 1.95;

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

/** The numbers that a typed prediction may be: one, none, or two that make sense. */
export function numbersIn({ asked, low, high }, typed, readings) {
  const text = PLAIN.reduce((read, [written, plain]) => read.replace(written, plain), typed);
  const found = [...text.matchAll(NUMBER)].map(({ groups }) => groups);
  const isShare = saysShare(text);
  const isOne =
    !(text.includes("/") && WHOLES.some((whole) => asked.includes(whole))) &&
    !isPart(text, asked) &&
    !isUnsure(text, asked) &&
    !(asked && unitsOf(text).some((unit) => !unitsOf(asked).includes(unit)));
  if (found.length !== 1 || !isOne) return [];
  const [{ value, over }] = found;
  const inPercent = asked.includes("percent");
  const parts = isShare ? (inPercent ? 1 : 100) : over && inPercent ? 0.01 : 1;
  const numbers = readings(value)
    .flatMap((a) => readings(over ?? "1").map((b) => (b === 0 ? NaN : a / b / parts)))
    .filter((number) => number === 0 || isBelieved(Math.abs(number)));
  const sensible = numbers.filter((number) => low <= Math.abs(number) && Math.abs(number) <= high);
  return sensible.length ? sensible : numbers;
}

/** Whether a text is a part of something that is not typed, but for a part that is asked. Of what is
 * so many times something, a share is one, unless it is by how much that changes. So many of them
 * are no part where it is asked how many. */
function isPart(text, asked) {
  if (SHARES.some((share) => asked.includes(share)))
    return asked.includes(TIMES_THE) && saysShare(text) && CHANGE.test(text);
  const parts = [...text.matchAll(PART)];
  return saysShare(text) || parts.some(({ groups }) => !(groups.count && asked.includes(WHOLE)));
}

/** Whether a text has a sign or a word that makes its number none, but for those asked. */
function isUnsure(text, asked) {
  const may = asked || "times"; // where nothing says what is asked
  return [...text.matchAll(UNSURE)].some(([found]) => !may.includes(found.toLowerCase()));
}

function unitsOf(text) {
  const found = [...text.matchAll(UNIT)].map(({ groups }) => Object.entries(groups));
  return found.map((named) => named.find(([, words]) => words)[0]);
}

function isBelieved(size) {
  return 1 / LARGEST <= size && size <= LARGEST;
}

function saysShare(text) {
  return SHARE.test(text);
}

/** What a typed prediction may be, "" unless that is more than one number. */
export function unclear(made, text, { readings }) {
  const numbers = numbersIn(made, text, readings);
  if (numbers.length < 2) return "";
  const said = numbers.map((number) => Number(number.toPrecision(12))).join(" or ");
  return `“${text}” may be ${said}: write it with a point, or with no mark.`;
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
  const isClose = right.some((value) => Math.abs(Math.abs(number) / value - 1) <= CLOSE);
  if (number < 0) return isClose ? "right but for its sign" : "of the wrong sign";
  if (isClose) return "as good as right";
  const ratio = number / right[0],
    too = ratio > 1 ? "too much" : "too little",
    times = Math.max(ratio, 1 / ratio);
  if (times < IN_TIMES) return `${format(100 * Math.abs(ratio - 1), ".0f")} % ${too}`;
  const mayBeShare = made.asked.includes("percent") && !saysShare(text);
  if (mayBeShare && Math.abs(100 * ratio - 1) <= CLOSE)
    return "right, if it is a share (in percent it is a hundred times that)";
  return `${Number(format(times, ".2g"))} times ${too}`;
}
