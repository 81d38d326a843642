// What a live page says of a frame of the reader's own world, from its facts alone.

const COUNTS = ["pairs", "leaves", "entries", "textures", "refused", "awake"];
const MEASURES = ["gap", "overlap", "distance"];
const GONE = " has left the world.";
const FEW = 4; // names that a sentence has room for
const FIRST_COLOR = 14; // the role of body colour 1, of draw/theme.hpp
const COLORS = ["red", "pink", "yellow", "blue", "green", "light blue", "orange", "violet"];

class HandWords {
  constructor(hand) {
    this.hand = hand;
  }

  // What a frame's facts say of the body that is watched: where it is stored, and its pairs. Of two
  // sides, what both say.
  sentence(lesson, index, sides) {
    const { watched } = this.hand.page;
    if (!watched) return "";
    const own = sides.filter(({ name }) => sides.length < 3 || name === sideOf(watched));
    const told = own.map((facts) => this.told(lesson, index, facts, entity(facts.name, "body", nameOf(watched)), own.length > 1));
    return told.map((words, i) => (words && own.length > 1 ? `${own[i].title.split(":")[0]}: ${words}` : words)).filter(Boolean)
      .map(asSentence).join(" ");
  }

  told(lesson, index, facts, one, isShort) {
    const name = nameOf(one);
    const texture = facts.textures.find(([, known]) => known === name);
    const refused = facts.textures.flatMap(([, other, , , isRefused]) => (isRefused && other !== name ? [other] : []));
    const without = refused.length ? ` There is no room for ${listed(refused)}.` : "";
    if (texture) return `${name} is ${texture[2]} × ${texture[3]}${texture[4] ? ", and is refused" : ""}.${without}`;
    const body = facts.bodies.find(([, known]) => known === name);
    if (!body) return "";
    const texts = lesson.lists[index].map((row) => lesson.shape(row)).filter(({ kind }) => kind === KIND.text);
    const named = new Set(texts.map(({ key }) => lesson.keys[key]).flatMap(([key, one]) => (/(^|\/)world\/name\//.test(key) ? [nameOf(one)] : [])));
    const written = new Set(texts.flatMap(({ key, text }) => (/(name|node)\//.test(lesson.keys[key][0]) ? [lesson.texts[text][0]] : [])));
    const called = named.has(name) ? name : this.looksOf(one, lesson, index) ?? `the body you ${this.hand.deed}`;
    if (body[4] === "outside") return called + GONE;
    const side = new Relations(facts);
    const stored = showsNodes(lesson, index) ? this.stored(side.leavesWith(name), this.hand.boxOf(one, lesson, index), written, facts.leaf) : "";
    const all = new Map(facts.counts).get("pairs");
    const others = side.pairs.flatMap((pair) => (pair.includes(name) ? pair.filter((other) => other !== name) : []));
    const shares = all === undefined || all !== side.pairs.length ? "" : shareOf(others.length, all);
    const where = shares + (shares && others.length && !isShort && others.every((one) => named.has(one)) ? `, with ${listed(others)}` : "");
    if (isShort && stored) return `${called} ${stored}${where && `, ${where}`}.`;
    return [stored && `${called} ${stored}.`, where && `${stored ? "It" : called} is ${where}.`].filter(Boolean).join(" ");
  }

  // "the yellow box", where no other body has its colour.
  looksOf(one, lesson, index) {
    const colors = new Map();
    for (const { key, kind, style, at } of lesson.lists[index].map((row) => lesson.shape(row))) {
      const [name, whose] = lesson.keys[key];
      const color = COLORS[lesson.styles[style][0] - FIRST_COLOR];
      if (!color || kind === KIND.text || !/(^|\/)world\/body\//.test(name)) continue;
      const isBox = kind === KIND.rect ? at[4] < at[2] / 2 : kind === KIND.polygon && at.length === 8;
      listIn(colors, color).push([whose, isBox]);
    }
    const [color, looks] = [...colors].find(([, looks]) => looks.some(([whose]) => whose === one)) ?? [];
    if (!color || looks.some(([whose]) => whose !== one)) return null;
    return `the ${color} ${looks.length === 1 && looks[0][1] ? "box" : "body"}`;
  }

  // `written`: the names that are drawn, so that no leaf has one that nobody can find.
  stored(leaves, box, written, word) {
    const labels = leaves.map(({ label }) => label).filter(Boolean);
    const named = labels.length === leaves.length && labels.length <= FEW && labels.every((label) => written.has(label)) ? ` ${listed(labels)}` : "";
    if (!leaves.length) return "";
    if (leaves.length === 1) return named === " root" ? "is stored in the root" : `is stored in ${named ? `${word[0]}${named}` : `one ${word[0]}`}`;
    const lies = leaves.every(({ outline }) => isBox(outline) && meets(boxAround(outline), box));
    const how = leaves.length === 2 ? "both" : `all ${leaves.length}`;
    return lies ? `lies across ${named ? "" : `${leaves.length} `}${word[1]}${named} and is stored in ${how}`
      : `is stored in ${leaves.length} ${word[1]}${named && `,${named}`}`;
  }
}

const listed = (names) => names.length > FEW ? `${names.slice(0, FEW - 1).join(", ")} and ${names.length - FEW + 1} more`
  : names.length > 1 ? `${names.slice(0, -1).join(", ")} and ${names.at(-1)}` : names[0];

const asSentence = (words) => words[0].toUpperCase() + words.slice(1);

// So many of what a word in the plural names.
const singular = (word) => word.replace(/ves$/, "f").replace(/ies$/, "y").replace(/(..)s$/, "$1");
const counted = (n, word) => `${n} ${n === 1 ? singular(word) : word}`;

// What a frame counts, and what the lesson's frame like it did.
function countsTold(sides, before, hasNodes) {
  return sides.flatMap(({ title, counts, measures }, i) => {
    const known = new Map([...(before?.[i]?.counts ?? []), ...(before?.[i]?.measures ?? [])]);
    const all = [...counts.filter(([name, n]) => COUNTS.includes(name) && (n || name !== "refused") && (hasNodes || !/leaves|entries/.test(name))),
      ...measures.filter(([name, n]) => MEASURES.includes(name) && n)];
    if (!all.length) return [];
    const told = all.map(([name, n]) => {
      const [now, then] = [MEASURES.includes(name) ? `${name} ${n}` : counted(n, name === "pairs" ? "candidate pairs" : name), known.get(name)];
      return then === undefined || then === n ? now : `${now} (${then} in the lesson)`;
    }).join(", ");
    const isSame = known.size && !told.includes("(");
    return asSentence(`${sides.length > 1 ? `${title.split(":")[0]}: ` : ""}${told}${isSame ? ", as in the lesson" : ""}.`);
  }).join(" ");
}

// So many of all pairs, in words.
function shareOf(n, all) {
  if (all === 1) return n ? "in the only candidate pair" : "not in the only candidate pair";
  if (!n) return all ? `in none of the ${all} candidate pairs` : "in no candidate pair";
  return `in ${n < all ? `${n} of ${all}` : n === 2 ? "both" : `all ${n}`} candidate pairs`;
}

// The box around points, [x, y, x, y].
function boxAround(points) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  points.forEach((n, i) => {
    box[i % 2] = Math.min(box[i % 2], n);
    box[2 + (i % 2)] = Math.max(box[2 + (i % 2)], n);
  });
  return box;
}

const meets = (a, b) => [0, 1].every((i) => a[i] <= b[i + 2] + 1 && b[i] <= a[i + 2] + 1); // outlines are whole numbers
const isBox = (outline) => outline.length === 8 && new Set(outline.filter((_, i) => i % 2)).size === 2 &&
  new Set(outline.filter((_, i) => !(i % 2))).size === 2;
