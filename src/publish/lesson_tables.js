// What stands beside the picture: the words, and when they are asked for facts, all steps, the
// handout, the speaker's view.

// An element of a document with a class, a text or children.
function element(doc, tag, { text, children = [], ...attributes } = {}) {
  const made = doc.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  made.append(...children);
  return made;
}

const counterList = (doc, counters = []) => counters.map((text) => element(doc, "span", { text }));

// The words above and below the picture.
class Words {
  static MOST_PASSES = 5;
  static MOST_EDGE = 0.14; // of the width: words as narrow as a small picture would make it smaller

  constructor(lesson) {
    this.load(lesson);
  }

  load(lesson) {
    this.lesson = lesson;
    this.grown = 0; // steps that a frame's lesson has more, which is not loaded
    for (const spare of document.querySelectorAll("#words .spare:not(.kept)")) spare.remove();
    document.getElementById("words").append(...this.spares());
    document.documentElement.style.setProperty("--ratio", lesson.ratio);
    document.documentElement.classList.toggle("upright", lesson.ratio < 1.2);
  }

  // Unseen words of all frames, in the place of those that are seen: the room for words is that of
  // the longest at any size of the window, and the picture keeps its own from step to step. Words
  // that differ in their digits alone need the same room.
  spares() {
    const distinct = new Map();
    for (const { caption, isTold, counters = [], ending } of this.lesson.frames) {
      if (isTold) continue; // it is short
      const words = JSON.stringify([caption, counters, ending]).replace(/\d/g, "0");
      distinct.set(words, JSON.parse(words));
    }
    return [...distinct.values()].map(([caption, counters, ending]) =>
      element(document, "div", {
        class: `words spare${ending ? " ending" : ""}`, "aria-hidden": "true",
        children: [
          element(document, "p", { class: "caption", text: caption }),
          element(document, "p", { class: "counters", children: counterList(document, counters) }),
        ],
      }));
  }

  // `beside`: what else there is to say of the frame, in small letters.
  show({ step, caption, beside, part, counters, ending }) {
    const [told, numbers] = ["caption", "counters"].map((id) => document.getElementById(id));
    if (told.textContent !== caption) told.textContent = caption;
    told.dataset.beside = beside ?? "";
    numbers.replaceChildren(...counterList(document, counters));
    told.parentNode.classList.toggle("ending", Boolean(ending));
    document.getElementById("part").textContent = part ?? "";
    document.getElementById("place").textContent = say("step {} of {}", step + 1, this.lesson.steps + this.grown);
  }

  // Words begin and end where the picture's panels do. Narrower words may be higher, and then the
  // picture is smaller: done again until nothing moves.
  fit() {
    const [width, height] = this.lesson.size;
    const app = document.getElementById("app");
    const margin = width < 1000 ? 40 : 60; // of draw/page.cpp
    let edge = Math.round((margin * document.getElementById("stage").clientWidth) / width);
    for (let pass = 0; pass < Words.MOST_PASSES; pass++) {
      app.style.setProperty("--edge", `${edge}px`);
      const { clientWidth, clientHeight } = document.getElementById("stage");
      const scale = Math.min(clientWidth / width, clientHeight / height);
      const found = Math.round(Math.min((clientWidth - scale * width) / 2 + margin * scale, Words.MOST_EDGE * clientWidth));
      if (found <= edge || width < height) return;
      edge = found;
    }
  }
}

const THEMES = { light: "light", dark: "dark", print: "grey" };

function themeNow() {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  return document.documentElement.dataset.theme ?? (dark ? "dark" : "light");
}

function followingTheme() {
  const names = Object.keys(THEMES);
  return names[(names.indexOf(themeNow()) + 1) % names.length];
}

function changeTheme() {
  document.documentElement.dataset.theme = followingTheme();
  nameTheme();
}

function nameTheme() {
  const title = say("Colours: {}. Change to {} (D)", say(THEMES[themeNow()]), say(THEMES[followingTheme()]));
  const button = document.getElementById("theme");
  for (const name of ["title", "aria-label"]) button.setAttribute(name, title);
}

