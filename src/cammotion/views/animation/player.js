// Plays the SVG of an Animation: sets the clock that its SMIL elements run by. It draws nothing.
const TURN_DEG = 360;
const BEFORE_END_S = 0.001; // at its very end a turn begins anew

const CONTROLS = `
  <button type="button"></button>
  <input type="range" min="0" max="${TURN_DEG}" step="1" aria-label="cam angle in deg">
  <span class="cm-angle" role="status"></span>
  <label>speed <select></select></label>`;

// Only an element of one's own hears from the browser that it came into a page, or was moved in it.
// Every copy of this module in a page defines it, and the first one does it for all.
if (!customElements.get("cm-controls")) {
  class Controls extends HTMLElement {
    connectedCallback() {
      this.whenConnected?.();
    }
  }
  customElements.define("cm-controls", Controls);
}

function speedName(speed, cycle) {
  const turn = `${Number((cycle / speed).toPrecision(2))} s a turn`;
  if (speed === 1) return `real time (${turn})`;
  return `${speed < 1 ? `1/${Math.round(1 / speed)}` : `${speed} times`} (${turn})`;
}

// Where the same drawing stands in a page twice, the one that is hidden must not clip the other.
function makeOwnIds(svg) {
  const own = `-${Math.random().toString(36).slice(2)}`;
  for (const clip of svg.querySelectorAll("clipPath")) clip.id += own;
  for (const clipped of svg.querySelectorAll("[clip-path]")) {
    const url = clipped.getAttribute("clip-path");
    clipped.setAttribute("clip-path", url.replace(")", `${own})`));
  }
}

function render({ model, el }) {
  const cycle = model.get("cycle_s");
  const parsed = new DOMParser().parseFromString(model.get("svg"), "image/svg+xml");
  const svg = document.importNode(parsed.documentElement, true); // Firefox starts a copy's clock
  const controls = document.createElement("cm-controls");
  controls.className = "cm-controls";
  controls.addEventListener("keydown", (event) => {
    const isCommand = event.ctrlKey || event.metaKey || event.altKey;
    if (!isCommand) event.stopPropagation(); // the arrow keys are the slider's, not the notebook's
  });
  controls.innerHTML = CONTROLS;
  const [button, slider, status] = controls.children;
  const select = controls.querySelector("select");
  for (const speed of model.get("speeds")) {
    select.add(new Option(speedName(speed, cycle), speed));
  }
  select.value = model.get("speed");
  // Notebook 7 takes the arrow keys before they get here, of all that does not say so itself
  for (const control of [button, slider, select]) control.dataset.lmSuppressShortcuts = true;
  makeOwnIds(svg);
  svg.classList.remove("cm-still"); // the controls decide what moves here
  el.classList.add("cm-player", "cm-paper");

  let angle = 0;
  let frame = null; // of the browser, while it plays
  let before = null;
  let isSeen = true;
  const watch = new IntersectionObserver((seen) => (isSeen = seen.at(-1).isIntersecting));
  watch.observe(el);

  function setClock() {
    const seconds = (angle / TURN_DEG) * model.get("turn_s");
    svg.setCurrentTime(Math.min(seconds, model.get("turn_s") - BEFORE_END_S));
  }

  function show(degrees) {
    angle = degrees;
    setClock();
    slider.value = Math.round(angle);
    slider.setAttribute("aria-valuetext", `${Math.round(angle)} deg`);
    status.textContent = `cam angle ${Math.round(angle)}°`;
  }

  function tell() {
    model.set("angle_deg", angle);
    model.save_changes();
  }

  function step(now) {
    const seconds = before === null ? 0 : (now - before) / 1000;
    before = now;
    // where nobody sees it, it waits: drawing it costs as much there
    if (isSeen) show((angle + (seconds / cycle) * select.value * TURN_DEG) % TURN_DEG);
    frame = requestAnimationFrame(step);
  }

  function play(isWanted) {
    cancelAnimationFrame(frame);
    before = null;
    frame = isWanted ? requestAnimationFrame(step) : null;
    button.textContent = isWanted ? "Pause" : "Play";
    status.setAttribute("aria-live", isWanted ? "off" : "polite");
  }

  function follow() {
    show(model.get("angle_deg"));
  }

  button.addEventListener("click", () => {
    play(frame === null);
    if (frame === null) tell();
  });
  slider.addEventListener("input", () => {
    play(false);
    show(slider.valueAsNumber);
  });
  slider.addEventListener("change", tell);
  model.on("change:angle_deg", follow);

  controls.whenConnected = () => {
    svg.pauseAnimations(); // Firefox passes it over before
    setClock();
  };
  el.append(svg, controls);
  show(model.get("angle_deg"));
  play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  return () => {
    cancelAnimationFrame(frame);
    watch.disconnect();
    model.off("change:angle_deg", follow);
  };
}

export default { render };
