// What can be set by hand: sliders and lists of what this scene has; and the questions, to which a
// reader may say a number before the engine tells its own.

class Controls {
  constructor(live) {
    this.live = live;
    $("change-part").addEventListener("input", (event) => {
      const field = event.target.closest("[data-path]");
      if (field) this.set(field.dataset.path, valueIn(field));
    });
    $("change-part").addEventListener("submit", (event) => event.preventDefault());
    $("add").addEventListener("click", () => this.add());
    $("remove").addEventListener("click", () => this.remove());
  }

  add() {
    this.ask(Symbol("each press counts"), "body", () => ({ do: "add", frame: this.live.page.index }), "added");
  }

  remove() {
    const { page } = this.live;
    if (!page.watched) return this.live.say(say("Move the body that is to go: then it is the one that is meant."));
    this.ask("remove", "body", () => ({ do: "remove", frame: page.index, entity: page.watched }));
  }

  set(path, value) {
    this.ask(`set ${path}`, path, () => ({ do: "set", path, value }));
  }

  // The engine changes the text. What has come into the world is watched then, what has left it is not.
  ask(kind, cause, request, deed) {
    const { live } = this;
    live.editor.flush();
    live.soon(kind, async () => {
      if (live.broken) return live.say(live.broken);
      const { text, entity, index, refused } = await live.engine.ask(request());
      if (refused) return live.say(refused[0].message);
      if (entity) live.hand.watch(deed ? entity : null, deed);
      live.take(text, cause);
      await live.run({ index });
    });
  }

  async refresh() {
    if ($("change-part").hidden) return;
    const { controls } = await this.live.engine.ask({ do: "controls" });
    $("add").parentNode.hidden = !this.live.scene.world;
    const paths = controls.map(({ path }) => path).join();
    if (paths !== this.paths) $("fields").replaceChildren(...fieldsOf(controls));
    this.paths = paths;
    if (!controls.length) $("fields").textContent = say("Nothing here can be set by hand. The text can be changed.");
    for (const field of document.querySelectorAll("#change-part [data-path]"))
      putIn(field, controls.find(({ path }) => path === field.dataset.path), this.live.cause === field.dataset.path);
  }
}

// Each under its table's name.
function fieldsOf(controls) {
  let last;
  return controls.flatMap((control) => {
    const of = control.path.slice(0, control.path.lastIndexOf("."));
    const head = of === last ? [] : [element(document, "h2", { text: of })];
    last = of;
    return [...head, fieldOf(control)];
  });
}

function fieldOf({ path, key, means, type, least, most, step, choices, unit, value }) {
  const input = (kind, more) => element(document, "input", { type: kind, ...more });
  const coordinate = (axis) => input("number", { step: "any", "aria-label": `${key} ${axis}` });
  const option = (text) => element(document, "option", { text });
  const parts = {
    choice: () => [element(document, "select", { children: (choices ?? []).map(option) })],
    truth: () => [input("checkbox")],
    point: () => value.map((_, i) => coordinate("xyz"[i])),
  };
  const range = () => [input("range", { min: least, max: most, step: step ?? (type === "whole" ? 1 : "any") }),
    element(document, "output")];
  return element(document, type === "point" ? "fieldset" : "label", {
    "data-path": path, "data-type": type, "data-unit": unit ?? "", title: means.replaceAll("`", ""),
    children: [element(document, "b", { text: key }), ...(parts[type] ?? range)(), element(document, "small")],
  });
}

const singular = (word) => word.replace(/ves$/, "f").replace(/ies$/, "y").replace(/(..)s$/, "$1");
// What stands between backticks is code.
const coded = (words) => words.split("`").map((text, i) => (i % 2 ? element(document, "code", { text }) : text));
const withUnit = (value, unit) => (unit?.length > 2 ? `${value} ${Number(value) === 1 ? singular(unit) : unit}` : `${value} ${unit ?? ""}`);

// A choice's own words, where those of its key come to it first; or what is said of all of them.
function meaningOf({ type, means, value, choices }) {
  const own = type === "choice" && means.match(new RegExp(`(?:^|[;.] )((?:an? )?\`${value}\`:? [^;.]*)`));
  if (own) return `${asSentence(own[1])}.`;
  const first = means.match(/^.{1,140}?\.(?=\s|$)|^.*?([.:;](?=\s)|$)/)[0].replace(/[:;]$/, ".");
  return choices?.some((one) => first.startsWith(`\`${one}\``)) ? "" : first;
}

