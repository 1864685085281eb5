// A panel of a live figure: curves, points and boxes on axes, drawn in the page's own pixels, so
// that its text is as large on a phone.

const BEYOND_PX = 9999,
  TALLEST_PX = 440,
  HOLD_PX = 24, // so near a finger takes hold of a point
  KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** A scale from [low, high] to pixels, and back. */
function axis(from, to, [low, high]) {
  const at = (value) => from + ((value - low) / (high - low)) * (to - from);
  at.back = (pixel) => low + ((pixel - from) / (to - from)) * (high - low);
  return at;
}

/** The round numbers of an axis. */
function steps([low, high, step]) {
  const first = Math.ceil(low / step - NEAR),
    count = Math.floor(high / step + NEAR) - first;
  return Array.from({ length: count + 1 }, (_, i) => (first + i) * step);
}

/** A panel: what it is made of, still without a place; `draw` gives it one. */
class Panel {
  constructor(panel, id, isLast, pin) {
    Object.assign(this, { panel, hasNumbers: isLast || !panel.shares_x, view: {} });
    this.grid = svg("g", { class: "cm-grid" });
    this.hole = svg("rect", {});
    this.cursor = svg("path", { class: "cm-cursor" });
    this.boxes = panel.boxes.map((box) => ({
      box,
      rect: svg("rect", { class: "cm-box" }),
      word: text({ class: "cm-alarm" }, box.name),
    }));
    this.lines = panel.lines.map((line) => ({
      line,
      twin: pin && line.role === "own" ? svg("path", { class: "cm-line cm-reference" }) : null,
      path: svg("path", { class: `cm-line cm-${line.role}`, style: strokeOf(line) }),
    }));
    this.points = panel.points.map((point) => ({
      point,
      dot: svg("circle", {
        class: "cm-point",
        r: point.drags ? 9 : 5,
        style: `fill:${paint(point.colour)}`,
      }),
      word: svg("text", {}, point.name),
    }));
    this.dots = panel.has_cursor
      ? this.lines
          .filter(({ line }) => line.role === "own")
          .map(({ line }) => ({
            line,
            dot: svg("circle", { class: "cm-point", r: 4, style: `fill:${paint(line.colour)}` }),
          }))
      : [];
    const inside = svg(
      "g",
      { "clip-path": `url(#${id}k)` },
      ...this.boxes.map(({ rect }) => rect),
      this.cursor,
      ...this.lines.flatMap(({ twin, path }) => (twin ? [twin, path] : [path])),
      ...this.dots.map(({ dot }) => dot),
    );
    this.root = svg(
      "svg",
      { role: "img", "aria-labelledby": `${id}t` },
      svg("title", { id: `${id}t` }, panel.title),
      svg("clipPath", { id: `${id}k` }, this.hole),
      this.grid,
      inside,
      ...this.boxes.map(({ word }) => word),
      ...this.points.flatMap(({ dot, word }) => [dot, word]),
    );
  }

