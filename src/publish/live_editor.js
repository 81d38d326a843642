// The scenario's text: a textarea without colours of its own upon lines that have numbers, colours
// and what the engine says of them.

const MOST_BEHIND = 24; // letters of a line that leave room for a diagnostic
const REST = 250; // ms without a key until the text is run
const TOKENS = /(#.*$|"(?:[^"\\]|\\.)*"|'[^']*')/; // behind a line's head: the table's or the key's

class Editor {
  constructor(live) {
    Object.assign(this, { live, area: $("source"), list: $("completions"), drawn: [], diagnostics: [], told: "" });
    this.area.addEventListener("input", () => this.typed());
    this.area.addEventListener("keydown", (event) => this.key(event));
    this.area.addEventListener("blur", () => this.closeList());
    this.area.addEventListener("focus", () => requestAnimationFrame(() => ($("editor").scrollLeft = 0)));
    this.list.addEventListener("pointerdown", (event) => {
      event.preventDefault(); // the text keeps the focus
      const option = event.target.closest("[role=option]");
      if (option) this.accept([...this.list.children].indexOf(option));
    });
    this.show(live.text);
  }

  get text() {
    return this.area.value;
  }

  // A text from elsewhere: what it changes is seen.
  show(text) {
    if (this.timer || text === this.text) return this.draw();
    const [caret, before] = [this.area.selectionStart, this.text.split("\n")];
    this.area.value = text;
    this.area.selectionStart = this.area.selectionEnd = Math.min(caret, text.length);
    this.draw();
    if (!before[1] || !this.isOpen) return;
    const now = text.split("\n");
    let first = 0, last = now.length - 1;
    while (first < last && now[first] === before[first]) first++;
    while (last > first && now[last] === before[last + before.length - now.length]) last--;
    for (const line of $("lines").children) line.classList.remove("changed");
    for (let i = first; i <= last; i++) $("lines").children[i].classList.add("changed");
    $("lines").children[first].scrollIntoView({ block: "nearest" });
  }

  get isOpen() {
    return !$("text-part").hidden;
  }

  // The lines that differ from those that are drawn.
  draw() {
    if (!this.isOpen) return;
    const lines = this.text.split("\n");
    const box = $("lines");
    lines.forEach((line, i) => {
      const said = this.diagnostics.filter((one) => one.line === i + 1);
      const key = JSON.stringify([line, said, said.length && lines[i + 1]]);
      if (this.drawn[i] === key) return;
      this.drawn[i] = key;
      const made = element(document, "div", { children: [...coloured(line, said), ...saidOf(said, line, lines[i + 1])] });
      box.children[i] ? box.children[i].replaceWith(made) : box.append(made);
    });
    while (box.children.length > lines.length) box.lastChild.remove();
    this.drawn.length = lines.length;
    const { style } = box.parentNode;
    style.setProperty("--rows", lines.length);
    style.setProperty("--columns", Math.max(...lines.map((line) => line.length)) + 2);
  }

  // It has been opened: what is wrong is seen.
  reveal() {
    this.draw();
    this.see($("lines").querySelector(".diagnostic.error"), "center");
  }

  // What the engine says of the text. What a lesson expects need not be so in a world of one's own.
  tell(diagnostics, unmet = []) {
    this.diagnostics = [...diagnostics, ...unmet.map((one) => ({ ...one, severity: "warning" }))];
    this.told = diagnostics.map(sentenceOf).join("\n");
    $("live-said").textContent = [this.told, unmet.length && say("In your world {} of the counts that the lesson expects are others.", unmet.length)].filter(Boolean).join("\n");
    const isWrong = diagnostics.some(({ severity }) => severity === "error");
    this.area.setAttribute("aria-invalid", isWrong);
    $("text").classList.toggle("wrong", isWrong);
    this.draw();
    if (document.activeElement !== this.area) return;
    const seen = $("lines").children[this.caret[0] - 1]?.querySelector(".diagnostic.error");
    this.see(seen, "nearest");
  }

  // Up and down only: the numbers of lines stay in sight.
  see(element, block) {
    const { scrollLeft } = $("editor");
    element?.scrollIntoView({ block });
    $("editor").scrollLeft = scrollLeft;
  }

  typed() {
    this.draw();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), REST);
    const [, before] = this.caret;
    if (/^\s*[\w.]+$|^\s*\[+[\w.]*$|=\s*"?\w*$/.test(before)) this.ask();
    else this.closeList();
  }

  // What was typed is run now.
  flush() {
    if (!this.timer) return;
    clearTimeout(this.timer);
    this.timer = 0;
    this.live.change(this.text, "typing");
  }

  // The line with the caret, from 1, and what is in front of the caret there.
  get caret() {
    const before = this.text.slice(0, this.area.selectionStart).split("\n");
    return [before.length, before.at(-1)];
  }

  // --- completion

  ask() {
    const [line, before] = this.caret;
    const { text } = this;
    this.live.soon("complete", async () => {
      const { from, words } = await this.live.engine.ask({ do: "complete", text, line, column: [...before].length + 1 });
      if (text === this.text && document.activeElement === this.area) this.open(from, words ?? [], before);
    });
  }

  open(from, words, before) {
    const begun = [...before].slice(from - 1).join("");
    const fitting = words.filter(({ word }) => word !== begun);
    this.list.replaceChildren(...fitting.map(({ word, means }, i) => element(document, "li", {
      role: "option", id: `completion-${i}`, "data-word": word,
      children: [element(document, "b", { text: word }), ` ${means ?? ""}`],
    })));
    this.from = from;
    this.list.hidden = !fitting.length;
    this.area.setAttribute("aria-expanded", !this.list.hidden);
    this.list.style.setProperty("--line", this.caret[0]);
    this.list.style.setProperty("--column", from - 1);
    if (fitting.length) this.choose(0);
  }

  closeList() {
    this.list.hidden = true;
    this.area.removeAttribute("aria-activedescendant");
    this.area.setAttribute("aria-expanded", false);
  }

  choose(index) {
    const options = [...this.list.children];
    this.chosen = (index + options.length) % options.length;
    options.forEach((option, i) => option.setAttribute("aria-selected", i === this.chosen));
    options[this.chosen].scrollIntoView({ block: "nearest" });
    this.area.setAttribute("aria-activedescendant", options[this.chosen].id);
  }

  accept(index = this.chosen) {
    const [, before] = this.caret;
    const end = this.area.selectionStart;
    const start = end - [...before].slice(this.from - 1).join("").length;
    this.area.setRangeText(this.list.children[index].dataset.word, start, end, "end");
    this.closeList();
    this.draw();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), REST);
  }

  key(event) {
    const acts = this.list.hidden ? {} : {
      ArrowDown: () => this.choose(this.chosen + 1), ArrowUp: () => this.choose(this.chosen - 1),
      Enter: () => this.accept(), Tab: () => this.accept(), Escape: () => this.closeList(),
    };
    const act = event.ctrlKey && event.key === " " ? () => this.ask() : acts[event.key];
    if (!act || event.altKey) return;
    event.preventDefault();
    act();
  }
}

