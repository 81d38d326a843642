// A live page: the engine in a Worker draws what the reader's hand, the controls and the text make
// of the scenario, in the place of the lesson as it was recorded.

const MOST_LETTERS = 1 << 20; // of a text in an address

class Live {
  // `scene`: what the engine has told of the text that it has opened.
  constructor(page, engine, scenario, scene, recorded) {
    Object.assign(this, { page, engine, scene, waiting: new Map(), sheet: sheet() });
    this.begin(scenario, recorded);
    engine.first = () => this.opening(this.good);
    this.editor = new Editor(this);
    this.controls = new Controls(this);
    this.hand = new Hand(this);
    this.listen();
  }

  // `drawn`: the lesson's own frames, if they are there.
  begin({ name, text }, drawn = null) {
    Object.assign(this, { name, text, good: text, own: { text, drawn, isOfSheet: Boolean(drawn) }, past: [], future: [], cause: null });
    for (const kept of document.querySelectorAll("#words .kept")) kept.remove();
    if (drawn) this.keepRoom();
  }

  // The room for the lesson's words stays where a world of one's own has fewer: nothing jumps.
  keepRoom() {
    if (document.querySelector("#words .kept")) return;
    for (const spare of document.querySelectorAll("#words .spare")) spare.classList.add("kept");
  }

