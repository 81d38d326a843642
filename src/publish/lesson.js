// The page itself: which frame is shown, and what keys, clicks, touches and other pages do.
//
// In a deck: <iframe src="lesson.html?embed">. The page then leaves out its title and controls. It
// takes the keys of a reveal.js or Quarto deck while its slide is shown, and gives them back at
// its ends: it posts {"method": "next"} or {"method": "prev"} as JSON, which reveal.js obeys.
// Any other page may post to it {lantern: "next"}, {lantern: "back"}, {lantern: "play"} or
// {lantern: "go", frame: 7}, and is told {lantern: "frame", frame, frames, step, steps} of every
// frame that is shown. Frames are numbered from 0, as in file names and behind the address's #.

// On a black slide: <iframe src="lesson.html?embed&theme=dark&ground=none">; a theme is dark, light
// or grey, and without a ground what lies behind the page shows through.

const $ = (id) => document.getElementById(id);

class Page {
  constructor(lesson) {
    this.lesson = lesson;
    this.picture = new Picture(lesson, $("picture"));
    this.words = new Words(lesson);
    this.index = 0;
    this.behind = behindHash();
    this.byEvent = lesson.stepStops.length === 1;
    this.withMotion = false;
    this.playing = 0; // the animation frame that is asked for, while something plays
    this.embedded = ASKED.has("embed");
    this.nextLesson = JSON.parse($("card").textContent).next;
    document.body.classList.toggle("embedded", this.embedded);
  }

  // Another lesson in the place of this one: the engine of a live page has drawn it.
  load(lesson, facts, index) {
    this.pause();
    const hasOneStep = [lesson, this.lesson].map(({ stepStops }) => stepStops.length === 1);
    if (hasOneStep.includes(true)) [this.byEvent] = hasOneStep;
    this.lesson = lesson;
    this.words.load(lesson);
    const places = this.picture.places;
    this.look(lesson, facts, index);
    this.know(facts);
    this.speaker?.load(lesson);
    this.show(Math.min(index, lesson.last));
    this.picture.ease(places);
    this.words.fit();
  }

  // A frame of another lesson, for as long as nothing else is shown.
  look(lesson, facts, index = 0) {
    if (!this.watched) this.pointing?.light(null); // else other things will be lit at once
    this.picture.load(lesson, index);
    const sheet = styleSheet(lesson);
    if ($("styles").textContent !== sheet) $("styles").textContent = sheet;
    this.words.show(lesson.frames[index]);
    this.point(facts);
    if (!$("facts-panel").hidden) this.fillFacts(facts[index]);
  }

  get stops() {
    return this.byEvent ? this.lesson.frames.map((_, i) => i) : this.lesson.stepStops;
  }
  get following() {
    return this.stops.find((stop) => stop > this.index) ?? this.index;
  }
  get preceding() {
    return this.stops.findLast((stop) => stop < this.index) ?? this.index;
  }

  // --- showing a frame

  go(index) {
    this.pause();
    this.show(Math.min(Math.max(0, index), this.lesson.last));
  }

  show(index) {
    this.index = index;
    if (this.picture.lesson !== this.lesson) this.look(this.lesson, this.facts, index);
    this.picture.show(index);
    this.tell();
    this.pointing?.light(this.playing ? null : undefined);
    if (!$("facts-panel").hidden) this.fillFacts();
    this.speaker?.show(index, this.following);
    if (!this.playing) this.prepareNext();
    this.shown?.();
  }

  // What comes next is made while nobody waits for it.
  prepareNext() {
    cancelWhenIdle(this.preparing);
    this.preparing = whenIdle(() => this.picture.lesson === this.lesson && this.picture.prepare(this.following));
  }

  tell() {
    const { step, caption } = this.lesson.frames[this.index];
    this.words.show(this.lesson.frames[this.index]);
    this.tellStop(step, caption);
    $("back").disabled = this.index === 0;
    const onto = this.index === this.lesson.last && this.nextLesson;
    $("next").disabled = this.index === this.lesson.last && !onto;
    $("next").title = onto ? say("Next lesson: {} (→)", onto.title) : say("Next (→)");
    history.replaceState(null, "", `#${this.index}${this.behind}`);
    this.post({ frame: this.index, frames: this.lesson.frames.length, step, steps: this.lesson.steps });
  }

