// A live figure where its reader is: in a notebook the model is the widget's, in a page the
// page's own. It is the last of four files, which are one module.

const PAUSE_MS = 600,
  OF_STEP = 0.1; // so finely a point is dragged

/** The figure: controls, sentences, legend and panels, in line with the model's settings. */
class Figure {
  constructor(model) {
    const description = model.get("description"),
      { controls, clock, columns, shares, pin } = description;
    const id = `cm${Math.random().toString(36).slice(2)}`; // a notebook loads a module per figure
    // `part` is where the clock stands, as a part of its range; `frame` the next one, if it runs
    Object.assign(this, {
      model,
      description,
      clock,
      make: compile(description),
      part: 0,
      frame: 0,
    });
    this.rows = controls.map((control, i) =>
      rowOf(control, `${id}c${i}`, (value) => this.set({ [i]: value })),
    );
    this.panels = columns.map((column, place) =>
      column.map(
        (panel, i) => new Panel(panel, `${id}p${place}x${i}`, i === column.length - 1, pin),
      ),
    );
    const starts = controls.map(({ start }) => start);
    const first = this.make(starts, starts);
    for (const panel of this.panels.flat()) panel.keep(first, first[description.range[0]]());
    this.play = button("Play", () => (this.frame ? this.pause() : this.start()));
    this.slider = html("input", {
      type: "range",
      min: 0,
      max: 1,
      step: 0.005,
      "aria-label": clock?.name ?? "",
    });
    this.slider.addEventListener("input", () => {
      this.pause();
      this.part = this.slider.valueAsNumber;
      this.draw();
    });
    this.said = html("div", { class: "cm-said" });
    this.spoken = html("div", { class: "cm-hidden", role: "status" });
    this.root = html(
      "div",
      {
        class: "cm-figure",
        role: "group",
        "aria-label": description.title,
      },
      html(
        "div",
        { class: "cm-settings" },
        ...this.rows.map(({ row }) => row),
        ...this.clockRow(),
        html("div", {}, ...this.buttons()),
      ),
      this.said,
      this.spoken,
      legendOf(columns, pin),
      html(
        "div",
        { class: "cm-columns" },
        ...this.panels.map((column, i) =>
          html(
            "div",
            { class: "cm-column", style: `flex:${Number(shares[i])} 1 17em` },
            ...column.map(({ root }) => root),
          ),
        ),
      ),
    );
    for (const panel of this.panels.flat()) panel.letDrag((move) => this.drag(move));
    this.forgetSwipes();
    // Notebook 7 takes the arrow keys of whatever is focused and does not say so itself
    for (const focusable of this.root.querySelectorAll("input, select, button, [tabindex]")) {
      put(focusable, { "data-lm-suppress-shortcuts": true });
    }
    this.root.addEventListener("keydown", (event) => {
      // the notebook's own keys are not meant
      if (!(event.ctrlKey || event.metaKey || event.altKey)) event.stopPropagation();
    });
  }

  clockRow() {
    const { clock, play, slider } = this;
    if (clock?.control !== null) return [];
    return [html("div", {}, html("span", { class: "cm-label" }, clock.name), play, slider)];
  }

  buttons() {
    const { buttons, controls, pin, clock } = this.description,
      made = clock && clock.control !== null ? [this.play] : [];
    for (const { text: words, sets } of buttons)
      made.push(button(words, () => this.setAll(sets, [this.place])));
    if (pin) {
      made.push(
        button(pin, () => {
          this.model.set("pinned", [...this.settings]);
          this.model.save_changes();
        }),
      );
    }
    if (controls.length) made.push(button("Start again", () => this.startAgain()));
    return made;
  }

  startAgain() {
    this.pause();
    this.part = 0;
    this.set({ ...this.description.controls.map(({ start }) => start) });
  }

  get settings() {
    return this.model.get("settings");
  }

  get place() {
    const [low, high] = this.description.range.map((i) => this.now[i]());
    return low + this.part * (high - low);
  }

  set(changes, isKept = true) {
    for (const i in changes) this.rows[i].settle(); // what was refused there is over
    this.model.set("settings", change(this.description, this.make, this.settings, changes));
    if (isKept) this.model.save_changes();
  }

  /** Set controls to what their formulas are at a place, unless one of them is no number; to that
   * part of a step. */
  setAll(sets, place, by = 0) {
    const near = (i, value) => {
      const step = by * this.description.controls[i].step;
      return Number((step ? Math.round(value / step) * step : value).toPrecision(12));
    };
    const changes = Object.fromEntries(sets.map(([i, f]) => [i, near(i, this.now[f](...place))]));
    if (Object.values(changes).every(Number.isFinite)) this.set(changes);
  }

  /** Move a panel's point to where the pointer is, or by a step. */
  drag({ point, at, by }) {
    const [x, y] = at ?? [
      this.now[point.x](this.place) + by[0],
      this.now[point.y](this.place) + by[1],
    ];
    this.setAll(point.drags, [x, y], at ? OF_STEP : 0);
  }

  /** A swipe that begins on a slider and scrolls the page leaves everything as it was. */
  forgetSwipes() {
    let before;
    this.root.addEventListener("pointerdown", () => (before = [this.settings, this.part]));
    this.root.addEventListener("pointercancel", ({ target }) => {
      if (target.type !== "range") return;
      this.part = before[1];
      this.set({ ...before[0] });
    });
  }

  start() {
    const { control, seconds } = this.clock,
      began = performance.now() - this.part * seconds * 1000;
    const step = (time) => {
      if (!this.root.isConnected) return this.pause();
      this.part = (Math.max(time - began, 0) / 1000 / seconds) % 1;
      this.frame = requestAnimationFrame(step);
      if (control === null) this.draw();
      else {
        const { low, high, step: by } = this.description.controls[control];
        const value = low + Math.round((this.part * (high - low)) / by) * by;
        this.set({ [control]: Number(value.toPrecision(12)) }, false);
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
    const { description, settings, said, model } = this,
      pinned = model.get("pinned");
    this.now = this.make(settings, pinned);
    const then = this.make(pinned, pinned),
      { place } = this;
    this.rows.forEach(({ follow }, i) => follow(settings[i]));
    this.slider.value = this.part;
    const isWhole = this.panels
      .flat()
      .map((panel) => panel.draw(this.now, then, place))
      .every(Boolean);
    const lines = sentences(description, this.now, settings, place);
    if (!isWhole) lines.push("With these settings a curve has no real value anywhere.");
    while (said.children.length < lines.length) said.append(html("div", {}));
    [...said.children].forEach((line, i) => write(line, lines[i] ?? ""));
    clearTimeout(this.speaking); // read out only when the hand rests
    if (!this.frame)
      this.speaking = setTimeout(() => write(this.spoken, lines.join("\n")), PAUSE_MS);
  }
}

function render({ model, el }) {
  const figure = new Figure(model),
    draw = () => figure.draw(),
    events = ["change:settings", "change:pinned"];
  el.append(figure.root);
  draw(); // who listens or presses a key may do so before it comes in sight
  for (const event of events) model.on(event, draw);
  const resized = new ResizeObserver(draw);
  resized.observe(figure.root); // draws it as wide as it is then
  return () => {
    figure.pause();
    resized.disconnect();
    clearTimeout(figure.speaking);
    for (const event of events) model.off(event, draw);
  };
}
export default { render };
