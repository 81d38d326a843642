// Frames as SVG: one element a shape. An element stays as long as its shape does, so that a step
// changes only what changes.

const MANY = 1500; // shapes that make a step slow
const EASE = 200; // ms
const SVG = "http://www.w3.org/2000/svg";
const TAG = ["rect", "line", "polygon", "path"];
const RECT_AT = ["x", "y", "width", "height", "rx"]; // in the order of a rectangle's measures
const LINE_AT = ["x1", "y1", "x2", "y2"];
const role = (number) => (number === 0 ? "none" : `var(--role-${number})`);

// The classes that paint: colours by role, so that a theme changes them all at once.
function styleSheet(lesson) {
  return lesson.styles
    .map(([fill, stroke, width, dash, snapped], i) => {
      const rules = [`fill:${role(fill)}`];
      if (stroke) rules.push(`stroke:${role(stroke)}`, `stroke-width:${width / 100}`);
      if (dash) rules.push(`stroke-dasharray:${dash / 100}`);
      rules.push(`stroke-linecap:${dash ? "butt" : snapped ? "square" : "round"}`);
      if (snapped) rules.push("shape-rendering:crispEdges");
      return `.s${i}{${rules.join(";")}}`;
    })
    .join("\n");
}

// A text as one outline, a thousand units to the em.
function outlineOf(lesson, text) {
  const [, ...letters] = lesson.texts[text];
  let path = "";
  for (let i = 0; i < letters.length; i += 2) {
    const glyph = lesson.glyphs[letters[i + 1]];
    if (glyph) path += `M${letters[i]} 0${glyph}`;
  }
  return path;
}

const thousandths = (n) => Math.round(n * 1000) / 1000;

// Sets where an element is; `before`: where it is known to be.
function place(element, kind, at, before = []) {
  if (kind === KIND.rect || kind === KIND.line) {
    for (const [i, name] of (kind === KIND.rect ? RECT_AT : LINE_AT).entries()) {
      if (at[i] === before[i]) continue;
      element.setAttribute(name, thousandths(kind === KIND.rect && i > 1 ? Math.max(at[i], 0) : at[i]));
    }
  } else if (kind === KIND.polygon) {
    element.setAttribute("points", at.map(thousandths).join(" "));
  } else {
    const [x, y, size] = at;
    element.setAttribute("transform",
      `translate(${thousandths(x)} ${thousandths(y)}) scale(${size / 1000})`);
    if (element.halo) element.setAttribute("stroke-width", 6000 / Math.max(size, 1e-3));
  }
}

// The list that a map has for a key.
function listIn(map, key) {
  if (!map.has(key)) map.set(key, []);
  return map.get(key);
}

class Picture {
  // Draws into an <svg>, of any document.
  constructor(lesson, svg) {
    this.svg = svg;
    this.open(lesson);
    this.layer = svg.appendChild(this.make("g"));
    this.over = svg.appendChild(this.make("g"));
    this.over.setAttribute("class", "over");
    this.standing = new Map(); // by row: elements that stand as it says
    this.ready = new Map(); // and one that was made beforehand
    this.moving = null;
  }

  open(lesson) {
    this.lesson = lesson;
    this.svg.setAttribute("viewBox", `0 0 ${lesson.size.join(" ")}`);
  }

  // A frame of a lesson that takes the place of this one: elements of the same key and kind stay.
  load(lesson, index) {
    this.settle();
    this.dropSpare();
    this.ready = new Map();
    this.open(lesson);
    const standing = new Map();
    for (let child = this.layer.lastChild; child; child = child.previousSibling)
      listIn(standing, 4 * child.thing + child.kind).push(child);
    this.arrange(lesson.lists[index].map((row) => {
      const { kind, key } = lesson.shape(row);
      const element = standing.get(4 * key + kind)?.pop();
      return element ? this.dressed(element, row) : this.made(row);
    }));
    this.index = index;
  }

  make(tag) {
    return this.svg.ownerDocument.createElementNS(SVG, tag);
  }

  show(index) {
    this.settle();
    if (this.spare?.index === index) this.showSpare();
    else this.arrange(this.lesson.lists[index].map((row) => this.take(row)));
    this.index = index;
  }

  // The picture at `t`, 0 ... 1, of the way from the frame before to a frame.
  showBetween(index, t) {
    if (this.moving?.index !== index) this.begin(index);
    const { motion } = this.lesson.frames[index];
    for (const passage of this.moving.passages) this.move(passage, t, motion);
  }

  begin(index) {
    this.settle();
    const passages = passagesOf(this.lesson, index);
    for (const passage of passages) passage.element = this.take(passage.from ?? passage.to);
    this.arrange(passages.map((passage) => passage.element));
    this.moving = { index, passages: passages.filter((passage) => !passage.still) };
    for (const { element } of this.moving.passages) {
      element.style.shapeRendering = "auto"; // on whole pixels it would go in jerks
      this.forget(element);
    }
  }

  move(passage, t, motion) {
    const { element, at, end, leaves } = passage;
    const seen = progress(this.lesson, passage.fade, t, motion);
    const share = progress(this.lesson, passage.move, t, motion);
    element.style.opacity = leaves ? 1 - seen : seen;
    place(element, element.kind, at.map((from, i) => from + (end[i] - from) * share));
    if (passage.from !== undefined && passage.to !== undefined) this.tint(passage, share);
  }