const sentenceOf = ({ line, message, suggestion }) =>
  `${line ? `Line ${line}: ` : ""}${message}${suggestion ? `; ${suggestion}` : ""}`;

// A line's pieces by what they are; what is said of it is underlined from its column on.
function coloured(line, said) {
  const [head] = line.match(/^\s*(\[[^=]*\](?=\s*(#|$))|[\w.-]+(?=\s*=))/) ?? [""];
  const piece = (kind, text) => element(document, "span", { class: kind, text });
  const pieces = line.slice(head.length).split(TOKENS).map((text) =>
    text[0] === "#" ? piece("note", text) : /^["']/.test(text) ? piece("string", text) : text);
  pieces.unshift(piece("head", head));
  const [first] = said;
  if (first) {
    const letters = [...line].slice(first.column - 1).join("");
    const length = letters.match(/^[\w.-]+|^"[^"]*"?|^./)?.[0].length ?? 1;
    const style = `--column:${first.column - 1};--length:${length}`;
    pieces.push(element(document, "i", { class: first.severity, style }));
  }
  return pieces;
}

// Under the line, behind the words of the one that follows if those are few. A warning hides none.
function saidOf(said, line, following = "") {
  if (!said.length) return [];
  const words = said.map(({ message, suggestion }) => [message, suggestion].filter(Boolean).join("\n")).join("\n");
  const over = said[0].severity === "error" ? following : line;
  const style = `--behind:${over === line || over.length < MOST_BEHIND ? over.length + 1 : 0}`;
  return [element(document, "p", { class: `diagnostic ${said[0].severity}`, text: words, style })];
}
