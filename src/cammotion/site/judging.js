// What is said to an answer and to a prediction. Python has decided it when the page was built, or
// decides it by the same steps: `verdicts.py` and `teaching/prediction.py`.

const NUMBER =
  /(?<![\p{L}\p{N}_.,^/*])(?<value>[-+−]?\d+(?:[.,]\d+)?(?:e[-+]?\d+)?)(?:\s*\/\s*(?<over>\d+(?:[.,]\d+)?))?(?<percent>\s*%)?/giu;
const LARGEST = 1e12,
  CLOSE = 0.02,
  IN_TIMES = 2;

/** What an exercise's table says to a number; … in it is how many percent the number is off. */
export function verdict({ off, edges, places, said }, given, format) {
  const above = edges.findIndex((edge) => given < edge);
  const text = said[places[above < 0 ? edges.length : above]];
  return text.replace("off by …", () => `off by ${format(100 * Math.abs(given / off - 1), ".2g")}`);
}

/** The number that a typed prediction is, null if it is none or more than one. */
export function numberIn(text, asked) {
  const found = [...text.matchAll(NUMBER)].map(({ groups }) => groups);
  if (found.length !== 1) return null;
  const read = (digits) => Number(digits.replace(",", ".").replace("−", "-"));
  const [{ value, over, percent }] = found;
  if (over !== undefined && read(over) === 0) return null;
  const whole = read(value) / (over === undefined ? 1 : read(over));
  const number = percent && !asked.includes("percent") ? whole / 100 : whole;
  return Number.isFinite(number) && Math.abs(number) <= LARGEST ? number : null;
}

/** How far off a typed prediction is, "" where that is not one number beside another. */
export function howFar({ asked, true: right }, text, format) {
  const number = numberIn(text, asked);
  if (number === null) return "";
  if (number <= 0) return "too little";
  if (right.some((value) => Math.abs(number / value - 1) <= CLOSE)) return "as good as right";
  const ratio = number / right[0],
    too = ratio > 1 ? "too much" : "too little",
    times = Math.max(ratio, 1 / ratio);
  return times < IN_TIMES
    ? `${format(100 * Math.abs(ratio - 1), ".0f")} % ${too}`
    : `${format(times, ".2g")} times ${too}`;
}
