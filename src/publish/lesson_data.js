// What a lesson page holds, unpacked: see src/publish/lesson_frames.hpp and lesson_shapes.hpp.

// The page's fixed words in its language, by the English ones; a page in English has none.
const { said: WORDS, decimal: DECIMAL } =
  JSON.parse(document.getElementById("word-table")?.textContent ?? '{"said": {}, "decimal": "."}');
const PLURALS = new Intl.PluralRules(document.documentElement.lang || "en");

// A sentence about these: "{}" in turn, or by number as a translation may have it, "{1}".
function say(english, ...values) {
  let next = 0;
  return (WORDS[english] ?? english).replace(/\{(\d*)\}/g, (_, i) => values[i === "" ? next++ : i]);
}

// Of "leaf/leaves" the form for so many: one, a few where a language has that, and others.
function form(forms, n) {
  const all = (WORDS[forms] ?? forms).split("/");
  return all[Math.min({ one: 0, few: 1 }[PLURALS.select(n)] ?? all.length - 1, all.length - 1)];
}
// A node's name as it is read: "root" and "front.back" are words.
const labelOf = (label) => label.split(".").map((part) => say(part)).join(".");
const numberSaid = (n) => String(n).replace(".", DECIMAL);
const pointSaid = (at) => at.map(numberSaid).join(DECIMAL === "," ? "; " : ", ");
const counted = (n, forms) => `${n} ${form(forms, n)}`;

const HUNDREDTH = 0.01;

// The JSON in <script id=...>: base64 of a zlib stream; null if it is empty.
async function unpacked(id) {
  const letters = atob(document.getElementById(id).textContent.trim());
  if (!letters) return null;
  const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).json();
}

const KIND = { rect: 0, line: 1, polygon: 2, text: 3 };

// Where the members of a list stand in a list known before, which takes in those that it lacks.
function numbersIn(known, list) {
  const numbers = (known.numbers ??= new Map(known.map((one, i) => [one.join("\n"), i])));
  return list.map((one) => {
    const words = one.join("\n");
    if (!numbers.has(words)) numbers.set(words, known.push(one) - 1);
    return numbers.get(words);
  });
}

// Of a page whose engine draws the first frame.
const EMPTY = {
  page: [160000, 90000], rows: [], keys: [], styles: [], texts: [], glyphs: [],
  frames: [{ step: 0, event: 0, time: 0, caption: "", rows: [] }],
};

class Lesson {
  // `before`: whose place in the page it takes; both then number keys and styles alike.
  constructor(data, before) {
    Object.assign(this, data);
    if (before) {
      this.numbers = ["keys", "styles"].map((list) => numbersIn(before[list], data[list]));
      [this.keys, this.styles] = [before.keys, before.styles];
    }
    this.size = data.page.map((length) => length * HUNDREDTH);
    this.ratio = this.size[0] / this.size[1];
    this.shapes = []; // of rows, made when first asked for
    this.lists = listsOf(data.frames);
    this.stepStops = data.frames.flatMap((frame, i) =>
      data.frames[i + 1]?.step === frame.step ? [] : [i]);
  }

  get last() {
    return this.frames.length - 1;
  }

  get steps() {
    return this.frames[this.last].step + 1;
  }

  // How long words are left to be read when they come.
  secondsToRead(index) {
    const wordsOf = ({ caption, beside = "" }) => caption + beside;
    const words = wordsOf(this.frames[index]);
    if (index === this.last || wordsOf(this.frames[index + 1]) === words) return 0;
    return Math.min(7, 1 + 0.05 * words.length);
  }

  // A row as { kind, key, style, text, at }: `at` are its measures in page units, of a rectangle
  // x, y, width, height, radius; of a line and a polygon points; of a text x, y, size.
  shape(row) {
    return (this.shapes[row] ??= shapeOf(this.rows[row], this.numbers));
  }

  entitiesOf(key) {
    return ((this.keys.entities ??= [])[key] ??= this.keys[key].slice(1));
  }
}

