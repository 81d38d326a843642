// The hand: what is drawn of a body follows the pointer or the arrow keys, and the engine draws the
// frame that comes of it. One request is on its way at a time, and behind it the newest place alone.

const MOVED = /(^|\/)(world\/(body|box|name|over|corner)|atlas\/(texture|plate))\//;
const ATLAS = /(^|\/)atlas\//;
const WALL = ""; // what the engine calls the corner of a wall that is near
const DRAG_SECONDS = 2;
const REACH = 16; // page units to a texture's corner, or beside a body for a finger
const THROWN = 250; // page units a second: slower is let go
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const TURNS = { ",": 15, ".": -15 }; // degrees, counter-clockwise

class Hand {
  constructor(live) {
    Object.assign(this, { live, page: live.page, held: null, times: [] });
    const stage = $("stage");
    const listen = (name, act, options) => stage.addEventListener(name, act, { capture: true, ...options });
    listen("pointerdown", (event) => this.down(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.up(event));
    listen("pointercancel", (event) => this.up(event));
    listen("click", (event) => {
      const way = this.pressed && Math.hypot(event.clientX - this.pressed.clientX, event.clientY - this.pressed.clientY);
      if (this.dragged || (event.pointerType === "mouse" && way > 8)) event.stopImmediatePropagation();
      this.dragged = false;
    });
    listen("touchmove", (event) => this.held && event.preventDefault(), { passive: false });
    $("things").addEventListener("keydown", (event) => this.key(event));
    const giveUp = (event) => event.key === "Escape" && this.held?.begun && this.giveUp(event);
    document.addEventListener("keydown", giveUp, true);
    this.page.shown = () => this.handle.remove();
    this.handle = this.page.picture.make("circle");
    this.handle.setAttribute("class", "handle");
    this.handle.setAttribute("r", 9);
  }

  get lesson() {
    return this.page.picture.lesson;
  }

  // What can be moved at a place of the window.
  at({ clientX, clientY, pointerType }) {
    const ways = pointerType === "touch" ? [[0, 0], [-REACH, 0], [REACH, 0], [0, -REACH], [0, REACH]] : [[0, 0]];
    for (const [dx, dy] of ways)
      for (const found of document.elementsFromPoint(clientX + dx, clientY + dy)) {
        if (found === this.handle) return this.handled;
        const [key, one] = (found.parentNode === this.page.picture.layer && this.lesson.keys[found.thing]) || [];
        if (!one || !MOVED.test(key)) continue;
        if (!ATLAS.test(key)) return one;
        if (this.isCorner(one, this.page.placeOf({ clientX, clientY }))) return one;
      }
    return this.live.hasLevel && this.isVertex(this.page.placeOf({ clientX, clientY })) ? WALL : null;
  }

  // Whether something that is drawn of a world has a corner here. The engine knows which are walls'.
  isVertex({ x, y }) {
    return [...this.page.picture.layer.children].some(({ thing, kind, at }) =>
      (kind === KIND.line || kind === KIND.polygon) && /^$|(^|\/)world\//.test(this.lesson.keys[thing][0]) &&
      at.some((n, i) => i % 2 === 0 && Math.hypot(n - x, at[i + 1] - y) < REACH));
  }

  sizes(one) {
    const [drawn] = this.drawnOf(one);
    return drawn && ATLAS.test(this.lesson.keys[drawn.thing][0]);
  }

  // Of a texture it is the lower right corner, and its size is what moves.
  isCorner(one, { x, y }) {
    const [left, upper, right, lower] = this.boxOf(one);
    return Math.hypot(right - x, lower - y) < Math.min(REACH, 0.4 * (right - left), 0.4 * (lower - upper));
  }

  // What is drawn of a body, without its name.
  drawnOf(one) {
    return [...this.page.picture.layer.children].filter(({ thing, kind }) => {
      const [key, first] = this.lesson.keys[thing];
      return kind !== KIND.text && first === one && MOVED.test(key);
    });
  }

  // The box around that, [x, y, x, y].
  boxOf(one) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { kind, at } of this.drawnOf(one)) {
      const points = kind === KIND.rect ? [at[0], at[1], at[0] + at[2], at[1] + at[3]] : at;
      points.forEach((n, i) => {
        box[i % 2] = Math.min(box[i % 2], n);
        box[2 + (i % 2)] = Math.max(box[2 + (i % 2)], n);
      });
    }
    return box;
  }

  middleOf(one) {
    const [left, upper, right, lower] = this.boxOf(one);
    return { x: (left + right) / 2, y: (upper + lower) / 2 };
  }

  // --- by pointer

  down(event) {
    this.dragged = false;
    this.pressed = event;
    if (event.button || this.held) return;
    const one = this.at(event);
    if (one === null) return;
    const { x, y } = this.page.placeOf(event);
    const turns = event.altKey || event.target === this.handle;
    const place = { from: { x, y }, at: { x, y }, turn: 0 };
    this.held = { one, ...place, pointer: event.pointerId, turns, start: event, track: [] };
  }

  move(event) {
    const { held } = this;
    if (!held) return this.hover(event);
    if (event.pointerId !== held.pointer) return;
    event.stopImmediatePropagation();
    const way = Math.hypot(event.clientX - held.start.clientX, event.clientY - held.start.clientY);
    if (!held.begun && way < (event.pointerType === "touch" ? 8 : 4)) return;
    if (!held.begun) {
      $("stage").setPointerCapture(held.pointer);
      this.begin(held);
    }
    const { x, y } = this.page.placeOf(event);
    held.track.push({ t: event.timeStamp, x, y });
    if (held.turns) held.turn = degrees(held.middle, held.from, { x, y });
    else held.at = { x, y };
    this.drag(held, event.timeStamp);
  }

  up(event) {
    const { held } = this;
    if (!held || event.pointerId !== held.pointer) return;
    if (!held.begun) return (this.held = null);
    this.dragged = event.type === "pointerup"; // no click will follow
    const throws = this.dragged && !held.turns && this.live.passes;
    this.release(held, throws ? speedOf(held.track, event.timeStamp) : null);
  }

  hover(event) {
    const one = event.pointerType === "touch" || event.buttons ? null : this.at(event);
    $("stage").dataset.hand = one === null ? "" : this.sizes(one) ? "size" : "grab";
    if (one) this.offerTurn(one);
    else if (event.target.parentNode === this.page.picture.layer) this.handle.remove();
  }

  // A handle beside a body of a world in which things turn.
  offerTurn(one) {
    if (!this.live.passes || this.sizes(one) || this.held) return this.handle.remove();
    const [, upper, right] = this.boxOf(one);
    this.handled = one;
    this.handle.setAttribute("cx", right + 8);
    this.handle.setAttribute("cy", upper - 8);
    this.page.picture.svg.append(this.handle);
  }

  // --- what the engine is asked

  begin(held) {
    const { live, page } = this;
    this.held = held;
    held.begun = true;
    held.middle = held.turns && this.middleOf(held.one);
    this.handle.remove();
    live.say("");
    page.pause();
    page.pointing?.light(null);
    $("stage").dataset.hand = "grabbing";
    live.editor.flush();
    live.soon("grab", async () => {
      const { one: entity, from } = held;
      const { refused } = live.broken ? { refused: [{ message: live.broken }] }
        : await live.engine.ask({ do: "grab", frame: page.index, entity, ...from });
      if (!refused) return;
      held.refused = true;
      if (entity !== WALL) live.say(refused[0].message);
    });
  }

  drag(held, since) {
    this.live.soon("drag", async () => {
      if (held.refused) return;
      if (await this.ask(held)) this.times.push(performance.now() - since);
    });
  }

  async ask(held, speed = { vx: 0, vy: 0 }) {
    const { live, page } = this;
    const answer = await live.engine.ask({ do: "drag", ...held.at, turn: held.turn, ...speed }, DRAG_SECONDS)
      .catch((error) => { held.refused = true; throw error; });
    if (answer.refused) return live.say(answer.refused[0].message);
    held.last = answer;
    page.look(live.retoldAlone(new Lesson(answer.lesson, page.lesson)), answer.facts);
    live.editor.show(answer.text);
    live.mark(answer.text);
    return answer;
  }

  // The hand lets go: the whole is run from the text that came of it, and what was thrown flies on.
  release(held, speed) {
    const { live } = this;
    this.held = null;
    $("stage").dataset.hand = "";
    if (speed) live.soon("throw", () => held.refused || this.ask(held, speed));
    live.soon("release", async () => {
      const { last } = held;
      if (!last) return;
      live.take(last.text, "hand");
      live.cause = null;
      await live.run({ index: last.index, plays: Boolean(speed) });
      this.tell(held.one);
    });
  }

  // All is as it was.
  giveUp(event) {
    event.stopImmediatePropagation();
    const { held, live } = this;
    held.refused = this.dragged = true;
    this.held = null;
    $("stage").dataset.hand = "";
    live.soon("release", () => live.run());
    live.editor.show(live.text);
    live.mark();
  }

  // Where it is now and what is to be tested, for those who do not see it.
  tell(one) {
    if (one === WALL) return;
    const { facts, index } = this.page;
    const side = facts[index].find(({ name }) => name === sideOf(one)) ?? facts[index][0];
    const body = side.bodies.find(([, name]) => name === nameOf(one));
    const pairs = new Map(side.counts).get("pairs");
    const told = pairs === undefined ? "" : `; ${pairs} candidate pair${pairs === 1 ? "" : "s"}`;
    $("said").textContent = `${nameOf(one)}${body ? ` at ${body[2].join(", ")}` : ""}${told}`;
  }

  // --- by keys, of the body that has the focus among the frame's things

  key(event) {
    const one = event.target.dataset.entity ?? "";
    const [step, turn] = [STEPS[event.key], TURNS[event.key]];
    if (!(step || turn) || kindOf(one) !== "body" || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    if (this.held?.one !== one) {
      if (this.held) return;
      if (!this.drawnOf(one).length) return;
      const from = this.middleOf(one);
      this.begin({ one, from, at: from, turn: 0 });
    }
    const { held } = this;
    const far = event.shiftKey ? 2 : 20;
    if (step) held.at = { x: held.at.x + far * step[0], y: held.at.y + far * step[1] };
    else held.turn += turn;
    this.drag(held, event.timeStamp);
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.release(held, null), 400);
  }

  // Told once.
  invite() {
    const first = [...this.page.picture.layer.children].find(({ thing }) => MOVED.test(this.lesson.keys[thing][0]));
    if (!first && !this.live.hasLevel) return;
    try {
      if (localStorage.getItem("lantern-hand")) return;
      localStorage.setItem("lantern-hand", "1");
    } catch {} // a page may be kept from remembering
    const isAtlas = first && ATLAS.test(this.lesson.keys[first.thing][0]);
    const what = isAtlas ? "texture’s corner" : first ? "body" : "corner of a wall";
    this.live.say(`Drag a ${what}: the engine answers.`);
  }
}

// How far a hand has gone around a middle, counter-clockwise.
function degrees(middle, from, to) {
  const angle = ({ x, y }) => Math.atan2(y - middle.y, x - middle.x);
  const turned = ((angle(from) - angle(to)) * 180) / Math.PI;
  return turned > 180 ? turned - 360 : turned < -180 ? turned + 360 : turned;
}

// Of the hand's last tenth of a second, if it throws: it has not rested before it lets go.
function speedOf(track, now) {
  const last = track.at(-1);
  const first = track.find(({ t }) => t > last.t - 100);
  if (last.t < now - 100 || last.t <= first.t) return null;
  const [vx, vy] = ["x", "y"].map((axis) => (1000 * (last[axis] - first[axis])) / (last.t - first.t));
  return Math.hypot(vx, vy) > THROWN ? { vx, vy } : null;
}
