// Damaged texts and wild hands for the page's engine: it answers each of them in time, and
// afterwards runs a good text as if nothing had been.
// Usage: node hostile.cjs ENGINE SCENARIOS COUNT SEED [FIRST], where FIRST is the number of a case to begin with
const fs = require("fs");
const path = require("path");
const { Worker, isMainThread, parentPort, workerData } = require("worker_threads");
const { Engine } = require("./engine.cjs");

const SECONDS = 10; // for a question; what takes longer is told, and the engine made anew
const EVERY = 10; // cases, then the good text
const GOOD = "ghost_quadtree.toml";

// --- dice ---

class Dice {
  constructor(...seeds) {
    this.state = seeds.reduce((all, seed) => Math.imul(all ^ seed, 0x9e3779b1) ^ (all >>> 15), 0x1234567);
  }
  part() {
    this.state = (this.state + 0x6d2b79f5) | 0;
    let t = Math.imul(this.state ^ (this.state >>> 15), 1 | this.state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  }
  below(n) {
    return Math.floor(this.part() * n);
  }
  between(low, high) {
    return low + this.part() * (high - low);
  }
  of(list) {
    return list[this.below(list.length)];
  }
}

// --- damage ---

const NUMBERS = ["1e308", "-1e308", "5e-324", "nan", "inf", "-inf", "-0.0", "0", "-1", "1e999", "2.5", "1e9", "100000",
  "9223372036854775807", "-9223372036854775808", "4294967296", "2147483648", "1e-9", "0x7f", "100"];
const WILD = [...NUMBERS, "[]", "{}", '""', "true", "[[]]", "[[], []]", "[0, 0]", "[1, 2, 3]", '["a"]', "[nan, 0]", "[[1, 2]]",
  "{ a = 1 }", "1979-05-27T07:32:00Z", "[1e-300, 1e-300]", '"\\u0000"', '"\\u009b"', '"</script>"', "[1e18, 1e18]"];
const LETTERS = ["</script>", "\0", "\ud83d", "\u202e", "\ufeff", "'", '"', '"""', "[", "]", "{", "}", "=", "#", "\r", "\n", ".", "\\", "<!--", "{pairs:"];

const cutIn = (dice, text) => [dice.below(text.length + 1), dice.below(text.length + 1)].sort((a, b) => a - b);
const inLines = (change) => (dice, text) => {
  const lines = text.split("\n");
  change(dice, lines, () => dice.below(lines.length));
  return lines.join("\n");
};
// One of what is found, in other words.
function anotherOne(dice, text, pattern, words) {
  const found = [...text.matchAll(pattern)];
  if (found.length === 0) return text;
  const { index, 0: old } = dice.of(found);
  return text.slice(0, index) + words(old) + text.slice(index + old.length);
}
// Values and numbers are more often those that leave a text that can be read.
const anotherNumber = (dice, text) =>
  anotherOne(dice, text, /(?<![\w.])-?\d[\d.]*(?![\w.])/g, (old) =>
    dice.part() < 0.5 ? dice.of(NUMBERS) : String(dice.of([old * 10, old * 1000, old / 100, -old, +old + 1, old - 1])));
const anotherValue = (dice, text) => anotherOne(dice, text, /(?<=^\w+ *= *)\S.*$/gm, () => dice.of(WILD));

const DAMAGES = {
  cut: (dice, text) => text.slice(0, dice.below(text.length)),
  hole: (dice, text) => ((between) => text.slice(0, between[0]) + text.slice(between[1]))(cutIn(dice, text)),
  piece: (dice, text) => text.slice(...cutIn(dice, text)),
  letters: (dice, text) => ((at) => text.slice(0, at) + dice.of(LETTERS) + text.slice(at))(dice.below(text.length + 1)),
  "lines doubled": inLines((dice, lines, any) => {
    const first = any();
    lines.splice(any(), 0, ...lines.slice(first, first + 1 + dice.below(12)));
  }),
  "lines swapped": inLines((dice, lines, any) => {
    const [a, b] = [any(), any()];
    [lines[a], lines[b]] = [lines[b], lines[a]];
  }),
  "lines out": inLines((dice, lines, any) => lines.splice(any(), 1 + dice.below(6))),
  "another's lines": (dice, text, other) =>
    inLines((_, lines, any) => {
      const theirs = other.split("\n");
      const first = dice.below(theirs.length);
      lines.splice(any(), dice.below(8), ...theirs.slice(first, first + 1 + dice.below(20)));
    })(dice, text),
  number: anotherNumber,
  "number ": anotherNumber,
  value: anotherValue,
  "value ": anotherValue,
  // Of another key, so that its type is often right.
  "value of another": (dice, text, other) =>
    anotherOne(dice, text, /(?<=^\w+ *= *)\S.*$/gm, () => dice.of(other.match(/(?<=^\w+ *= *)\S.*$/gm) ?? ["1"])),
  key: (dice, text, other) =>
    anotherOne(dice, text, /^\w+(?= *=)/gm, (old) => (dice.part() < 0.3 ? old + "s" : dice.of(other.match(/^\w+(?= *=)/gm) ?? ["x"]))),
  heading: (dice, text, other) =>
    anotherOne(dice, text, /^\[.*\]/gm, (old) => dice.of([`[${old}]`, "[[[[x]]]]", "[a.b.c.d.e]", ...(other.match(/^\[.*\]/gm) ?? [])])),
  nesting: (dice, text) => {
    const [open, close] = dice.of([["[", "]"], ["{ a = ", " }"], ["a.", ""], ["(", ")"]]);
    const deep = dice.of([10, 100, 255, 300, 5000, 200000]);
    return anotherOne(dice, text, /(?<== *)\S.*$/gm, (old) => open.repeat(deep) + old + close.repeat(dice.of([0, deep])));
  },
  "many tables": (dice, text) => text + "\n" + (dice.of(text.match(/^\[\[[^[]*/gm) ?? [""]) + "\n").repeat(dice.of([2, 50, 3000])),
};

// --- cases ---

// A case: a text with its damage, and what is asked of it; or a good one, and wild hands.
function caseOf(seed, number, texts) {
  const dice = new Dice(seed, number);
  const [name, other] = [dice.of(Object.keys(texts)), dice.of(Object.keys(texts))];
  const told = { name, what: "hands", text: texts[name], lesson: texts[name], number };
  if (dice.part() < 0.25) return told;
  const kinds = Object.keys(DAMAGES);
  told.what = "";
  do {
    const kind = dice.of(kinds);
    told.text = DAMAGES[kind](dice, told.text, texts[other]);
    told.what += `${told.what && ", "}${kind.trim()}`;
  } while (dice.part() < 0.3);
  told.halfLetter = dice.part() < 0.05; // UTF-8 that breaks off, or a request that does
  return told;
}

const PLACES = [0, 1, -1, 800, 450, 2000, -5000, 1e9, -1e300, 1e300, 1e-300, NaN, "x", [], 2 ** 53];

function* wildQuestions(dice, opened, beside) {
  const frame = () => (dice.part() < 0.9 ? dice.below(opened.frames) : dice.of([-1, opened.frames, 1e99, 2 ** 32, 0.5, "0", null]));
  const place = () => (dice.part() < 0.7 ? dice.between(-200, 2200) : dice.of(PLACES));
  const index = dice.below(opened.frames);
  const { facts = [[]] } = yield { do: "frame", index };
  const entities = ["", "body/nobody", "body/", "x/body/y", "pair/a|b", "corner/0/0"];
  for (const { name, bodies = [], textures = [] } of facts[0])
    for (const [, called] of [...bodies, ...textures]) entities.push(...Array(3).fill(`${name && name + "/"}body/${called}`));
  const { controls = [] } = yield { do: "controls" };
  const paths = [...controls.map((one) => one.path), "body[0].position", "body[9].radius", "step[0].do", "", "a[", "x.y.z", "level.loops[0][0]", "world.\u{1f47b}", "a.".repeat(6000) + "b"];
  for (let turns = 2 + dice.below(5); turns > 0; turns--) {
    yield { do: "grab", frame: dice.part() < 0.8 ? index : frame(), entity: dice.of(entities), x: place(), y: place() };
    for (let i = dice.below(4); i > 0; i--)
      yield { do: "drag", x: place(), y: place(), turn: dice.part() < 0.5 ? 0 : place(), vx: dice.part() < 0.7 ? 0 : place(), vy: 0 };
    if (dice.part() < 0.3) yield { do: "fly" };
    const { text } = yield dice.of([{ do: "add", frame: frame() }, { do: "remove", frame: frame(), entity: dice.of(entities) },
      { do: "set", path: dice.of(paths), value: dice.of([...WILD, "1 # x", "1\n[x]", '"a'])}]);
    if (text !== undefined && dice.part() < 0.5) {
      const again = yield { do: "open", text, name: "set.toml", ...beside };
      if (again.refused === undefined) yield { do: "frame", index: dice.below(again.frames) };
    }
    yield { do: dice.of(["svg", "svg", "facts", "frame", "nothing", 7, null]), index: frame(), width: dice.of([1600, 1600, 1, 0, -1, 64, 40000, 1e12, "x"]), height: dice.of([900, 900, 1, 0, -5, 1e9]) };
  }
}

const wordsAt = (dice, text) => ({ do: "complete", text, line: dice.of([dice.below(text.split("\n").length) + 1, 0, -1, 2 ** 31 - 1, 1e99]), column: dice.of([1, dice.below(40), 0, -7, 2 ** 31 - 1]) });

// All that is asked; answers come back in.
function* questionsOf({ name, what, text, lesson, number, halfLetter }, seed) {
  const dice = new Dice(seed, number, 7);
  const beside = dice.part() < 0.5 ? {} : { lesson, width: dice.of([900, 900, 900, 20, 1e12]), height: 1200 };
  const opened = yield { do: "open", text, name, ...beside };
  if (halfLetter) {
    const bytes = Buffer.from(JSON.stringify({ do: "open", text: text + "é", name }));
    const at = bytes.lastIndexOf(0xc3);
    yield dice.part() < 0.5 ? bytes.subarray(0, dice.below(bytes.length)) : Buffer.concat([bytes.subarray(0, at + 1), bytes.subarray(at + 2)]);
  }
  yield wordsAt(dice, text);
  if (opened.refused !== undefined) return;
  if (what === "hands") return yield* wildQuestions(dice, opened, beside);
  yield { do: "lesson" };
  yield { do: "controls" };
  yield { do: "facts", index: dice.below(opened.frames) };
  yield { do: "svg", index: dice.below(opened.frames), width: 1600, height: 900 };
}

// Without the text, which the case has.
const shown = (question) => (question instanceof Uint8Array ? `${question.length} bytes` : JSON.stringify({ ...question, text: question.text && "…", lesson: question.lesson && "…" }).slice(0, 200));

// An answer is what was asked for, or says why not.
function requireSound(question, answer) {
  if (answer.refused !== undefined) {
    if (!(answer.refused.length > 0 && typeof answer.said === "string")) throw new Error("refused without a reason");
    for (const { severity, message, line, column } of answer.refused)
      if (severity !== "error" || !message || !(line >= 0 && column >= 0)) throw new Error(`a reason that says nothing, ${line}:${column} ${message}`);
    return "refused";
  }
  const wanted = { open: "frames", lesson: "lesson", frame: "lesson", grab: "grabbed", drag: "lesson", fly: "frames", add: "entity", remove: "text", set: "text", controls: "controls", complete: "words", facts: "facts", svg: "svg" };
  if (answer[wanted[question.do]] === undefined) throw new Error(`'${question.do}' has the answer ${JSON.stringify(answer).slice(0, 200)}`);
  if (question.do === "lesson" && !(answer.hashes.length > 0)) throw new Error("a lesson without frames");
  if (question.do === "facts") JSON.parse(answer.facts);
  return "answered";
}

// --- in the worker: the engine ---

async function work({ module, seed, good }) {
  let engine = await Engine.start(module);
  const goodHashes = () => {
    engine.ask({ do: "open", text: good, name: GOOD });
    return engine.ask({ do: "lesson" }).hashes.join();
  };
  const fresh = goodHashes();
  let cases = 0;
  parentPort.on("message", async (one) => {
    const result = { number: one.number, answered: 0, refused: 0, slowest: 0 };
    let question = {};
    try {
      const questions = questionsOf(one, seed);
      let answer;
      for (;;) {
        const next = questions.next(answer);
        if (next.done) break;
        question = next.value;
        parentPort.postMessage({ asks: shown(question) });
        const start = performance.now();
        answer = question instanceof Uint8Array ? engine.askBytes(question) : engine.ask(question);
        const took = performance.now() - start;
        if (took > result.slowest) Object.assign(result, { slowest: took, slowestAsks: shown(question) });
        result[question instanceof Uint8Array ? "refused" : requireSound(question, answer)] += 1;
        if (question.do === "open") result.ran ||= answer.refused === undefined;
      }
      if (++cases % EVERY === 0 && goodHashes() !== fresh) throw new Error("the good text has other frames than before");
    } catch (error) {
      result.failed = `${error}`.split("\n")[0];
      result.said = engine.words;
      result.stack = (error.stack ?? "").split("\n").filter((line) => line.includes("wasm")).slice(0, 12).join("\n");
      result.question = shown(question);
      result.memory = engine.bytes();
      engine = await Engine.start(module);
    }
    result.memory ??= engine.bytes();
    parentPort.postMessage({ result });
  });
  parentPort.postMessage({ ready: true });
}

// --- in the program ---

class Bench {
  constructor(data) {
    this.data = data;
  }
  async start() {
    this.worker = new Worker(__filename, { workerData: this.data, resourceLimits: { stackSizeMb: 1 } }); // a stack as in browsers
    await new Promise((ready, fail) => this.worker.once("message", ready).once("error", fail));
  }
  // The result of a case; of one that is late, that.
  async run(one, seconds = SECONDS) {
    if (!this.worker) await this.start();
    return new Promise((done) => {
      let [asks, clock] = ["", null];
      const end = async (result, broken) => {
        clearTimeout(clock);
        for (const event of ["error", "message"]) this.worker.removeAllListeners(event);
        if (broken) {
          await this.worker.terminate();
          this.worker = null;
        }
        done(result);
      };
      this.worker.on("error", (error) => end({ number: one.number, failed: `the Worker: ${error}`, question: asks, said: "", stack: "" }, true));
      this.worker.on("message", (told) => {
        clearTimeout(clock);
        if (told.result) return end(told.result, false);
        asks = told.asks;
        clock = setTimeout(() => end({ number: one.number, late: asks }, true), 1000 * seconds);
      });
      this.worker.postMessage(one);
    });
  }
}

// The fewest lines, then letters, that still fail alike.
async function smallest(bench, one, isAlike) {
  const end = performance.now() + 60_000;
  let pieces = one.text.split("\n");
  for (const glue of ["\n", ""]) {
    if (glue === "") pieces = [...pieces.join("\n")];
    if (pieces.length > 3000) break;
    for (let size = pieces.length >> 1; size >= 1; size >>= 1)
      for (let at = 0; at < pieces.length && performance.now() < end; ) {
        const fewer = [...pieces.slice(0, at), ...pieces.slice(at + size)];
        if (isAlike(await bench.run({ ...one, text: fewer.join(glue) }))) pieces = fewer;
        else at += size;
      }
    one = { ...one, text: pieces.join(glue) };
  }
  return one.text;
}

async function main([wasm, scenarios, count = "1000", seed = "1", first = "0"]) {
  const texts = {};
  for (const file of fs.readdirSync(scenarios).filter((name) => name.endsWith(".toml")).sort())
    texts[file] = fs.readFileSync(path.join(scenarios, file), "utf8");
  const module = await WebAssembly.compile(fs.readFileSync(wasm));
  const bench = new Bench({ module, seed: Number(seed), good: texts[GOOD] });
  const all = { cases: 0, ran: 0, answered: 0, refused: 0, late: 0, failed: 0 };
  const seen = new Set(); // failures by what they say
  let [slowest, memory] = [{ slowest: 0 }, 0];
  for (let number = Number(first); number < Number(first) + Number(count); number++) {
    const one = caseOf(Number(seed), number, texts);
    const result = await bench.run(one);
    const called = `case ${number}, ${one.name}, ${one.what}`;
    all.cases += 1;
    for (const key of ["answered", "refused"]) all[key] += result[key] ?? 0;
    all.ran += result.ran ? 1 : 0;
    memory = Math.max(memory, result.memory ?? 0);
    if (result.slowest > slowest.slowest) slowest = { ...result, called };
    if (result.late !== undefined) {
      all.late += 1;
      console.log(`LATE ${called}: ${result.late} takes more than ${SECONDS} s`);
    }
    if (result.failed !== undefined) {
      all.failed += 1;
      console.log(`FAILED ${called}: ${result.failed}\n  at ${result.question}, with ${(result.memory / 2 ** 20).toFixed(0)} MB\n${result.said}${result.stack}`);
      const kind = result.failed + result.said;
      if (one.what !== "hands" && !seen.has(kind)) {
        seen.add(kind);
        const text = await smallest(bench, one, (r) => r.failed === result.failed && r.said === result.said);
        console.log(`  with this text of ${text.length} letters, said to be ${one.name}:\n${text.slice(0, 3000)}\n---`);
      }
    }
    if (process.env.KEEP && (result.late !== undefined || result.failed !== undefined)) fs.writeFileSync(path.join(process.env.KEEP, `${seed}_${number}.toml`), one.text);
  }
  console.log(`${Object.entries(all).map(([what, n]) => `${n} ${what}`).join(", ")}; at most ${(memory / 2 ** 20).toFixed(0)} MB`);
  console.log(`slowest answer: ${slowest.slowestAsks} ${(slowest.slowest / 1000).toFixed(1)} s, ${slowest.called}`);
  await bench.worker?.terminate();
  if (all.cases === 0 || all.failed > 0) process.exitCode = 1;
}

if (isMainThread)
  main(process.argv.slice(2)).catch((error) => {
    console.error(error);
    process.exitCode = 1;
  });
else work(workerData);