function valueIn(field) {
  const inputs = [...field.querySelectorAll("input, select")];
  const { type } = field.dataset;
  if (type === "choice") return JSON.stringify(inputs[0].value);
  if (type === "truth") return String(inputs[0].checked);
  if (type === "point") return `[${inputs.map((one) => Number(one.value)).join(", ")}]`;
  const value = String(Number(Number(inputs[0].value).toPrecision(4)));
  field.querySelector("output").textContent = withUnit(value, field.dataset.unit);
  return value;
}

function putIn(field, control, isSetting) {
  const { type, value, unit } = control;
  field.querySelector("small").replaceChildren(...coded(meaningOf(control)));
  const inputs = [...field.querySelectorAll("input, select")];
  if (field.contains(document.activeElement) && type === "point") return; // it is being typed
  const output = field.querySelector("output");
  if (output) output.textContent = withUnit(value, unit);
  if (type === "truth") inputs[0].checked = value;
  else if (type === "point") value.forEach((n, i) => (inputs[i].value = n));
  else if (!isSetting || inputs[0].type !== "range") inputs[0].value = value;
}

// --- questions: say first, then look

// A question that has `predict`, a count's name, shows its answer when the reader has said a number.
// What the lesson answered in these words need not hold of a world that is the reader's own.
function fillQuestions(page, questions, known = []) {
  for (const old of $("question-dialog").querySelectorAll("details")) old.remove();
  $("question-dialog").prepend(...questions.map((question) => {
    const { asked, answer, frame, predict } = question;
    const link = element(document, "a", { href: `#${frame}`, text: say("Look at it.") });
    link.addEventListener("click", (event) => { event.preventDefault(); page.go(frame); });
    const its = known.find((one) => one.asked === asked)?.answer;
    const told = element(document, "p", { children: [answer || its ? `${answer || say("In the lesson: {}", its)} ` : "", link] });
    return element(document, "details", {
      ...(ANSWERED.has(asked) && { open: "" }),
      children: [element(document, "summary", { text: predict ? say("At step {}: {}", page.lesson.frames[frame].step + 1, asked) : asked }), ...(predict ? askFirst(page, question, told) : []), told],
    });
  }));
  if ($("question")) $("question").hidden = !questions.length;
}

const ANSWERED = new Set(); // questions to which the reader has said something

function askFirst(page, { asked, predict, frame }, answer) {
  const number = element(document, "input", { type: "number", min: 0 });
  const words = element(document, "label", { children: [`${say("Your number of {}:", countNamed(predict))} `, number] });
  const form = element(document, "form", { children: [words, element(document, "button", { text: say("Check") })] });
  const said = element(document, "p", { role: "status" });
  answer.hidden = !ANSWERED.has(asked);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (!number.value) return (said.textContent = say("Say a number first."));
    const found = page.facts[frame].map(({ counts }) => new Map(counts).get(predict) ?? 0);
    said.textContent = say(found.includes(Number(number.value)) ? "Right: you said {}; it is {}." : "Wrong: you said {}; it is {}.", number.value, listed(found));
    ANSWERED.add(asked);
    answer.hidden = false;
    form.closest("details").open = true;
    page.go(frame);
  });
  const choose = (word) => {
    page.live.guess = { asked, predict, word };
    $("question-dialog").close();
    page.go(frame);
    page.live.say(say("You say {}. Now drag a body.", say(word)));
  };
  const buttons = CHANGES.map((word) => {
    const button = element(document, "button", { type: "button", text: say(word) });
    button.addEventListener("click", () => choose(word));
    return button;
  });
  return [form, said, element(document, "p", { class: "group", children: [`${say("Or guess, then drag a body. There will be")} `, ...buttons, ` ${countNamed(predict)}.`] })];
}

const CHANGES = ["fewer", "as many", "more"];
const countNamed = (name, n = 100) => (COUNTS[name] ? form(COUNTS[name], n) : name.replaceAll("_", " "));
const countOf = (page, name) => page.facts[page.index].reduce((sum, { counts }) => sum + (new Map(counts).get(name) ?? 0), 0);

// What a move was said to make of a count, and what it has made of it.
function judge(live, { asked, predict, word, before }) {
  const now = countOf(live.page, predict);
  const found = CHANGES[Math.sign(now - before) + 1];
  live.guess = null;
  ANSWERED.add(asked);
  live.say(say(found === word ? "Yes, {}: {} before, {} now." : "No, {}: {} before, {} now.", say(found),
    `${before} ${countNamed(predict, before)}`, now));
}
