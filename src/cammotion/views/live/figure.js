// A live figure where its reader is: in a notebook the model is the widget's, in a page the
// page's own. It is drawn in the page's own pixels, so that its text is as large on a phone.

const STYLES = [["1", "none"], ["2", "7 3"], ["3", "9 3 2 3"], ["4", "2 3"], ["5", "9 3 2 3 2 3"], ["6", "12 4"]];
const PAUSE_MS = 600, BEYOND_PX = 9999, TALLEST_PX = 440, KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
let figures = 0;

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
const write = (element, words) => { if (element.textContent !== words) element.textContent = words; };
const strokeOf = ({ role, colour }) => role === "own" ? `stroke:${paint(colour)};stroke-dasharray:${STYLES[colour % STYLES.length][1]}` : "";
const paint = (colour) => `var(--cm-${STYLES[colour % STYLES.length][0]})`;

/** A button; what it does is done at a press. */
function button(words, press) {
  const made = html("button", { type: "button" }, words);
  made.addEventListener("click", press);
  return made;
}

/** The row of one control, and how it follows a new value; `set` is called with the reader's. */
function rowOf(control, id, set) {
  const { name, unit, low, high, step, options } = control;
  const label = html("label", { for: id }, unit ? `${name}, ${unit}` : name);
  if (options) {
    const select = html("select", { id }, ...options.map((words, value) => html("option", { value }, words)));
    select.addEventListener("change", () => set(Number(select.value)));
    return { row: html("div", {}, label, select), follow: (value) => { select.value = value; } };
  }
  const field = html("input", { id, type: "text", inputmode: "decimal", autocomplete: "off", "aria-describedby": `${id}e` });
  const slider = html("input", { type: "range", min: low, max: high, step, "aria-label": label.textContent });
  const error = html("span", { id: `${id}e`, class: "cm-error", role: "alert" });
  const judge = (words) => { write(error, words); put(field, { "aria-invalid": words !== "" }); };
  field.addEventListener("change", () => {
    const value = parse(field.value);
    if (value >= low && value <= high) {
      judge("");
      set(value);
    } else judge(`“${field.value}” was not taken: ${name} goes from ${plain(low)} to ${plain(high)}${unit && ` ${unit}`}.`);
  });
  slider.addEventListener("input", () => { judge(""); set(Number(slider.valueAsNumber.toPrecision(12))); });
  const follow = (value) => {
    const words = plain(value);
    if (parse(field.value) !== parse(words) && !error.textContent) field.value = words;
    slider.value = value;
    put(slider, { "aria-valuetext": unit ? `${words} ${unit}` : words });
  };
  return { row: html("div", {}, label, field, slider, error), follow };
}

/** A panel: what it is made of, still without a place; `draw` gives it one. */
class Panel {
  constructor(panel, id, isLast, pin) {
    Object.assign(this, { panel, hasNumbers: isLast || !panel.shares_x, view: {} });
    this.grid = svg("g", { class: "cm-grid" });
    this.hole = svg("rect", {});
    this.cursor = svg("path", { class: "cm-cursor" });
    this.boxes = panel.boxes.map((box) => ({ box, rect: svg("rect", { class: "cm-box" }), word: text({ class: "cm-alarm" }, box.name) }));
    this.lines = panel.lines.map((line) => ({
      line,
      twin: pin && line.role === "own" ? svg("path", { class: "cm-line cm-reference" }) : null,
      path: svg("path", { class: `cm-line cm-${line.role}`, style: strokeOf(line) }),
    }));
    this.points = panel.points.map((point) => ({
      point,
      dot: svg("circle", { class: "cm-point", r: point.drags ? 9 : 5, style: `fill:${paint(point.colour)}` }),
      word: svg("text", {}, point.name),
    }));
    const inside = svg("g", { "clip-path": `url(#${id}k)` }, ...this.boxes.map(({ rect }) => rect), this.cursor,
      ...this.lines.flatMap(({ twin, path }) => (twin ? [twin, path] : [path])));
    this.root = svg("svg", { role: "img", "aria-labelledby": `${id}t` }, svg("title", { id: `${id}t` }, panel.title),
      svg("clipPath", { id: `${id}k` }, this.hole), this.grid, inside,
      ...this.boxes.map(({ word }) => word), ...this.points.flatMap(({ dot, word }) => [dot, word]));
  }