  listen() {
    const acts = {
      undo: () => this.undo(), redo: () => this.redo(), again: () => this.again(),
      change: () => this.toggle("change"), text: () => this.toggle("text"),
      download: () => this.download(), link: () => this.copyLink(),
    };
    for (const [id, act] of Object.entries(acts)) $(id).addEventListener("click", act);
    KEYS.c = acts.change;
    KEYS.t = acts.text;
    document.addEventListener("keydown", (event) => {
      const key = event.key.toLowerCase();
      if (!(event.ctrlKey || event.metaKey) || !(key === "z" || key === "y")) return;
      event.preventDefault();
      key === "y" || event.shiftKey ? this.redo() : this.undo();
    });
    $("live-panel").addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.target === $("source")) event.stopPropagation();
      if (event.key === "Escape" && !event.defaultPrevented) this.close();
    });
    window.addEventListener("hashchange", () => this.openLink());
    UPRIGHT.addEventListener("change", () => {
      [this.sheet, this.own.isOfSheet] = [sheet(), false];
      this.soon("run", () => this.run({ index: this.page.index }));
    });
    const facts = $("facts-panel"); // it stands in the same place
    new MutationObserver(() => facts.hidden || this.close()).observe(facts, { attributeFilter: ["hidden"] });
  }

  // --- one thing at a time

  // Of what waits the newest of each kind is done, and nothing is done at once with another.
  soon(kind, act) {
    this.waiting.delete(kind);
    this.waiting.set(kind, act);
    return (this.working ??= this.work());
  }

  async work() {
    for (const [kind, act] of this.waiting) {
      this.waiting.delete(kind);
      try {
        await act();
      } catch (error) {
        this.say(error.message);
        if (!(error instanceof Ended)) console.error(error);
      }
    }
    this.working = null;
  }

  // --- the text

  change(text, cause, shown) {
    this.take(text, cause);
    return this.soon("run", () => this.run(shown));
  }

  // Changes of one cause in a row are undone as one.
  take(text, cause) {
    if (text === this.text) return;
    const now = performance.now();
    if (cause !== this.cause || now > this.lastly + 1000) this.past.push([this.text, this.page.index, cause]);
    [this.cause, this.lastly, this.future] = [cause, now, []];
    this.become(text);
  }

  undo() {
    this.turnTo(this.past, this.future);
  }
  redo() {
    this.turnTo(this.future, this.past);
  }
  turnTo(from, to) {
    this.editor.flush();
    if (!from.length) return;
    const [text, index, cause] = from.pop();
    to.push([this.text, this.page.index, cause]);
    this.cause = null;
    this.become(text);
    this.soon("run", () => this.run(cause === "hand" ? { index } : {}));
  }

  // To the frame in which it was left.
  again() {
    this.say("");
    const [, index] = this.past.findLast(([text]) => text === this.own.text) ?? [];
    this.change(this.own.text, "again", { index });
  }

  become(text) {
    this.page.behind = "";
    this.text = text;
    this.editor.show(text);
    this.mark();
  }

  // The world is the reader's own, or the lesson's.
  mark(text = this.text) {
    const isOwn = text === this.own.text;
    document.documentElement.classList.toggle("own-world", !isOwn);
    $("own").hidden = isOwn && !this.past.length && !this.future.length;
    $("own").firstElementChild.hidden = $("again").hidden = isOwn;
    $("undo").disabled = !this.past.length;
    $("redo").disabled = !this.future.length;
  }

  // In one's own world what a hand holds is lit, in place of what the lesson points out; and what the
  // lesson says word for word need not be true there.
  opening(text) {
    const lesson = this.own.text;
    const held = text === lesson ? "" : nameOf(this.page.watched ?? "");
    return { do: "open", text, name: this.name, held, lesson, ...this.sheet };
  }

  // Refused text leaves the picture of the last good one.
  async run({ index, moment } = {}) {
    const { text, page } = this;
    const opened = await this.engine.ask(this.opening(text));
    this.editor.tell(opened.refused ?? opened.warnings, opened.unmet);
    if (opened.refused) return;
    [this.good, this.scene] = [text, opened];
    const isOwn = text === this.own.text;
    const { drawn: known, isOfSheet } = this.own;
    const drawn = isOwn && isOfSheet ? known : await this.engine.ask({ do: "lesson" });
    if (!(drawn.lesson instanceof Lesson)) drawn.lesson = new Lesson(drawn.lesson, page.lesson);
    if (isOwn) Object.assign(this.own, { drawn, isOfSheet: true });
    else this.retold(drawn);
    if (isOwn) this.hand.watch(null);
    this.paint(drawn.colours);
    if (moment) index = leadsTo(drawn.lesson, moment);
    page.load(drawn.lesson, drawn.facts, index ?? this.near(drawn.lesson));
    if (isOwn) this.keepRoom();
    const { title, questions } = drawn.card ?? { title: drawn.title, questions: questionsOf(drawn) };
    $("title").textContent = document.title = title;
    fillQuestions(page, questions, isOwn ? [] : this.questions);
    await this.controls.refresh();
  }

  // A text's own colours, in place of those that the page has come with.
  paint(colours = "") {
    this.colours ??= document.head.appendChild(element(document, "style", {}));
    this.colours.textContent = colours;
  }

  // The lesson's own.
  get questions() {
    const { drawn } = this.own;
    return drawn?.card?.questions ?? questionsOf(drawn ?? {});
  }

  // Captions were written for the lesson's world. Another one's frames are each like one of the lesson,
  // of the same place in the same step; like none where a step was added.
  retold({ lesson, facts, like }) {
    const told = this.own.drawn?.lesson.frames ?? [];
    const its = byStep(told);
    for (const [step, frames] of byStep(lesson.frames)) {
      const own = its.get(like[lesson.frames.indexOf(frames[0])][0]) ?? [];
      frames.forEach((frame, i) => (frame.like = told.indexOf(own[frames.length === own.length ? i : own.length - 1])));
    }
    lesson.frames.forEach((_, index) => this.tellOf(lesson, index, facts[index], like[index]));
  }

  // The same of one frame that is looked at in the place of the one shown.
  retoldAlone(lesson, [facts], [[step, isOwn]]) {
    const told = this.own.drawn?.lesson.frames ?? [];
    const { index, lesson: { frames } } = this.page;
    const like = frames[index].like ?? index;
    lesson.frames[0].like = told[like]?.step === step ? like : told.findLastIndex((one) => one.step === step);
    return this.tellOf(lesson, 0, facts, [step, isOwn]);
  }

  // What somebody has written for this world; or what its facts say, of the body that was moved or of
  // all, with the lesson's words beside it.
  tellOf(lesson, index, facts, [, isOwn]) {
    const [frame, { lesson: its, facts: known }] = [lesson.frames[index], this.own.drawn || {}];
    const sentence = this.hand.words.sentence(lesson, index, facts);
    if (isOwn && frame.caption) frame.beside = sentence;
    else {
      const words = its?.frames[frame.like]?.caption ?? "";
      const counts = () => countsTold(facts, known?.[frame.like], showsNodes(lesson, index));
      const caption = sentence.endsWith(gone("")) ? `${sentence} ${counts()}` : sentence || frame.caption || counts();
      const beside = words && words !== caption ? say("in the lesson: {}", words) : "";
      Object.assign(frame, { caption, beside, isTold: true, ending: false });
    }
    return lesson;
  }

  // Why neither hand nor controls can change the text.
  get broken() {
    return this.text !== this.good && say("The text has a mistake: correct it, or undo it, first.");
  }

  // The frame of another run that is nearest to the one shown: of the same step, as far along.
  near(lesson) {
    const { frames } = this.page.lesson;
    const { index } = this.page;
    const of = (list) => list.flatMap(({ step }, i) => (step === frames[index].step ? [i] : []));
    const [before, now] = [of(frames), of(lesson.frames)];
    const at = before.indexOf(index);
    return (at === before.length - 1 ? now.at(-1) : now[Math.min(at, now.length - 1)]) ?? lesson.last;
  }

  // Whether time passes after the frame that is shown.
  get passes() {
    const { frames, last } = this.page.lesson;
    return frames[last].time > frames[this.page.index].time;
  }

  // The facts of all frames of a text, with all that it says.
  async runAll(text) {
    await this.working;
    const { frames, refused } = await this.engine.ask({ do: "open", text, name: this.name });
    const all = [];
    for (let index = 0; index < frames; index++)
      all.push(JSON.parse((await this.engine.ask({ do: "facts", index })).facts));
    await this.change(text, "run");
    if (refused) throw new Error(this.editor.told || $("hint").textContent);
    return all;
  }

  say(words) {
    $("hint").textContent = words;
    $("hint").hidden = !words;
    clearTimeout(this.saying);
    this.saying = setTimeout(() => ($("hint").hidden = true), 6000);
  }

  // --- the panel

  toggle(part) {
    const opens = $(`${part}-part`).hidden;
    if (opens && !$("facts-panel").hidden) this.page.toggleFacts();
    if (opens && matchMedia("(max-width: 50rem), (max-height: 28rem)").matches) this.close(); // there is room for one
    $(`${part}-part`).hidden = !opens;
    $("live-panel").hidden = $("change-part").hidden && $("text-part").hidden;
    for (const name of ["aria-pressed", "aria-expanded"]) $(part).setAttribute(name, opens);
    if (!opens && $(`${part}-part`).contains(document.activeElement)) $(part).focus();
    if (opens && part === "change") this.soon("controls", () => this.controls.refresh());
    if (opens && part === "text") this.editor.reveal();
    this.page.words.fit();
  }

  close() {
    for (const part of ["change", "text"]) if (!$(`${part}-part`).hidden) this.toggle(part);
  }

  // --- taking it along

  download() {
    const href = URL.createObjectURL(new Blob([this.text]));
    const link = element(document, "a", { href, download: this.name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
  }

  // The changed text stands in the address, behind the frame.
  async copyLink() {
    const stream = new Blob([this.text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const letters = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
    this.link(`&t=${letters.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`);
    try {
      await navigator.clipboard.writeText(location.href);
      this.say(say("The link is copied."));
    } catch {
      this.say(say("The link is in the address bar."));
    }
  }

  link(behind) {
    this.linked = this.page.behind = behind;
    this.page.tell();
  }

  async openLink() {
    const { behind, index } = this.page;
    const [, packed] = behind.match(/^&t=([\w-]+)$/) ?? [];
    if (!packed || behind === this.linked) return;
    try {
      await this.change(await unpackedLink(packed), "link", { index });
      this.link(behind);
    } catch {
      this.say(say("The text in this link is damaged."));
    }
  }
}

async function unpackedLink(packed) {
  const bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const reader = stream.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (let part = await reader.read(); !part.done; part = await reader.read())
    if ((text += part.value).length > MOST_LETTERS) throw new Error("too long");
  return text;
}

function byStep(frames) {
  const steps = new Map();
  for (const frame of frames) steps.has(frame.step) ? steps.get(frame.step).push(frame) : steps.set(frame.step, [frame]);
  return steps;
}

const leadsTo = ({ frames, last }, { step, time }) => {
  const found = frames.findIndex((frame) => frame.step >= step && frame.time >= time - 1e-6);
  return found < 0 ? last : found;
};

const questionsOf = ({ questions = [] }) =>
  questions.map(([asked, answer, frame, predict]) => ({ asked, answer, frame, predict }));

// --- a page of many scenarios

// The course's parts, each from one place in the lecture on.
const PARTS = [[1, "Why a broad phase"], [4, "Binary space partitioning and quadtrees"], [8, "Nodes and their memory"],
  [13, "What stands still, what sleeps"], [16, "Octrees and kD-trees"], [20, "Levels and views"],
  [26, "The narrow phase"], [30, "The lecture’s code"], [33, "Physics"], [41, "Other structures"]];
const partOf = ({ lecture }) => (lecture === null ? "More" : PARTS.findLast(([first]) => lecture >= first)[1]);

function fillChoice(live, scenarios) {
  const list = $("scenario-list");
  const groups = new Map();
  scenarios.forEach((scenario, i) => listIn(groups, partOf(scenario)).push(i));
  const option = (i) => element(document, "option", { value: i, text: [scenarios[i].lecture, scenarios[i].title || scenarios[i].name].filter(Boolean).join(" ") });
  list.replaceChildren(...[...groups].map(([label, members]) => element(document, "optgroup", { label, children: members.map(option) })));
  list.hidden = false;
  list.addEventListener("change", () => {
    live.begin(scenarios[list.value]);
    live.become(live.text);
    live.soon("run", () => live.run({ index: 0 }));
  });
}

async function startLive(page) {
  document.documentElement.dataset.live = "loading";
  const scenarios = JSON.parse(textIn("scenarios") ?? "[]");
  const scene = await engine.started;
  if (scene.refused) throw new Error(scene.refused[0].message);
  $("facts").before($("live-buttons").content);
  $("place").before($("live-marks").content);
  $("help-dialog").querySelector("dl").append($("live-keys").content);
  const { lesson, facts } = page;
  // All frames, and as large as the engine draws them: else those are not what a hand would move.
  const isRecorded = scene.frames === lesson.frames.length && `${scene.page}` === `${lesson.page}`;
  const card = JSON.parse(textIn("card") ?? "{}");
  const live = new Live(page, engine, firstScenario, scene, isRecorded && { lesson, facts, card });
  page.live = live;
  page.run = (text) => live.runAll(text);
  if (scenarios.length) fillChoice(live, scenarios);
  if (isRecorded) fillQuestions(page, card.questions);
  else await live.run({ index: scenarios.length ? 0 : undefined });
  document.documentElement.dataset.live = "ready";
  live.openLink();
  live.hand.invite();
  engine.ask({ do: "frame", index: 0 }); // what draws is compiled before a hand needs it
}

opened.then(startLive).catch((error) => {
  document.documentElement.dataset.live = "off"; // what was recorded is there all the same
  if (!$("caption").textContent) $("caption").textContent = say("The engine cannot run here: {}", error.message);
  console.warn(error);
});
