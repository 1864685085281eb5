// What a walk through a notebook does in its page, in any front end and browser. Each function
// takes and gives JSON; what has to be a real key is pressed by who drives the browser.

const PATIENCE_MS = window.patienceMs ?? 30000, // a machine may be busy with much else
  FRAME_MS = 30,
  KINDS = {
    slider: "input[type=range], [role=slider]",
    field: "input[type=text], input[type=number]",
    choice: "select",
    pad: "[role=application]",
    option: ".widget-toggle-buttons > :nth-child(1 of .widget-toggle-button:not(.mod-active))",
    clock: "button",
  },
  OURS = ".cm-figure, .cm-player",
  ERRORS = [
    "[data-mime-type='application/vnd.jupyter.error']",
    "[data-mime-type='application/vnd.jupyter.stderr']",
  ].join();

const isNotebook7 = () => jupyterapp.name === "Jupyter Notebook";
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const notebook = () =>
  [...(window.jupyterapp?.shell.widgets("main") ?? [])].find(
    ({ context, isVisible }) => context?.sessionContext && isVisible,
  );
const all = (selector, within = notebook().node) => [...within.querySelectorAll(selector)];
const outputs = () => all(".jp-OutputArea-output").filter((each) => each.checkVisibility());
const marked = (number) => notebook().node.querySelector(`[data-walk="${number}"]`);
const clipped = (element) => element.outerHTML.slice(0, 120);

async function until(isSo) {
  const end = Date.now() + PATIENCE_MS;
  while (!(await isSo())) {
    if (Date.now() > end) return false;
    await pause(FRAME_MS);
  }
  return true;
}

/**
 * What a look finds once all is laid out. Cells come into the page one after the other, in Firefox
 * for some seconds, and of what is out of sight it tells nothing.
 */
async function laidOut(look) {
  await until(() => all(".jp-Cell").length >= notebook().content.widgets.length);
  const style = document.head.appendChild(document.createElement("style"));
  style.textContent = ".jp-Cell { content-visibility: visible !important; contain: none !important }";
  await pause(10 * FRAME_MS); // figures fit themselves into their widths
  const found = look();
  style.remove();
  return found;
}

/** What a screen reader calls an element. */
function nameOf(element) {
  const by = element.getAttribute("aria-labelledby"),
    label = element.labels?.[0] ?? document.getElementById(by);
  const name = element.getAttribute("aria-label") ?? label?.textContent;
  return (name ?? element.getAttribute("alt") ?? element.textContent).trim().slice(0, 50);
}

/**
 * Whatever an element's figure shows; what is in no figure shows in all outputs. Of those out of
 * sight a browser lays out nothing, so that they have no innerText.
 */
function scene(element) {
  const figure = element.closest(OURS);
  if (!figure) {
    const others = all("input, [role=slider]").filter((each) => each !== element);
    const values = others.map((each) => each.ariaValueNow ?? each.value);
    return [...outputs().map((each) => each.textContent), ...values].join();
  }
  const words = all(".cm-said, .cm-angle", figure).map((each) => each.textContent);
  const settings = all("select", figure).map((each) => each.value);
  const drawings = all("svg", figure).map((each) => each.innerHTML);
  const times = figure.matches(".cm-player") ? [figure.querySelector("svg").getCurrentTime()] : [];
  return [words, settings, drawings, times].join();
}