  /** Let the reader move a point that drags controls, by pointer and by arrow key. */
  letDrag(move) {
    const { root } = this, pad = this.points.find(({ point }) => point.drags);
    if (!pad) return;
    const { point, dot } = pad;
    const follow = ({ clientX, clientY }) => {
      const box = root.getBoundingClientRect(), { X, Y } = this.view;
      move({ point, at: [X.back(clientX - box.left), Y.back(clientY - box.top)] });
    };
    put(root, { class: "cm-pad", role: "group" });
    put(dot, { tabindex: 0, role: "application", "aria-label": point.label });
    root.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      root.setPointerCapture(event.pointerId);
      dot.focus();
      follow(event);
    });
    root.addEventListener("pointermove", (event) => { if (root.hasPointerCapture(event.pointerId)) follow(event); });
    dot.addEventListener("keydown", (event) => {
      if (!(event.key in KEYS)) return;
      event.preventDefault();
      move({ point, by: KEYS[event.key] });
    });
  }

  /** Draw it with these formulas, and these of the pinned settings; true if a curve is there. */
  draw(now, then, clock) {
    const { panel } = this;
    const traced = this.lines.map(({ line, twin }) => ({ line, own: trace(line, now), twin: twin ? trace(line, then) : [] }));
    this.scale(now, traced);
    const { X, Y, top, bottom, left, right } = this.view;
    this.lines.forEach(({ path, twin }, i) => {
      put(path, { d: this.pathOf(traced[i].own) });
      if (twin) put(twin, { d: this.pathOf(traced[i].twin) });
    });
    for (const { box, rect, word } of this.boxes) {
      const side = (name, edge, axis) => (box[name] === null ? edge : axis(now[box[name]](clock)));
      const x = [side("x_low", left, X), side("x_high", right, X)], y = [side("y_high", top, Y), side("y_low", bottom, Y)];
      put(rect, { x: x[0], y: y[0], width: Math.max(x[1] - x[0], 0) || 0, height: Math.max(y[1] - y[0], 0) || 0 });
      put(word, { x: (Math.max(x[0], left) + Math.min(x[1], right)) / 2, y: (Math.max(y[0], top) + Math.min(y[1], bottom)) / 2 });
    }
    for (const { point, dot, word } of this.points) {
      const x = X(now[point.x](clock)), y = Y(now[point.y](clock)), isThere = Number.isFinite(x + y);
      dot.style.display = word.style.display = isThere ? "" : "none";
      if (isThere) { put(dot, { cx: x, cy: y }); put(word, { x: x + 11, y: y - 9 }); }
    }
    if (panel.has_cursor) put(this.cursor, { d: `M${X(clock)} ${top}V${bottom}` });
    const own = traced.filter(({ line }) => line.role === "own");
    return !own.length || own.some(({ own: points }) => points.length);
  }

  /** Take scales that hold what is traced, and draw the frame again where they are others. */
  scale(now, traced) {
    const { panel, root } = this, width = root.clientWidth || 640;
    const fitted = (given, values, ticks) => {
      const ends = given ? given.map((i) => now[i]()) : ticks ? [Math.min(...values()), Math.max(...values())] : limits(values());
      return [ends[0], ends[1], ticks ?? ends[2] ?? tick(ends[1] - ends[0])];
    };
    const all = (at) => traced.flatMap(({ own, twin }) => [...own, ...twin].map((point) => point[at]));
    const x = fitted(panel.x_limits, () => (panel.is_over_variable ? traced.flatMap(({ line }) => line.over.map((i) => now[i]())) : all(0)), panel.x_ticks);
    const y = fitted(panel.y_limits, () => all(1), panel.y_ticks);
    const key = [width, ...x, ...y].join();
    if (this.view.key === key) return;
    const top = 8, below = panel.bare ? 8 : this.hasNumbers ? 44 : 10, edge = panel.bare ? 8 : 74;
    const room = width - edge - 14, shape = (y[1] - y[0]) / (x[1] - x[0]);
    const height = panel.equal ? Math.min(room * shape, TALLEST_PX) : panel.height;
    const across = panel.equal ? Math.min(room, height / shape) : room;
    const left = edge + (room - across) / 2, right = left + across, bottom = top + height;
    this.view = { key, x, y, left, right, top, bottom, X: axis(left, right, x), Y: axis(bottom, top, y) };
    put(root, { height: bottom + below });
    put(this.hole, { x: left - 2, y: top - 2, width: across + 4, height: height + 4 });
    this.grid.replaceChildren(...(panel.bare ? [] : this.frame()), ...panel.words.flatMap(([words, a, b]) =>
      words.split("\n").map((word, i) => text({ x: this.view.X(a), y: this.view.Y(b) + 15 * i }, word))));
  }

  frame() {
    const { panel, view: { x, y, X, Y, left, right, top, bottom } } = this;
    const places = ([low, high, step]) => { const first = Math.ceil(low / step - NEAR), count = Math.floor(high / step + NEAR) - first; return Array.from({ length: count + 1 }, (_, i) => (first + i) * step); };
    const across = places(x), every = Math.ceil((across.length * 34) / (right - left));
    const drawn = [
      ...across.map((value) => svg("path", { d: `M${X(value)} ${top}V${bottom}` })),
      ...places(y).flatMap((value) => [svg("path", { d: `M${left} ${Y(value)}H${right}`, class: value === 0 ? "cm-zero" : "" }),
        text({ x: left - 7, y: Y(value) + 4, "text-anchor": "end" }, plain(value))]),
      ...panel.y_label.split(" in ").map((words, i) => text({ x: -(top + bottom) / 2, y: 14 + 15 * i, transform: "rotate(-90)" }, i ? `in ${words}` : words)),
    ];
    if (!this.hasNumbers) return drawn;
    return [...drawn, ...across.filter((_, i) => i % every === 0).map((value) => text({ x: X(value), y: bottom + 17 }, plain(value))),
      text({ x: (left + right) / 2, y: bottom + 36 }, panel.x_label)];
  }

  pathOf(points) {
    const { X, Y, top, bottom } = this.view;
    let d = "", pen = "M", before = 0;
    for (const [x, y] of points) {
      if (!Number.isFinite(x)) { pen = "M"; continue; }
      const height = Y(y), side = height < top - 1 ? -1 : height > bottom + 1 ? 1 : 0;
      if (side * before < 0) pen = "M"; // from above the picture to below it: a pole
      d += `${pen}${X(x).toFixed(1)} ${Math.min(Math.max(height, -BEYOND_PX), BEYOND_PX).toFixed(1)}`;
      [pen, before] = ["L", side];
    }
    return d;
  }
}