function table(title, heads, rows) {
  const cells = (tag, texts) => texts.map((text) => element(document, tag, { text }));
  const body = rows.map(({ texts, of }) =>
    element(document, "tr", { children: cells("td", texts), ...(of ? { "data-entity": of, tabindex: 0 } : {}) }));
  return element(document, "table", {
    children: [
      element(document, "caption", { text: say(title) }),
      element(document, "thead", { children: [element(document, "tr", { children: cells("th", heads.map((head) => say(head))) })] }),
      element(document, "tbody", { children: body }),
    ],
  });
}

const MOST_ROWS = 400;

// One side's facts as tables. What stands in a row can be pointed at.
function factTables(facts) {
  const { name: side } = facts;
  const relations = new Relations(facts);
  const numbers = [...facts.counts, ...facts.measures].map(([name, n]) => ({ texts: [name.replaceAll("_", " "), numberSaid(n)] }));
  const bodies = facts.bodies.slice(0, MOST_ROWS).map(([id, name, at, speed, state, label]) =>
    ({ texts: [label ?? (name || `#${id}`), pointSaid(at), numberSaid(speed), say(state)], of: entity(side, "body", name || `#${id}`) }));
  const nodes = facts.nodes.slice(0, MOST_ROWS).map(([way, label, depth, leaf]) =>
    ({ texts: [labelOf(label), depth, leaf ? form("leaf/leaves", 1) : "", [...relations.nodes.get(way).bodies].map((name) => relations.called(name)).join(", ")],
       of: entity(side, "node", way) }));
  const title = facts.title || side;
  const parts = title ? [element(document, "h2", { text: title })] : [];
  parts.push(table("Counts", ["count", "number"], numbers));
  if (bodies.length) parts.push(table("Bodies", ["name", "place", "speed", ""], bodies));
  if (nodes.length) parts.push(table("Nodes", ["node", "depth", "", "holds"], nodes));
  return parts;
}

function still(lesson, doc, index) {
  const svg = doc.createElementNS(SVG, "svg");
  new Picture(lesson, svg).show(index);
  return svg;
}

// The columns that make pictures of a shape as large as they can be in a room, and their width;
// where not all find room, the least width at which a caption can be read.
function columnsFor(count, ratio, { width, height }) {
  const [words, gap, least] = [54, 13, 240]; // px: a caption's lines, between pictures, a picture
  const widthOf = (columns) => {
    const rows = Math.ceil(count / columns);
    return Math.min((width - gap) / columns - gap, ((height - gap) / rows - gap - words) * ratio);
  };
  const best = Math.max(...Array.from({ length: count }, (_, i) => widthOf(i + 1)));
  return `repeat(auto-fit, ${Math.floor(Math.max(best, Math.min(least, width - 4 * gap)))}px)`;
}

// Every stop as a small picture; chosen(index) when one is.
function fillOverview(dialog, lesson, stops, current, chosen) {
  const drawn = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting || target.querySelector("svg")) continue;
      target.prepend(still(lesson, document, Number(target.dataset.index)));
    }
  }, { rootMargin: "200px" });
  const room = { width: 0.97 * innerWidth - 16, height: 0.97 * innerHeight }; // beside a scroll bar
  dialog.style.setProperty("--columns", columnsFor(stops.length, lesson.ratio, room));
  dialog.replaceChildren(...stops.map((index) => {
    const button = stopButton(lesson, index, index === current);
    button.addEventListener("click", () => chosen(index));
    drawn.observe(button);
    return button;
  }));
  dialog.showModal();
}

function stopButton(lesson, index, isCurrent) {
  const { step, caption } = lesson.frames[index];
  return element(document, "button", {
    "data-index": index,
    ...(isCurrent ? { "aria-current": "step", autofocus: "" } : {}),
    children: [
      element(document, "p", {
        children: [element(document, "b", { text: step + 1 }), element(document, "span", { text: caption })],
      }),
    ],
  });
}