  // Slider and number count stops, from 1 on for people. A step stops at its last frame.
  tellStop(step, caption) {
    const stop = this.stops.findIndex((stop) => stop >= this.index);
    $("pace").setAttribute("aria-pressed", this.byEvent);
    const { grown } = this.words;
    const [place, count] = [stop + 1 + grown, this.stops.length + grown];
    $("slider").max = count - 1;
    $("slider").value = place - 1;
    $("slider").setAttribute("aria-label", say(this.byEvent ? "Frame" : "Step"));
    $("slider").setAttribute("aria-valuetext", say("{} of {}, step {}: {}", place, count, step + 1, caption));
    const areFrames = this.byEvent && this.stops.length > this.lesson.stepStops.length;
    $("number").textContent = areFrames ? say("frame {} / {}", place, count) : `${place} / ${count}`;
  }

  // --- stepping

  next() {
    if (this.playing) return this.pause();
    if (this.index === this.lesson.last) return this.leave("next");
    if (this.withMotion && !calm()) return this.play(this.following);
    this.go(this.following);
  }

  back() {
    if (this.index === 0) return this.leave("prev");
    this.go(this.preceding);
  }

  setPace(byEvent) {
    this.byEvent = byEvent;
    this.tell();
  }

  setMotion(on) {
    this.withMotion = on;
    $("motion").setAttribute("aria-pressed", on);
  }

  // --- playing

  // With in-betweens, to a frame; what was said is left to be read before it goes on. `rest`: seconds
  // before it begins.
  play(until = this.lesson.last, rest = 0) {
    if (this.index >= until) return;
    this.pointing?.light(null);
    $("play").setAttribute("aria-pressed", "true");
    let from = performance.now() + 1000 * rest;
    const tick = (now) => {
      this.playing = requestAnimationFrame(tick);
      const speed = Number($("speed").value);
      const { seconds } = this.lesson.frames[this.index + 1];
      const t = ((now - from) / 1000) * speed / seconds;
      if (t < 0) return;
      if (t < 1) return calm() ? undefined : this.picture.showBetween(this.index + 1, t);
      this.show(this.index + 1);
      from = Math.max(now - 1000 * seconds / speed, from + 1000 * seconds / speed) + 1000 * this.lesson.secondsToRead(this.index) / speed;
      if (this.index >= until) this.pause();
    };
    this.playing = requestAnimationFrame(tick);
  }

  pause() {
    if (!this.playing) return;
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    $("play").setAttribute("aria-pressed", "false");
    if (this.picture.lesson === this.lesson) this.picture.show(this.index);
    this.pointing?.light();
  }

  togglePlay() {
    if (this.playing) return this.pause();
    const isOver = this.index === this.lesson.last;
    if (isOver) this.show(0);
    this.play(this.lesson.last, isOver ? this.lesson.secondsToRead(0) / Number($("speed").value) : 0);
  }

  // --- what stands beside

  toggleFacts() {
    const panel = $("facts-panel");
    panel.hidden = !panel.hidden;
    for (const name of ["aria-pressed", "aria-expanded"]) $("facts").setAttribute(name, !panel.hidden);
    if (!panel.hidden) this.fillFacts();
    else if (panel.contains(document.activeElement)) $("facts").focus();
    this.words.fit();
  }

  // What is open, or plays, or is lit.
  closeAll() {
    this.pause();
    this.pointing?.light(null);
    if (!$("facts-panel").hidden) this.toggleFacts();
  }

  fillFacts(sides = this.facts[this.index]) {
    $("facts-panel").lastElementChild.replaceChildren(...sides.flatMap(factTables));
  }

  openOverview() {
    const dialog = $("overview-dialog");
    fillOverview(dialog, this.lesson, this.lesson.stepStops, this.lesson.stepStops.find((stop) => stop >= this.index),
      (index) => { dialog.close(); this.go(index); });
    dialog.append(element(document, "form", { method: "dialog", children: [element(document, "button", { text: say("Close") })] }));
  }

  openQuestions() {
    if ($("question")) $("question-dialog")[matchMedia("(pointer: coarse)").matches ? "show" : "showModal"]();
  }

  openSpeaker() {
    if (!this.speaker?.isOpen) this.speaker = new SpeakerView(this.lesson, (event) => onKey(this, event));
    this.speaker.show(this.index, this.following);
  }