/** The names of the lines, each beside a piece of it. */
function legendOf(columns, pin) {
  const all = columns.flat().flatMap((panel) => panel.lines);
  const lines = new Map([...all, ...(pin ? [{ name: "reference", role: "reference" }] : [])].map((line) => [line.name, line]));
  lines.delete("");
  return html("div", { class: "cm-legend" }, ...[...lines].map(([name, line]) => html("span", {},
    svg("svg", { width: 34, height: 10, "aria-hidden": true }, svg("path", { class: `cm-line cm-${line.role}`, d: "M0 5H34", style: strokeOf(line) })), name)));
}

/** A scale from [low, high] to pixels, and back. */
function axis(from, to, [low, high]) {
  const at = (value) => from + ((value - low) / (high - low)) * (to - from);
  at.back = (pixel) => low + ((pixel - from) / (to - from)) * (high - low);
  return at;
}

/** The figure: controls, sentences, legend and panels, in line with the model's settings. */
class Figure {
  constructor(model) {
    const description = model.get("description"), { controls, clock, columns, shares, pin } = description;
    const id = `cm${++figures}`;
    // `part` is where the clock stands, as a part of its range; `frame` the next one, if it runs
    Object.assign(this, { model, description, clock, make: compile(description), part: 0.25, frame: 0 });
    this.rows = controls.map((control, i) => rowOf(control, `${id}c${i}`, (value) => this.set({ [i]: value })));
    this.panels = columns.map((column) => column.map((panel, i) =>
      new Panel(panel, `${id}p${panel.id}`, i === column.length - 1, pin)));
    this.play = button("Play", () => (this.frame ? this.pause() : this.start()));
    this.slider = html("input", { type: "range", min: 0, max: 1, step: 0.005, "aria-label": clock?.name ?? "" });
    this.slider.addEventListener("input", () => {
      this.pause();
      this.part = this.slider.valueAsNumber;
      this.draw();
    });
    this.said = html("div", {});
    this.spoken = html("div", { class: "cm-hidden", role: "status" });
    this.root = html("div", { class: "cm-figure", role: "group", "aria-label": description.title, "data-lm-suppress-shortcuts": "true" },
      html("div", { class: "cm-controls" }, ...this.rows.map(({ row }) => row), ...this.clockRow(), html("div", {}, ...this.buttons())),
      this.said, this.spoken, legendOf(columns, pin),
      html("div", { class: "cm-columns" }, ...this.panels.map((column, i) =>
        html("div", { class: "cm-column", style: `flex:${shares[i]} 1 17em` }, ...column.map(({ root }) => root)))));
    this.root.addEventListener("keydown", (event) => { // the notebook's own keys are not meant
      if (!(event.ctrlKey || event.metaKey || event.altKey)) event.stopPropagation();
    });
    for (const panel of this.panels.flat()) panel.letDrag((move) => this.drag(move));
  }

