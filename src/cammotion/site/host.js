// What a page does: gives the modules of its figures their models, and answers what is filled in.
// `load` returns a module by its name. It is the last of three files, which are one module.

const WIDE = "(min-width: 84rem)"; // as in the style: the list of sections has a margin there
// Soon, also where drawings that move leave no idle moment; Safari has no such callback.
const idle = globalThis.requestIdleCallback
  ? (then) => requestIdleCallback(then, { timeout: 200 })
  : (then) => setTimeout(then, 50);
const HEAD = /^(Right\.|Not yet\.)(.*)$/s;

export function start(load) {
  const sections = document.querySelector(".sections details");
  if (sections) sections.open = matchMedia(WIDE).matches;
  document.querySelectorAll(".moving").forEach(letStop);
  document.querySelectorAll("pre, .formula, .together, .table, figure").forEach(letScroll);
  fillIn(load);
  liveAll([...document.querySelectorAll("[data-module]")], load);
}

/** Let the figures live, one after the other, when the page has nothing else to do. */
async function liveAll(places, load) {
  for (const place of places) {
    await new Promise((then) => idle(then));
    await bring(place, load);
  }
}

/** Let a module draw in its place, with what is stored beside it. */
async function bring(place, load) {
  const { default: module } = await load(place.dataset.module);
  const state = JSON.parse(place.parentElement.querySelector("script").textContent);
  const drawn = place.querySelector(":scope > svg");
  if (drawn) state.svg = new XMLSerializer().serializeToString(drawn);
  const el = document.createElement("div");
  place.replaceChildren(el);
  module.render({ model: modelOf(state), el });
  place.dataset.lives = "";
}

/** A drawing that moves by itself, and a button that lets it stand or move. */
function letStop(moving) {
  const [image, button] = ["img", "button"].map((name) => moving.querySelector(name)),
    source = moving.querySelector("source"),
    { still } = moving.dataset,
    moves = image.getAttribute("src");
  let isStill = matchMedia(source.media).matches;
  const show = () => {
    source.remove();
    image.src = isStill ? still : moves;
    label();
  };
  const label = () => (button.textContent = isStill ? "Let it move" : "Stop the motion");
  button.addEventListener("click", () => {
    isStill = !isStill;
    show();
  });
  label();
  button.hidden = false;
}

/** What is wider than its place can be reached and scrolled by keyboard. */
function letScroll(wide) {
  const sees = () => {
    if (wide.scrollWidth > wide.clientWidth + 1) wide.tabIndex = 0;
    else wide.removeAttribute("tabindex");
  };
  new ResizeObserver(sees).observe(wide);
}

/** Answer exercises and predictions by what is packed in the page. */
async function fillIn(load) {
  const packed = document.getElementById("answers");
  if (!packed) return;
  const [answers, tools] = await Promise.all([
    unpack(JSON.parse(packed.textContent)),
    load("figure"),
  ]);
  for (const form of document.querySelectorAll("[data-exercise]"))
    answerIn(form, answers[form.dataset.exercise], tools);
  for (const form of document.querySelectorAll("[data-predicts]"))
    predictIn(form, answers[form.dataset.predicts], tools);
  document.querySelectorAll("form input").forEach(catchUp);
  document.documentElement.dataset.ready = "";
}

/** Answer what was filled in before anything could answer, unless it is still being typed. */
function catchUp(input) {
  if (input.checked) input.dispatchEvent(new Event("change", { bubbles: true }));
  else if (input.type === "text" && input.value && input !== document.activeElement)
    input.form.requestSubmit();
}

async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(unpacked).json();
}

function answerIn(form, table, tools) {
  const said = form.querySelector(".said");
  const say = (text) => {
    const [, head, rest] = text.match(HEAD) ?? [, "", text],
      strong = document.createElement("strong");
    strong.textContent = head;
    said.replaceChildren(...(head ? [strong, rest] : text ? [text] : []));
    form.dataset.state = text.startsWith("Right.") ? "right" : text ? "wrong" : "";
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (table?.edges) say(answerTo(table, form.querySelector("input").value, tools));
  });
  if (table?.letters)
    form.addEventListener("change", ({ target }) => say(table.letters[target.value]));
}

function predictIn(form, made, tools) {
  const key = CSS.escape(form.dataset.predicts);
  const reveals = document.querySelectorAll(`[data-reveals="${key}"]`);
  const tell = (event) => {
    event.preventDefault();
    const typed = form.querySelector("input").value.trim();
    if (!typed) return;
    const asks = made ? unclear(made, typed, tools) : "",
      far = made ? howFar(made, typed, tools) : "";
    form.querySelector(".said").textContent = asks || "The answer opens further down.";
    if (asks) return;
    for (const reveal of reveals) {
      reveal.querySelector(".said").textContent =
        `You predicted ${typed}${far && `: ${far}`}.`;
      reveal.querySelector("summary").textContent = "The answer";
      reveal.querySelector("details").open = true;
    }
  };
  form.addEventListener("submit", tell);
  form.addEventListener("change", tell);
}