// Each frame's rows, in the order of painting.
function listsOf(frames) {
  let known = 0;
  let before = [];
  return frames.map(({ rows }) => {
    const list = [];
    for (let i = 0; i < rows.length; i += 2) {
      const [from, count] = [rows[i], rows[i + 1]];
      if (from === -2) list.push(count);
      else for (let k = 0; k < count; k++) list.push(from === -1 ? known++ : before[from + k]);
    }
    return (before = list);
  });
}

function shapeOf([kind, key, style, ...rest], [keys, styles] = []) {
  const at = rest.map((n) => n * HUNDREDTH);
  const shape = { kind, key: keys ? keys[key] : key, style: styles ? styles[style] : style, at };
  if (kind === KIND.text) {
    shape.text = rest[3];
    shape.at.length = 3;
  } else if (kind !== KIND.rect) {
    for (let i = 2; i < shape.at.length; i++) shape.at[i] += shape.at[i - 2];
  }
  return shape;
}

// The measures of a shape put upon another place, [sx, sy, dx, dy].
function put({ kind, at }, [sx, sy, dx, dy]) {
  const [kx, ky] = [sx / 10000, sy / 10000];
  const [x, y] = [dx * HUNDREDTH, dy * HUNDREDTH];
  const point = (n, i) => (i % 2 ? n * ky + y : n * kx + x);
  if (kind === KIND.rect)
    return [point(at[0], 0), point(at[1], 1), at[2] * kx, at[3] * ky, at[4] * Math.min(kx, ky)];
  if (kind === KIND.text)
    return [point(at[0], 0), point(at[1], 1), at[2] * Math.min(kx, ky, 1)];
  return at.map(point);
}

// The way from the frame before to a frame, as passages in the order of painting: `from` and `to`
// are rows, of which there is one or both; `at` and `end` the measures that it goes from and to.
function passagesOf(lesson, index) {
  const { way } = lesson.frames[index];
  const [before, now] = [lesson.lists[index - 1], lesson.lists[index]];
  const passages = [];
  let [a, b] = [-1, -1];
  for (let i = 0; i < way.length; ) {
    const word = way[i++];
    if (word < 0) {
      const first = way[i++];
      for (let k = 0; k < -word; k++) passages.push({ to: now[first + k], still: true });
      continue;
    }
    const [ofBefore, ofNow, move, fade, leaves, isPut] = lesson.kinds[word];
    const passage = { move, fade, leaves };
    if (ofBefore) passage.from = before[(a += way[i++])];
    if (ofNow) passage.to = now[(b += way[i++])];
    passages.push(settled(lesson, passage, isPut ? lesson.places[way[i++]] : null));
  }
  return passages;
}

function settled(lesson, passage, place) {
  const [from, to] = [passage.from, passage.to].map((row) => row !== undefined && lesson.shape(row));
  if (from && to) {
    passage.at = from.kind === KIND.line ? turned(from.at, to.at) : from.at;
    passage.end = to.at;
  } else {
    const own = (from || to).at;
    const other = place ? put(from || to, place) : own;
    [passage.at, passage.end] = passage.leaves ? [own, other] : [other, own];
  }
  return passage;
}

// A line has no first end: it goes the shorter way.
function turned(from, to) {
  const way = ([x1, y1, x2, y2]) =>
    Math.hypot(x1 - to[0], y1 - to[1]) + Math.hypot(x2 - to[2], y2 - to[3]);
  const other = [from[2], from[3], from[0], from[1]];
  return way(other) < way(from) ? other : from;
}

// How far a beat is at `t` of a change, 0 ... 1.
function progress(lesson, beat, t, motion) {
  const [from, to, eased] = lesson.beats[motion][beat];
  if (to <= from) return 1;
  const x = Math.min(1, Math.max(0, (t - from) / (to - from)));
  return eased ? x * x * x * (x * (6 * x - 15) + 10) : x;
}