  // From the colours and the line of the one to those of the other.
  tint({ element, from, to }, share) {
    const [a, b] = [from, to].map((row) => this.lesson.styles[this.lesson.shape(row).style]);
    if (a === b) return;
    const mixed = (x, y) =>
      x === y ? role(y)
        : `color-mix(in srgb, ${x ? role(x) : "transparent"}, ${y ? role(y) : "transparent"} ${share * 100}%)`;
    element.style.fill = mixed(a[0], b[0]);
    element.style.stroke = mixed(a[1], b[1]);
    if (element.kind === KIND.text) return;
    const width = !a[1] ? b[2] : !b[1] ? a[2] : a[2] + (b[2] - a[2]) * share;
    element.style.strokeWidth = width / 100;
  }

  get places() {
    return [...this.layer.children].map((element) => [element, element.at]);
  }

  // What stood elsewhere goes to where it is now.
  ease(places) {
    const moved = calm() ? [] : places.filter(([{ at, parentNode }, from]) =>
      parentNode === this.layer && at.length === from.length && at.some((n, i) => n !== from[i]));
    const began = performance.now();
    const tick = (now) => {
      const t = Math.min(1, Math.max(0, now - began) / EASE);
      for (const [element, from] of moved) place(element, element.kind, element.at.map((to, i) => to + (from[i] - to) * (1 - t) ** 2));
      this.easing = t < 1 && requestAnimationFrame(tick);
    };
    this.easing = moved.length > 0 && requestAnimationFrame(tick);
    this.arrive = () => tick(Infinity);
  }

  // What was moving goes: its elements are made anew where they are needed.
  settle() {
    if (this.easing) {
      cancelAnimationFrame(this.easing);
      this.arrive();
    }
    if (!this.moving) return;
    for (const { element } of this.moving.passages) element.remove();
    this.moving = null;
  }

  // Makes what a frame will need, so that the step there costs less.
  prepare(index) {
    if (this.spare?.index === index) return;
    this.dropSpare();
    const fresh = this.lesson.lists[index].filter((row) => !this.standing.has(row));
    if (fresh.length > MANY) return this.prepareLayer(index);
    const ready = new Map();
    for (const row of this.lesson.lists[index])
      if (!this.standing.has(row) && !ready.has(row)) ready.set(row, this.ready.get(row) ?? this.made(row));
    this.ready = ready;
  }

  dropSpare() {
    this.spare?.layer.remove();
    this.spare = null;
  }

  // Of very many shapes a whole layer, out of sight: then even their style and place are settled.
  prepareLayer(index) {
    const layer = this.make("g");
    layer.setAttribute("class", "spare");
    layer.append(...this.lesson.lists[index].map((row) => this.made(row)));
    this.svg.insertBefore(layer, this.layer);
    this.spare = { index, layer };
  }

  showSpare() {
    this.layer.remove();
    this.layer = this.spare.layer;
    this.layer.removeAttribute("class");
    this.spare = null;
    this.keep([...this.layer.children]);
  }

  // An element for a row, from among those that stand or are ready if there is one.
  take(row) {
    const free = this.standing.get(row)?.pop() ?? this.ready.get(row);
    this.ready.delete(row);
    return free ?? this.made(row);
  }

  made(row) {
    const { kind, key } = this.lesson.shape(row);
    const element = this.make(TAG[kind]);
    Object.assign(element, { kind, thing: key, marks: "" });
    return this.dressed(element, row);
  }

  // An element as a row has it. What it has already is left alone.
  dressed(element, row) {
    const { kind, style, text, at } = this.lesson.shape(row);
    const outline = kind === KIND.text ? outlineOf(this.lesson, text) : "";
    const halo = kind === KIND.text && this.lesson.styles[style][1] > 0;
    if (element.look !== style) {
      element.paint = `s${style}${halo ? " halo" : ""}`;
      element.setAttribute("class", element.paint + element.marks);
    }
    if (outline && element.outline !== outline) element.setAttribute("d", outline);
    const stays = element.halo === halo && element.at?.length === at.length && at.every((n, i) => n === element.at[i]);
    const before = element.at;
    Object.assign(element, { row, outline, halo, at, look: style });
    if (!stays) place(element, kind, at, before);
    return element;
  }

  // What is told of an element by further classes, each behind a blank.
  mark(element, marks) {
    if (element.marks === marks) return;
    element.marks = marks;
    element.setAttribute("class", element.paint + marks);
  }

  forget(element) {
    const same = this.standing.get(element.row);
    same?.splice(same.indexOf(element), 1);
  }

  // These elements and no others, in this order.
  arrange(elements) {
    const staying = new Set(elements);
    for (const element of [...this.layer.childNodes]) if (!staying.has(element)) element.remove();
    let cursor = this.layer.firstChild;
    for (const element of elements) {
      if (element === cursor) cursor = cursor.nextSibling;
      else this.layer.insertBefore(element, cursor);
    }
    this.keep(elements);
  }

  keep(elements) {
    this.standing = new Map();
    for (const element of elements) listIn(this.standing, element.row).push(element);
  }
}
