// What a live figure is put together from: elements, buttons, the rows of its controls, a legend.

const LETTER_PX = 6.6; // of 13 px, on average and a little more
const STYLES = [
  ["1", "none"],
  ["2", "7 3"],
  ["3", "9 3 2 3"],
  ["4", "2 3"],
  ["5", "9 3 2 3 2 3"],
  ["6", "12 4"],
];

function put(element, attributes) {
  for (const name in attributes) element.setAttribute(name, attributes[name]);
  return element;
}
const html = (name, attributes, ...children) => {
  const element = put(document.createElement(name), attributes);
  element.append(...children);
  return element;
};
const svg = (name, attributes, ...children) => {
  const element = put(document.createElementNS("http://www.w3.org/2000/svg", name), attributes);
  element.append(...children);
  return element;
};
const text = (attributes, words) => svg("text", { "text-anchor": "middle", ...attributes }, words);
/** The lines of a text that has so much room. */
const wrapped = (words, px) =>
  words.split(" ").reduce((lines, word) => {
    const longer = [...lines.slice(-1), word].join(" ");
    const isNew = !lines.length || longer.length * LETTER_PX > px;
    return isNew ? [...lines, word] : [...lines.slice(0, -1), longer];
  }, []);
const write = (element, words) => {
  if (element.textContent !== words) element.textContent = words;
};
const strokeOf = ({ role, colour }) =>
  role === "own"
    ? `stroke:${paint(colour)};stroke-dasharray:${dashesOf(colour)}`
    : role === "area"
      ? `fill:${paint(colour)}`
      : "";
const dashesOf = (colour) =>
  // a colour that comes again has other dashes
  STYLES[(colour + Math.floor(colour / STYLES.length)) % STYLES.length][1];
const paint = (colour) => `var(--cm-${STYLES[colour % STYLES.length][0]})`;

/** A button; what it does is done at a press. */
function button(words, press) {
  const made = html("button", { type: "button" }, words);
  made.addEventListener("click", press);
  return made;
}

/** The row of one control, how it follows a new value, and how it forgets one that was refused;
 * `set` is called with the reader's. */
function rowOf(control, id, set) {
  const { name, unit, low, high, step, options } = control;
  const label = html("label", { for: id }, unit ? `${name}, ${unit}` : name);
  if (options) {
    const select = html(
      "select",
      { id },
      ...options.map((words, value) => html("option", { value }, words)),
    );
    select.addEventListener("change", () => set(Number(select.value)));
    return {
      row: html("div", {}, label, select),
      follow: (value) => {
        select.value = value;
      },
      settle: () => {},
    };
  }
  const field = html("input", {
    id,
    type: "text",
    inputmode: low < 0 ? "text" : "decimal", // some telephones have no sign among their numbers
    autocomplete: "off",
    "aria-describedby": `${id}e`,
  });
  const slider = html("input", {
    type: "range",
    min: low,
    max: high,
    step,
    "aria-label": label.textContent,
  });
  const error = html("span", { id: `${id}e`, class: "cm-error", role: "alert" });
  const judge = (words) => {
    write(error, words);
    put(field, { "aria-invalid": words !== "" });
  };
  field.addEventListener("change", () => {
    isTyped = false;
    const found = readings(field.value).filter((value) => value >= low && value <= high);
    if (found.length === 1) {
      judge("");
      set(found[0]);
    } else
      judge(
        found.length
          ? `“${field.value}” may be ${found.map(plain).join(" or ")}: write it with a point, or with no mark.`
          : `“${field.value}” was not taken: ${name} goes from ${plain(low)} to ${plain(high)}${unit && ` ${unit}`}.`,
      );
  });
  slider.addEventListener("input", () => set(Number(slider.valueAsNumber.toPrecision(12))));
  let words = "",
    isTyped = false; // what is being typed stays, whatever is drawn meanwhile
  field.addEventListener("input", () => (isTyped = true));
  field.addEventListener("blur", () => (isTyped = false));
  const settle = () => {
    if (error.textContent) field.value = words;
    judge("");
  };
  const follow = (value) => {
    words = plain(value);
    const isKept = isTyped || error.textContent || readings(field.value)[0] === readings(words)[0];
    if (!isKept) field.value = words;
    slider.value = value;
    put(slider, { "aria-valuetext": unit ? `${words} ${unit}` : words });
  };
  return { row: html("div", {}, label, field, slider, error), follow, settle };
}

/** The names of the lines, each beside a piece of it. */
function legendOf(columns, pin) {
  const all = columns
    .flat()
    .flatMap(({ lines, bare, y_label }) => lines.filter(({ name }) => bare || name !== y_label));
  const lines = new Map(
    [...all, ...(pin ? [{ name: "reference", role: "reference" }] : [])].map((line) => [
      line.name,
      line,
    ]),
  );
  lines.delete("");
  return html(
    "div",
    { class: "cm-legend" },
    ...[...lines].map(([name, line]) =>
      html(
        "span",
        {},
        svg(
          "svg",
          { width: 34, height: 10, "aria-hidden": true },
          svg("path", { class: `cm-line cm-${line.role}`, d: "M0 5H34", style: strokeOf(line) }),
        ),
        name,
      ),
    ),
  );
}
