// What a live page says of a frame of the reader's own world, from its facts alone.

const COUNTS = { pairs: "candidate pair/candidate pairs", leaves: "leaf/leaves", entries: "entry/entries",
  textures: "texture/textures", refused: "refused", awake: "awake" };
const MEASURES = ["gap", "overlap", "distance"];
const gone = (name) => say("{} has left the world.", name);
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
    const without = refused.length ? ` ${say("There is no room for {}.", listed(refused))}` : "";
    if (texture) return say(texture[4] ? "{} is {} × {}, and is refused." : "{} is {} × {}.", name, texture[2], texture[3]) + without;
    const body = facts.bodies.find(([, known]) => known === name);
    if (!body) return "";
    const texts = lesson.lists[index].map((row) => lesson.shape(row)).filter(({ kind }) => kind === KIND.text);
    const named = new Set(texts.map(({ key }) => lesson.keys[key]).flatMap(([key, one]) => (/(^|\/)world\/name\//.test(key) ? [nameOf(one)] : [])));
    const written = new Set(texts.flatMap(({ key, text }) => (/(name|node)\//.test(lesson.keys[key][0]) ? [lesson.texts[text][0]] : [])));
    const side = new Relations(facts);
    const called = named.has(name) ? side.called(name) : this.looksOf(one, lesson, index) ?? say(`the body you ${this.hand.deed}`);
    if (body[4] === "outside") return gone(called);
    const stored = showsNodes(lesson, index) ? this.stored(side.leavesWith(name), this.hand.boxOf(one, lesson, index), written, facts.leaf) : "";
    const all = new Map(facts.counts).get("pairs");
    const others = side.pairs.flatMap((pair) => (pair.includes(name) ? pair.filter((other) => other !== name) : []));
    const shares = all === undefined || all !== side.pairs.length ? "" : shareOf(others.length, all);
    const where = shares + (shares && others.length && !isShort && others.every((one) => named.has(one)) ? `, ${say("with {}", listed(others.map((one) => side.called(one))))}` : "");
    if (isShort && stored) return `${called} ${stored}${where && `, ${where}`}.`;
    return [stored && `${called} ${stored}.`, where && say("{} is {}.", stored ? say("It") : called, where)].filter(Boolean).join(" ");
  }

  // "the yellow box", where no other body has its colour.
  looksOf(one, lesson, index) {
    const colors = new Map();
    const painted = getComputedStyle(document.documentElement).getPropertyValue("--painted").split(" ").map(Number);
    for (const { key, kind, style, at } of lesson.lists[index].map((row) => lesson.shape(row))) {
      const [name, whose] = lesson.keys[key];
      const number = lesson.styles[style][0] - FIRST_COLOR;
      const color = COLORS[number];
      if (!color || painted.includes(number + 1) || kind === KIND.text || !/(^|\/)world\/body\//.test(name)) continue;
      const isBox = kind === KIND.rect ? at[4] < at[2] / 2 : kind === KIND.polygon && at.length === 8;
      listIn(colors, color).push([whose, isBox]);
    }
    const [color, looks] = [...colors].find(([, looks]) => looks.some(([whose]) => whose === one)) ?? [];
    if (!color || looks.some(([whose]) => whose !== one)) return null;
    return say(`the ${color} ${looks.length === 1 && looks[0][1] ? "box" : "body"}`);
  }

  // `written`: the names that are drawn, so that no leaf has one that nobody can find.
  stored(leaves, box, written, word) {
    const labels = leaves.map(({ label }) => labelOf(label)).filter(Boolean);
    const named = labels.length === leaves.length && labels.length <= FEW && labels.every((label) => written.has(label)) ? ` ${listed(labels)}` : "";
    if (!leaves.length) return "";
    const [one, many] = word;
    if (leaves.length === 1) return named === ` ${say("root")}` ? say("is stored in the root") : named ? say(`is stored in ${one} {}`, labels[0]) : say(`is stored in one ${one}`);
    const lies = leaves.every(({ outline }) => isBox(outline) && meets(boxAround(outline), box));
    const how = leaves.length === 2 ? say("both") : say("all {}", leaves.length);
    const where = named ? `${form(`${one}/${many}`, 100)}${named}` : counted(leaves.length, `${one}/${many}`);
    return lies ? say("lies across {} and is stored in {}", where, how)
      : `${say("is stored in {}", counted(leaves.length, `${one}/${many}`))}${named && `,${named}`}`;
  }
}

const listed = (names) => names.length > FEW ? say("{} and {} more", names.slice(0, FEW - 1).join(", "), names.length - FEW + 1)
  : names.length > 1 ? say("{} and {}", names.slice(0, -1).join(", "), names.at(-1)) : names[0];

const asSentence = (words) => words[0].toUpperCase() + words.slice(1);

// What a frame counts, and what the lesson's frame like it did.
function countsTold(sides, before, hasNodes) {
  return sides.flatMap(({ title, counts, measures }, i) => {
    const known = new Map([...(before?.[i]?.counts ?? []), ...(before?.[i]?.measures ?? [])]);
    const all = [...counts.filter(([name, n]) => name in COUNTS && (n || name !== "refused") && (hasNodes || !/leaves|entries/.test(name))),
      ...measures.filter(([name, n]) => MEASURES.includes(name) && n)];
    if (!all.length) return [];
    const told = all.map(([name, n]) => {
      const [now, then] = [MEASURES.includes(name) ? `${say(name)} ${numberSaid(n)}` : counted(n, COUNTS[name]), known.get(name)];
      return then === undefined || then === n ? now : say("{} ({} in the lesson)", now, then);
    }).join(", ");
    const isSame = known.size && !told.includes("(");
    return asSentence(`${sides.length > 1 ? `${title.split(":")[0]}: ` : ""}${isSame ? say("{}, as in the lesson", told) : told}.`);
  }).join(" ");
}

// So many of all pairs, in words.
function shareOf(n, all) {
  if (all === 1) return say(n ? "in the only candidate pair" : "not in the only candidate pair");
  if (!n) return all ? say("in none of the {} candidate pairs", all) : say("in no candidate pair");
  return n < all ? say("in {} of {} candidate pairs", n, all) : n === 2 ? say("in both candidate pairs") : say("in all {} candidate pairs", n);
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