  clockRow() {
    const { clock, play, slider } = this;
    if (clock?.control !== null) return [];
    return [html("div", {}, html("span", { class: "cm-label" }, clock.name), play, slider)];
  }

  buttons() {
    const { buttons, controls, pin, clock } = this.description, made = clock && clock.control !== null ? [this.play] : [];
    for (const { text: words, sets } of buttons) made.push(button(words, () => this.setAll(sets, this.place)));
    if (pin) {
      made.push(button(pin, () => {
        this.model.set("pinned", [...this.settings]);
        this.model.save_changes();
      }));
    }
    if (controls.length) made.push(button("Start again", () => this.set({ ...controls.map(({ start }) => start) })));
    return made;
  }

  get settings() { return this.model.get("settings"); }

  get place() {
    const [low, high] = this.description.range.map((i) => this.now[i]());
    return low + this.part * (high - low);
  }

  set(changes, isKept = true) {
    this.model.set("settings", change(this.description, this.make, this.settings, changes));
    if (isKept) this.model.save_changes();
  }

  /** Set controls to what their formulas are at a place, unless one of them is no number. */
  setAll(sets, ...place) {
    const changes = Object.fromEntries(sets.map(([i, f]) => [i, Number(this.now[f](...place).toPrecision(12))]));
    if (Object.values(changes).every(Number.isFinite)) this.set(changes);
  }

  /** Move a panel's point to where the pointer is, or by a hundredth. */
  drag({ point, at, by }) {
    const [x, y] = at ?? [this.now[point.x](this.place) + by[0] / 100, this.now[point.y](this.place) + by[1] / 100];
    this.setAll(point.drags, x, y);
  }

  start() {
    const { control, seconds } = this.clock, began = performance.now() - this.part * seconds * 1000;
    const step = (time) => {
      if (!this.root.isConnected) return this.pause();
      this.part = (Math.max(time - began, 0) / 1000 / seconds) % 1;
      this.frame = requestAnimationFrame(step);
      if (control === null) this.draw();
      else {
        const { low, high } = this.description.controls[control];
        this.set({ [control]: low + this.part * (high - low) }, false);
      }
    };
    write(this.play, "Pause");
    this.frame = requestAnimationFrame(step);
  }

  pause() {
    if (!this.frame) return;
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    write(this.play, "Play");
    this.model.save_changes();
    this.draw();
  }

  draw() {
    const { description, settings, said, model } = this, pinned = model.get("pinned");
    this.now = this.make(settings, pinned);
    const then = this.make(pinned, pinned), { place } = this;
    this.rows.forEach(({ follow }, i) => follow(settings[i]));
    this.slider.value = this.part;
    const isWhole = this.panels.flat().map((panel) => panel.draw(this.now, then, place)).every(Boolean);
    const lines = sentences(description, this.now, settings, place);
    if (!isWhole) lines.push("With these settings a curve has no real value anywhere.");
    while (said.children.length < lines.length) said.append(html("div", {}));
    [...said.children].forEach((line, i) => write(line, lines[i] ?? ""));
    clearTimeout(this.speaking); // read out only when the hand rests
    if (!this.frame) this.speaking = setTimeout(() => write(this.spoken, lines.join("\n")), PAUSE_MS);
  }
}

function render({ model, el }) {
  const figure = new Figure(model), draw = () => figure.draw(), events = ["change:settings", "change:pinned"];
  el.append(figure.root);
  for (const event of events) model.on(event, draw);
  const resized = new ResizeObserver(draw);
  resized.observe(figure.root); // draws it for the first time too
  return () => {
    figure.pause();
    resized.disconnect();
    clearTimeout(figure.speaking);
    for (const event of events) model.off(event, draw);
  };
}
export default { render };