  toggleFull() {
    document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
  }

  // --- pointing

  // The frame's facts are there.
  know(facts) {
    this.facts = facts;
    this.point(facts);
    $("facts").disabled = false;
  }

  point(facts) {
    this.pointing = new Pointing(this.picture.lesson, this.picture, facts, (words) => {
      $("said").textContent = words;
      $("told").textContent = words;
      $("told").hidden = !words;
    }, this.watched);
  }

  // Where an event is, in the picture's own units.
  placeOf({ clientX, clientY }) {
    return new DOMPoint(clientX, clientY).matrixTransform($("picture").getScreenCTM().inverse());
  }

  pointAt(event) {
    if (this.playing || !this.pointing) return;
    const { x, y } = this.placeOf(event);
    this.pointing.light(this.pointing.at(event.target.parentNode === this.picture.layer ? event.target : null, x, y) ?? undefined);
  }

  // Buttons for all that can be pointed at, for those who have no pointer. Made when they are asked
  // for: a frame may have thousands.
  fillThings() {
    const buttons = this.pointing.entities.slice(0, MOST_ROWS).map((one) =>
      element(document, "button", { "data-entity": one, text: this.pointing.words(one) }));
    const first = $("things").firstElementChild;
    while (first.nextElementSibling) first.nextElementSibling.remove(); // it keeps the focus
    $("things").append(...buttons);
  }

  // --- other pages

  post(message) {
    if (window.parent !== window) window.parent.postMessage({ lantern: "frame", ...message }, "*");
  }

  // At either end a reveal.js deck goes on with its own slides.
  leave(method) {
    if (window.parent !== window) window.parent.postMessage(JSON.stringify({ method }), "*");
    else if (method === "next" && this.nextLesson) location.href = this.nextLesson.file + location.search;
  }

  receive(data) {
    if (data === "slide:start") return window.focus(); // of reveal.js: our slide is shown
    const what = data?.lantern;
    if (what === "next" || what === "back") this[what]();
    if (what === "play") this.togglePlay();
    if (what === "go" && Number.isInteger(data.frame)) this.go(data.frame);
  }
}

const whenIdle = window.requestIdleCallback ?? ((act) => setTimeout(act, 50));
const cancelWhenIdle = window.cancelIdleCallback ?? clearTimeout;
const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

const KEYS = {
  ArrowRight: (page) => page.next(), ArrowDown: (page) => page.next(),
  PageDown: (page) => page.next(), " ": (page) => page.next(),
  ArrowLeft: (page) => page.back(), ArrowUp: (page) => page.back(),
  PageUp: (page) => page.back(), Backspace: (page) => page.back(),
  Home: (page) => page.go(0), End: (page) => page.go(page.lesson.last),
  e: (page) => page.setPace(!page.byEvent), m: (page) => page.setMotion(!page.withMotion),
  p: (page) => page.togglePlay(), i: (page) => page.toggleFacts(),
  o: (page) => page.openOverview(), q: (page) => page.openQuestions(), s: (page) => page.openSpeaker(),
  d: changeTheme, f: (page) => page.toggleFull(),
  "?": () => $("help-dialog").showModal(),
  Escape: (page) => page.closeAll(),
};

function onKey(page, event) {
  if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector("dialog[open]")) return;
  const { tagName } = event.target;
  if ((tagName === "SELECT" && event.key !== "Escape") || (tagName === "INPUT" && event.key.startsWith("Arrow")) || (tagName === "BUTTON" && event.key === " ")) return;
  const act = KEYS[event.key] ?? KEYS[event.key.toLowerCase()];
  if (!act) return;
  event.preventDefault();
  act(page);
}

function listenToButtons(page) {
  const acts = {
    back: () => page.back(), next: () => page.next(), play: () => page.togglePlay(),
    pace: () => page.setPace(!page.byEvent), motion: () => page.setMotion(!page.withMotion),
    facts: () => page.toggleFacts(), overview: () => page.openOverview(), speaker: () => page.openSpeaker(),
    theme: changeTheme, full: () => page.toggleFull(), help: () => $("help-dialog").showModal(),
  };
  for (const [id, act] of Object.entries(acts)) $(id).addEventListener("click", act);
  $("question")?.addEventListener("click", () => page.openQuestions());
  $("question-dialog").addEventListener("click", (event) => event.target.closest("a") && $("question-dialog").close());
  $("facts-panel").firstElementChild.addEventListener("click", () => page.toggleFacts());
  $("slider").addEventListener("input", () => page.go(page.stops[$("slider").value]));
  for (const dialog of document.querySelectorAll("dialog"))
    dialog.addEventListener("click", (event) => event.target === dialog && dialog.matches(":modal") && dialog.close());
}