const walk = {
  /** Open a notebook in the page that is there already, from the disk. */
  async openHere(path) {
    notebook().context.model.dirty = false; // or it asks whether to save
    notebook().close();
    await until(() => !notebook());
    await jupyterapp.commands.execute("docmanager:open", { path, factory: "Notebook" });
  },

  /** Wait until this notebook is in front and its kernel has answered. */
  async isReady(path) {
    const isOpen = () => notebook()?.context?.path.endsWith(path);
    while (!isOpen()) await pause(FRAME_MS);
    const { ready, sessionContext } = notebook().context;
    await ready;
    await sessionContext.ready;
    while (!sessionContext.session?.kernel) await pause(FRAME_MS); // null at first
    await sessionContext.session.kernel.info;
  },

  async command(name) {
    await jupyterapp.commands.execute(name);
  },

  /** Number everything that can be moved, and say what it is. */
  async controls() {
    const inside = (output) =>
      Object.entries(KINDS).flatMap(([kind, selector]) =>
        all(selector, output)
          .filter((each) => each.checkVisibility())
          .filter((each) => kind !== "clock" || /^(Play|Pause)$/.test(each.textContent))
          // Notebook 7 takes the arrow keys from ipywidgets' slider; docs/browsers.md says so
          .filter((each) => !(isNotebook7() && each.matches(".noUi-handle")))
          .map((element) => ({ kind, element })),
      );
    const found = await laidOut(() => outputs().flatMap(inside));
    const seen = new Set([null]);
    return found.map(({ kind, element }, number) => {
      const figure = element.closest(OURS),
        isFirst = !seen.has(figure);
      seen.add(figure);
      element.dataset.walk = number;
      return { number, kind, name: nameOf(element), isFirst };
    });
  },

  /** Give an element the focus, and keep what its figure shows; false if it takes none. */
  async focus(number) {
    const element = marked(number);
    element.scrollIntoView({ block: "center" });
    await pause(FRAME_MS); // out of sight nothing is laid out, and no text can be selected
    element.focus();
    element.select?.();
    window.walked = scene(element);
    return document.activeElement === element;
  },

  /** Whether an element's figure shows something else than when it got the focus. */
  hasMoved: (number) => until(() => scene(marked(number)) !== window.walked),

  /** Whether a figure stands still. */
  async stands(number) {
    const before = scene(marked(number));
    await pause(5 * FRAME_MS);
    return scene(marked(number)) === before;
  },

  /** The word on a button, once it is this one. */
  says: ([number, word]) => until(() => marked(number).textContent === word),

  word: (number) => marked(number).textContent,

  /** Whether a control cannot go further up. */
  isAtEnd(number) {
    const element = marked(number);
    if (element.options) return element.selectedIndex === element.options.length - 1;
    const now = element.ariaValueNow ?? element.value,
      most = element.ariaValueMax ?? element.max;
    return Number(now) >= Number(most);
  },

  /** Another number that fits into a field. */
  another(number) {
    const field = marked(number),
      row = field.closest("div, .jp-OutputArea-output"),
      slider = row.querySelector("input[type=range]") ?? field;
    const [low, high] = [Number(slider.min), Number(slider.max)];
    const wanted = [0.4, 0.6].map((part) => low + part * (high - low));
    const isThere = (value) => Math.abs(value - parseFloat(field.value)) <= 1e-9; // not if empty
    const first = wanted.find((value) => !isThere(value));
    if (slider.min === "") return field.value === "1" ? "2" : "1"; // a prediction may be kept
    return String(Number(first.toPrecision(3)));
  },

  /** How many elements of a figure take the focus; 0 for what is in no figure of ours. */
  stops: (number) => all("input, select, button, [tabindex]", marked(number).closest(OURS)).length,

  /** Whether the focus is in an element's figure. */
  isInside: (number) => marked(number).closest(OURS).contains(document.activeElement),

  /** What a learner sees of errors. */
  async troubles() {
    const isBroken = (each) => /^(Error displaying|Loading) widget/.test(each.textContent.trim());
    await until(() => !outputs().some((each) => /^Loading widget/.test(each.textContent.trim())));
    const wrong = outputs().filter((each) => each.matches(ERRORS) || isBroken(each));
    return wrong.map((each) => each.textContent.trim().slice(-300));
  },

  /** What has no name for a screen reader. */
  nameless() {
    const drawn = "img, svg[role=img], input, select, button, [role=slider], [role=application]";
    const inside = (output) =>
      all(drawn, output)
        .filter((each) => each.checkVisibility())
        .filter((each) => /^(Image)?$/.test(nameOf(each))) // JupyterLab says so of any picture
        .map(clipped);
    return laidOut(() => outputs().flatMap(inside));
  },

  /** What is wider than its frame and cannot be scrolled to; of figures, whatever is wider. */
  cut() {
    const scrolls = (each) => /auto|scroll/.test(getComputedStyle(each).overflowX);
    const isReached = (element, frame) => {
      for (let each = element; each !== frame.parentElement; each = each.parentElement)
        if (scrolls(each)) return !element.closest(OURS);
      return false;
    };
    const cutFrom = (frame) => {
      const right = Math.min(frame.getBoundingClientRect().right, innerWidth) + 1;
      return all(":not(svg *), svg text", frame)
        .filter((each) => !each.closest("[clip-path], .cm-hidden"))
        .filter((each) => each.getBoundingClientRect().right > right && !isReached(each, frame))
        .slice(0, 3)
        .map(clipped);
    };
    return laidOut(() => outputs().flatMap(cutFrom));
  },

  /** Go into the last cell that may be written in, with a cursor. */
  async edit() {
    const { content } = notebook(),
      isOpen = ({ model }) => model.type === "code" && model.getMetadata("editable") !== false;
    content.activeCellIndex = content.widgets.map(isOpen).lastIndexOf(true);
    await jupyterapp.commands.execute("notebook:enter-edit-mode");
    return until(() => document.activeElement.closest(".cm-content"));
  },

  /** End the notebook's kernel: nobody comes back to it. */
  async end() {
    await notebook().context.sessionContext.shutdown();
  },

  sources: () => notebook().content.widgets.map(({ model }) => model.sharedModel.getSource()),

  /** How many figures there are, living ones and players. */
  figures: () => all(OURS).length,

  living: () => all(".cm-figure").length,

  areThere: (count) => until(() => all(OURS).length === count),

  /** Leave the page to the notebook where it is narrow, as one does on a telephone. */
  async clear() {
    const isNarrow = innerWidth < 760,
      { shell, commands } = jupyterapp;
    if (isNarrow && shell.leftCollapsed === false)
      await commands.execute("application:toggle-left-area");
    await pause(10 * FRAME_MS);
  },
};