  /** Let the reader move a point that drags controls, by pointer and by arrow key. */
  letDrag(move) {
    const { root } = this,
      pads = this.points.filter(({ point }) => point.drags);
    if (!pads.length) return;
    let held; // the pad that is nearest to where the pointer has been pressed
    const place = ({ clientX, clientY }) => {
      const box = root.getBoundingClientRect();
      return [clientX - box.left, clientY - box.top];
    };
    const follow = (event) => {
      const [x, y] = place(event),
        { X, Y } = this.view;
      move({ point: held.point, at: [X.back(x), Y.back(y)] });
    };
    put(root, { class: "cm-pad", role: "group" });
    root.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      const [x, y] = place(event),
        away = ({ dot }) => Math.hypot(dot.getAttribute("cx") - x, dot.getAttribute("cy") - y);
      held = pads.reduce((best, pad) => (away(pad) < away(best) ? pad : best));
      if (event.pointerType === "touch" && away(held) > HOLD_PX) return; // who scrolls the page
      event.preventDefault();
      root.setPointerCapture(event.pointerId);
      held.dot.focus();
      follow(event);
    });
    root.addEventListener("pointermove", (event) => {
      if (root.hasPointerCapture(event.pointerId)) follow(event);
    });
    for (const pad of pads) {
      const { point, dot } = pad,
        hold = (pad.hold = svg("circle", { class: "cm-hold", r: HOLD_PX }));
      dot.before(hold);
      for (const each of [hold, dot])
        each.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
      put(dot, { tabindex: 0, role: "application", "aria-label": point.label });
      dot.addEventListener("keydown", (event) => {
        if (!(event.key in KEYS)) return;
        event.preventDefault();
        const { x, y } = this.view,
          [across, up] = KEYS[event.key];
        move({ point, by: [across * nudge(x), up * nudge(y)] });
      });
    }
  }

  /** Draw it with these formulas, and these of the pinned settings; true if a curve is there. */
  draw(now, then, clock) {
    const { panel } = this;
    const traced = this.lines.map(({ line, twin }) => ({
      line,
      own: trace(line, now, clock),
      twin: twin ? trace(line, then, clock) : [],
    }));
    this.scale(now, traced);
    const { X, Y, top, bottom, left, right } = this.view;
    this.lines.forEach(({ path, twin }, i) => {
      put(path, { d: this.pathOf(traced[i].own, traced[i].line.role === "area") });
      if (twin) put(twin, { d: this.pathOf(traced[i].twin) });
    });
    const within = (low, high, ends) => ends.map((at) => Math.min(Math.max(at, low), high));
    for (const { box, rect, word } of this.boxes) {
      const side = (name, edge, axis) => (box[name] === null ? edge : axis(now[box[name]](clock)));
      const x = within(left, right, [side("x_low", left, X), side("x_high", right, X)]),
        y = within(top, bottom, [side("y_high", top, Y), side("y_low", bottom, Y)]);
      put(rect, {
        x: x[0],
        y: y[0],
        width: Math.max(x[1] - x[0], 0) || 0,
        height: Math.max(y[1] - y[0], 0) || 0,
      });
      put(word, { x: (x[0] + x[1]) / 2, y: (y[0] + y[1]) / 2 });
      word.style.display = x[0] < x[1] && y[0] < y[1] ? "" : "none"; // there is nothing to name
    }
    for (const { point, dot, word, hold } of this.points) {
      const x = X(now[point.x](clock, clock)),
        y = Y(now[point.y](clock, clock)),
        isThere = Number.isFinite(x + y);
      dot.style.display = word.style.display = isThere ? "" : "none";
      if (isThere) {
        for (const each of hold ? [hold, dot] : [dot]) put(each, { cx: x, cy: y });
        put(word, { x: x + 11, y: y - 9 });
      }
    }
    if (panel.has_cursor) put(this.cursor, { d: `M${X(clock)} ${top}V${bottom}` });
    for (const { line, dot } of this.dots) {
      const y = Y(now[line.y](clock));
      dot.style.display = Number.isFinite(y) ? "" : "none";
      if (Number.isFinite(y)) put(dot, { cx: X(clock), cy: y });
    }
    const own = traced.filter(({ line }) => line.role === "own");
    return !own.length || own.some(({ own: points }) => points.length);
  }

  /** What an axis has to hold: the curves as they are now, and as they were at the start. */
  held(at, traced, now) {
    const values =
      at === 0 && this.panel.is_over_variable
        ? this.ends(traced, now)
        : traced.flatMap(({ own, twin }) => [...own, ...twin].map((point) => point[at]));
    return [...(this.kept?.[at] ?? []), ...values];
  }

  /** Where the variable begins and ends for each line. */
  ends(traced, now) {
    return traced.flatMap(({ line }) => line.over.map((i) => now[i]()));
  }

  /** Keep what the axes hold at the start, so that a curve that shrinks is seen to do so. */
  keep(first, clock) {
    const traced = this.lines.map(({ line }) => ({ line, own: trace(line, first, clock), twin: [] }));
    this.kept = [0, 1].map((at) => limits(this.held(at, traced, first)).slice(0, 2));
    const ends = this.ends(traced, first).filter(Number.isFinite);
    this.first = [Math.min(...ends), Math.max(...ends)];
  }

  /** Take scales that hold what is traced, and draw the frame again where they are others. */
  scale(now, traced) {
    const { panel, root } = this,
      width = root.clientWidth || 640;
    const fitted = (given, values, ticks) => {
      const ends = given ? given.map((i) => now[i]()) : limits(values());
      return [ends[0], ends[1], ticks ?? ends[2] ?? tick(ends[1] - ends[0])];
    };
    const x = fitted(panel.x_limits, () => this.held(0, traced, now), panel.x_ticks);
    const isAsAtFirst =
      panel.is_over_variable && !panel.x_limits && this.first[0] !== this.first[1];
    const ends = isAsAtFirst ? this.ends(traced, now) : [];
    if (ends.length && Math.min(...ends) >= this.first[0] && Math.max(...ends) <= this.first[1])
      [x[0], x[1]] = this.first; // a turn ends at 360, not at 400
    const y = fitted(panel.y_limits, () => this.held(1, traced, now), panel.y_ticks);
    const key = [width, ...x, ...y].join();
    if (this.view.key === key) return;
    if (panel.equal) this.kept = [x.slice(0, 2), y.slice(0, 2)]; // a mechanism that turns hops not
    const top = 8,
      edge = panel.bare ? 8 : 74,
      room = Math.max(width - edge - 14, 1), // a page that is being laid out may have none
      powers = [powerOf(steps(x), panel.x_label), powerOf(steps(y), panel.y_label)],
      label = this.hasNumbers ? wrapped(withPower(panel.x_label, powers[0]), room + 28) : [],
      below = panel.bare ? 8 : label.length ? 29 + 15 * label.length : 10,
      shape = (y[1] - y[0]) / (x[1] - x[0]);
    const height = panel.equal ? Math.min(room * shape, TALLEST_PX) : panel.height;
    const across = panel.equal ? Math.min(room, height / shape) : room;
    const left = edge + (room - across) / 2,
      right = left + across,
      bottom = top + height;
    this.view = {
      key,
      x,
      y,
      left,
      right,
      top,
      bottom,
      X: axis(left, right, x),
      Y: axis(bottom, top, y),
      label,
      units: powers.map((power) => 10 ** power),
      yLabel: withPower(panel.y_label, powers[1]),
    };
    // on paper, where nothing is drawn anew, it is scaled and not cut
    put(root, { height: bottom + below, viewBox: `0 0 ${width} ${bottom + below}` });
    put(this.hole, { x: left - 2, y: top - 2, width: across + 4, height: height + 4 });
    this.grid.replaceChildren(
      ...(panel.bare ? [] : this.frame()),
      ...panel.words.flatMap(([words, a, b]) =>
        words.split("\n").map((word, i, all) => {
          const half = (word.length * LETTER_PX) / 2, // it stays in the picture
            x = Math.max(Math.min(this.view.X(a), width - half), half);
          return text({ x, y: this.view.Y(b) + 15 * (i - (all.length - 1) / 2) + 4 }, word);
        }),
      ),
    );
  }

  frame() {
    const {
      view: { x, y, X, Y, left, right, top, bottom, label, units, yLabel },
    } = this;
    const across = steps(x),
      every = Math.ceil((across.length * 34) / (right - left));
    const drawn = [
      ...across.map((value) => svg("path", { d: `M${X(value)} ${top}V${bottom}` })),
      ...steps(y).flatMap((value) => [
        svg("path", { d: `M${left} ${Y(value)}H${right}`, class: value === 0 ? "cm-zero" : "" }),
        text({ x: left - 7, y: Y(value) + 4, "text-anchor": "end" }, plain(value / units[1])),
      ]),
      ...yLabel
        .split(/ (?=in (?!.* in ))/)
        .map((words, i) =>
          text({ x: -(top + bottom) / 2, y: 14 + 15 * i, transform: "rotate(-90)" }, words),
        ),
    ];
    if (!this.hasNumbers) return drawn;
    return [
      ...drawn,
      ...across
        .filter((_, i) => i % every === 0)
        .map((value) => text({ x: X(value), y: bottom + 17 }, plain(value / units[0]))),
      ...label.map((words, i) => text({ x: (left + right) / 2, y: bottom + 36 + 15 * i }, words)),
    ];
  }

  /** The path of a curve; where it bounds an area, down to zero at both ends. */
  pathOf(curve, isArea = false) {
    const { X, Y, top, bottom } = this.view;
    let d = "",
      pen = "M",
      before = 0;
    const foot = (end) => curve.slice(...end).map(([x]) => [x, 0]);
    for (const [x, y] of isArea ? [...foot([0, 1]), ...curve, ...foot([-1])] : curve) {
      if (!Number.isFinite(x)) {
        pen = "M";
        continue;
      }
      const height = Y(y),
        side = height < top - 1 ? -1 : height > bottom + 1 ? 1 : 0;
      if (side * before < 0) pen = "M"; // from above the picture to below it: a pole
      d += `${pen}${X(x).toFixed(1)} ${Math.min(Math.max(height, -BEYOND_PX), BEYOND_PX).toFixed(1)}`;
      [pen, before] = ["L", side];
    }
    return d;
  }
}