function listenToPointer(page) {
  const stage = $("stage");
  let touch = null; // and how far it has gone, unless a hand has a body or the picture moves
  stage.addEventListener("pointermove", (event) => event.pointerType === "mouse" && page.pointAt(event));
  stage.addEventListener("pointerleave", () => page.pointing?.light());
  for (const part of [stage, $("words")]) {
    part.addEventListener("pointerdown", ({ pointerType, clientX }) => (touch = pointerType === "touch" ? { clientX, way: 0 } : null));
    part.addEventListener("pointermove", ({ clientX }) => touch && (touch.way = clientX - touch.clientX));
    part.addEventListener("pointerup", () => Math.abs(touch?.way ?? 0) > 30 && (touch.way > 0 ? page.back() : page.next()));
  }
  stage.addEventListener("click", (event) => {
    if (event.pointerType !== "touch") return event.shiftKey ? page.back() : page.next();
    const at = (event.clientX - stage.offsetLeft) / stage.offsetWidth;
    if (at > 0.2 && at < 0.8) return page.pointAt(event);
    return at <= 0.2 ? page.back() : page.next();
  });
}

// What stands for a thing outside the picture is pointed at by pointer or focus.
function listenToThings(page) {
  const light = (event) => {
    const one = event.target.closest("[data-entity]")?.dataset.entity;
    if (one && page.pointing && !page.playing) page.pointing.light(one);
  };
  const dark = () => page.pointing?.light();
  for (const list of [$("facts-panel"), $("things")]) {
    list.addEventListener("pointerover", light);
    list.addEventListener("pointerleave", dark);
    list.addEventListener("focusin", light);
    list.addEventListener("focusout", dark);
  }
  $("things").firstElementChild.addEventListener("focus", () => page.pointing && page.fillThings());
}

const indexFromHash = () => Number.parseInt(location.hash.slice(1), 10) || 0;
const behindHash = () => location.hash.match(/&.*/)?.[0] ?? "";

const ASKED = new URLSearchParams(location.search);
const theme = Object.keys(THEMES).find((name) => [name, THEMES[name]].includes(ASKED.get("theme")));
if (theme) document.documentElement.dataset.theme = theme;
document.documentElement.classList.toggle("bare", ASKED.get("ground") === "none");

// Who prints before the pictures are there is asked once more when they are.
let printedEarly = false;
const printEarly = () => (printedEarly = true);
window.addEventListener("beforeprint", printEarly);

async function open() {
  const lesson = new Lesson((await unpacked("frames-packed")) ?? EMPTY);
  document.head.append(element(document, "style", { id: "styles", text: styleSheet(lesson) }));
  const page = new Page(lesson);
  listenToButtons(page);
  listenToPointer(page);
  listenToThings(page);
  document.addEventListener("keydown", (event) => onKey(page, event));
  window.addEventListener("hashchange", () => {
    page.behind = behindHash();
    page.go(indexFromHash());
  });
  window.addEventListener("message", (event) => page.receive(event.data));
  window.removeEventListener("beforeprint", printEarly);
  window.addEventListener("beforeprint", () => fillHandout($("handout"), page.lesson, document.title));
  window.addEventListener("afterprint", () => $("handout").replaceChildren());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", nameTheme);
  nameTheme();
  window.addEventListener("resize", () => page.words.fit());
  page.go(indexFromHash()); // before anything writes a number there
  page.words.fit();
  document.documentElement.dataset.ready = Math.round(performance.now());
  if (printedEarly) window.print();
  window.lantern = page; // for those who look into it, and for tests
  page.know((await unpacked("facts-packed")) ?? [[]]);
  return page;
}

const opened = open();
opened.catch((error) => {
  document.documentElement.classList.remove("live"); // the page as it is without scripts
  throw error;
});
