// What stands beside the picture when it is asked for: facts, all steps, the handout, the speaker's
// view.

// An element of a document with a class, a text or children.
function element(doc, tag, { text, children = [], ...attributes } = {}) {
  const made = doc.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  made.append(...children);
  return made;
}

function table(title, heads, rows) {
  const cells = (tag, texts) => texts.map((text) => element(document, tag, { text }));
  const body = rows.map(({ texts, of }) =>
    element(document, "tr", { children: cells("td", texts), ...(of ? { "data-entity": of, tabindex: 0 } : {}) }));
  return element(document, "table", {
    children: [
      element(document, "caption", { text: title }),
      element(document, "thead", { children: [element(document, "tr", { children: cells("th", heads) })] }),
      element(document, "tbody", { children: body }),
    ],
  });
}

const MOST_ROWS = 400;

// One side's facts as tables. What stands in a row can be pointed at.
function factTables(facts) {
  const { name: side } = facts;
  const relations = new Relations(facts);
  const numbers = [...facts.counts, ...facts.measures].map(([name, n]) => ({ texts: [name.replaceAll("_", " "), n] }));
  const bodies = facts.bodies.slice(0, MOST_ROWS).map(([id, name, at, speed, state]) =>
    ({ texts: [name || `#${id}`, at.join(", "), speed, state], of: entity(side, "body", name || `#${id}`) }));
  const nodes = facts.nodes.slice(0, MOST_ROWS).map(([way, label, depth, leaf]) =>
    ({ texts: [label, depth, leaf ? "leaf" : "", [...relations.nodes.get(way).bodies].join(", ")],
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

// Every stop as a small picture; chosen(index) when one is.
function fillOverview(dialog, lesson, stops, current, chosen) {
  const drawn = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting || target.querySelector("svg")) continue;
      target.prepend(still(lesson, document, Number(target.dataset.index)));
    }
  }, { rootMargin: "200px" });
  dialog.replaceChildren(...stops.map((index) => {
    const { step, caption } = lesson.frames[index];
    const button = element(document, "button", {
      "data-index": index,
      ...(index === current ? { "aria-current": "step", autofocus: "" } : {}),
      children: [element(document, "b", { text: step + 1 }), element(document, "span", { text: caption })],
    });
    button.addEventListener("click", () => chosen(index));
    drawn.observe(button);
    return button;
  }));
  dialog.showModal();
}

// For printing: each step a figure with its caption.
function fillHandout(section, lesson, title) {
  section.replaceChildren(element(document, "h1", { text: title }), ...lesson.stepStops.map((index) => {
    const { step, caption } = lesson.frames[index];
    const words = [element(document, "b", { text: `${step + 1} ` }), caption];
    return element(document, "figure", {
      children: [still(lesson, document, index), element(document, "figcaption", { children: words })],
    });
  }));
}

// A window of its own: this frame, its notes, what comes next, and a clock.
class SpeakerView {
  constructor(lesson, onKey) {
    this.window = window.open("", "lantern-speaker", "width=1100,height=700");
    if (!this.window) return;
    this.lesson = lesson;
    this.began = Date.now();
    const doc = this.window.document;
    doc.title = `Speaker: ${document.title}`;
    doc.documentElement.className = "live";
    doc.head.replaceChildren(...[...document.querySelectorAll("style")].map((style) => doc.importNode(style, true)));
    doc.body.className = "speaker";
    this.parts = Object.fromEntries(["now", "next", "notes", "caption", "clock"].map((id) => [id, element(doc, "div", { id })]));
    doc.body.replaceChildren(...Object.values(this.parts));
    [this.now, this.next] = ["now", "next"].map((id) => {
      const svg = doc.createElementNS(SVG, "svg");
      this.parts[id].append(svg);
      return new Picture(lesson, svg);
    });
    doc.addEventListener("keydown", onKey);
    this.timer = setInterval(() => this.tick(), 500);
  }

  get isOpen() {
    return Boolean(this.window && !this.window.closed);
  }

  tick() {
    if (!this.isOpen) return clearInterval(this.timer);
    const seconds = Math.floor((Date.now() - this.began) / 1000);
    const two = (n) => String(n).padStart(2, "0");
    this.parts.clock.textContent = `${new Date().toLocaleTimeString()}  ·  ${two(Math.floor(seconds / 60))}:${two(seconds % 60)}`;
  }

  show(index, next) {
    if (!this.isOpen) return;
    const { notes, caption } = this.lesson.frames[index];
    this.now.show(index);
    this.parts.next.hidden = next === index;
    if (next !== index) this.next.show(next);
    this.parts.notes.textContent = notes ?? "";
    this.parts.caption.textContent = caption;
    this.tick();
  }
}