// For printing: each step a figure with its caption and counters. Wide pictures leave less of the
// paper empty three to an upright page, others two by two on a page lying down.
const WIDE = 2.2; // so many times their height, of which both are as good

function fillHandout(section, lesson, title) {
  const isWide = lesson.ratio > WIDE;
  const page = `@page{size:A4 ${isWide ? "portrait" : "landscape"}}`;
  section.className = isWide ? "upright" : "lying";
  section.replaceChildren(element(document, "style", { text: page }), element(document, "h1", { text: title }),
    ...lesson.stepStops.map((index) => figureOf(lesson, index)));
}

function figureOf(lesson, index) {
  const { step, caption, counters, ending } = lesson.frames[index];
  const words = element(document, "p", { children: [element(document, "b", { text: step + 1 }), caption] });
  const numbers = element(document, "p", { class: "counters", children: counterList(document, counters) });
  return element(document, "figure", {
    ...(ending ? { class: "ending" } : {}),
    children: [still(lesson, document, index), element(document, "figcaption", { children: [words, numbers] })],
  });
}

const SPEAKER_PARTS = ["place", "clock", "now", "caption", "counters", "side"];
const SPEAKER_SIDE = ["head", "coming", "next", "notes"];

// A window of its own: this frame with its words, what comes next, notes, and a clock.
class SpeakerView {
  constructor(lesson, onKey) {
    this.window = window.open("", "lantern-speaker", "width=1280,height=760");
    if (!this.window) return;
    this.lesson = lesson;
    this.began = Date.now();
    const doc = this.window.document;
    doc.documentElement.className = "live";
    doc.documentElement.dataset.theme = themeNow();
    doc.head.replaceChildren(...[...document.querySelectorAll("style")].map((style) => doc.importNode(style, true)));
    doc.title = say("Speaker’s view: {}", document.title); // it stands in the head
    doc.body.className = "speaker";
    this.parts = Object.fromEntries([...SPEAKER_PARTS, ...SPEAKER_SIDE].map((id) => [id, element(doc, "div", { id })]));
    doc.body.replaceChildren(...SPEAKER_PARTS.map((id) => this.parts[id]));
    this.parts.side.append(...SPEAKER_SIDE.map((id) => this.parts[id]));
    [this.now, this.next] = ["now", "next"].map((id) => {
      const svg = doc.createElementNS(SVG, "svg");
      this.parts[id].append(svg);
      return new Picture(lesson, svg);
    });
    doc.addEventListener("keydown", onKey);
    this.timer = setInterval(() => this.tick(), 500);
  }

  load(lesson) {
    if (!this.isOpen) return;
    this.lesson = lesson;
    for (const picture of [this.now, this.next]) picture.load(lesson, 0);
    this.window.document.getElementById("styles").textContent = styleSheet(lesson);
  }

  get isOpen() {
    return Boolean(this.window && !this.window.closed);
  }

  tick() {
    if (!this.isOpen) return clearInterval(this.timer);
    const seconds = Math.floor((Date.now() - this.began) / 1000);
    const now = new Date();
    const two = (n) => String(n).padStart(2, "0");
    this.parts.clock.textContent = `${two(now.getHours())}:${two(now.getMinutes())}  ·  ` +
      say("{} elapsed", `${two(Math.floor(seconds / 60))}:${two(seconds % 60)}`);
  }

  show(index, next) {
    if (!this.isOpen) return;
    const { step, notes, caption, counters } = this.lesson.frames[index];
    const isLast = next === index;
    this.now.show(index);
    this.parts.next.hidden = isLast;
    if (!isLast) this.next.show(next);
    const { parts } = this;
    parts.place.textContent = say("Step {} of {}", step + 1, this.lesson.steps);
    parts.head.textContent = say(isLast ? "The end" : "Next");
    parts.coming.textContent = isLast ? "" : this.lesson.frames[next].caption;
    parts.notes.textContent = notes ?? "";
    parts.caption.textContent = caption;
    parts.counters.replaceChildren(...counterList(this.window.document, counters));
    this.tick();
  }
}
