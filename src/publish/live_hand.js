// The hand: what is drawn of a body follows the pointer or the arrow keys, and the engine draws the
// frame that comes of it. One request is on its way at a time, and behind it the newest place alone.

const MOVED = /(^|\/)(world\/(body|box|name|over|corner)|atlas\/(texture|plate))\//;
const ATLAS = /(^|\/)atlas\//;
const WALL = ""; // what the engine calls the corner of a wall that is near
const DRAG_SECONDS = 2;
const REACH = 16; // pixels to a corner, or beside a body for a finger
const FINGER = 24; // pixels to a corner, for one
const THROWN = 250; // page units a second: slower is let go
const FLIGHT = -1; // what plays
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const INVITATIONS = { wall: "Drag the corner of a wall", texture: "Drag the corner of a texture", body: "Drag a body", throw: "Drag a body, or throw it" };
const TURNS = { ",": 15, ".": -15 }; // degrees, counter-clockwise

class Hand {
  constructor(live) {
    Object.assign(this, { live, page: live.page, held: null, times: [], words: new HandWords(this) });
    const stage = $("stage");
    const listen = (name, act, options) => stage.addEventListener(name, act, { capture: true, ...options });
    listen("pointerdown", (event) => this.down(event));
    // Each move at once, and not with the next picture, while something is held.
    const atOnce = "onpointerrawupdate" in window;
    if (atOnce) listen("pointerrawupdate", (event) => this.held && this.move(event));
    listen("pointermove", (event) => (this.held?.begun && atOnce ? event.stopImmediatePropagation() : this.move(event)));
    listen("pointerup", (event) => this.up(event));
    listen("pointercancel", (event) => this.up(event));
    // A finger's moves go to what it came down on, also when that is no longer in the picture.
    const stay = (event) => this.held && event.preventDefault();
    listen("touchstart", ({ target }) => target.addEventListener("touchmove", stay, { passive: false }), { passive: false });
    listen("click", (event) => {
      const way = this.pressed && Math.hypot(event.clientX - this.pressed.clientX, event.clientY - this.pressed.clientY);
      if (this.dragged || (event.pointerType === "mouse" && way > 8)) event.stopImmediatePropagation();
      this.dragged = false;
    });
    $("things").addEventListener("keydown", (event) => this.key(event));
    const giveUp = (event) => event.key === "Escape" && this.held?.begun && this.giveUp(event);
    document.addEventListener("keydown", giveUp, true);
    this.page.shown = () => {
      this.handle.remove();
      this.beckon();
    };
    this.handle = this.page.picture.make("circle");
    this.handle.setAttribute("class", "handle");
  }

  get lesson() {
    return this.page.picture.lesson;
  }

  // Pixels of a page unit.
  get scale() {
    return $("picture").getScreenCTM().a;
  }

  // What can be moved at a place of the window.
  at({ clientX, clientY, pointerType }) {
    const { x, y } = this.page.placeOf({ clientX, clientY });
    const corner = this.cornerAt({ x, y }, { pointerType });
    if (corner) return corner;
    const ways = pointerType === "touch" ? [[0, 0], [-REACH, 0], [REACH, 0], [0, -REACH], [0, REACH]] : [[0, 0]];
    for (const [dx, dy] of ways)
      for (const found of document.elementsFromPoint(clientX + dx, clientY + dy)) {
        if (found === this.handle) return this.handled;
        const [key, one] = (found.parentNode === this.page.picture.layer && this.lesson.keys[found.thing]) || [];
        if (one && MOVED.test(key)) return one;
      }
    const isIn = { [KIND.polygon]: (at) => holds(at, x, y), [KIND.rect]: ([left, upper, width, height]) => x > left && y > upper && x < left + width && y < upper + height };
    const hollow = [...this.page.picture.layer.children].findLast(({ thing, kind, at }) =>
      MOVED.test(this.lesson.keys[thing][0]) && isIn[kind]?.(at));
    if (hollow) return this.lesson.keys[hollow.thing][1];
    return this.live.scene.level && this.isVertex({ x, y }) ? WALL : null;
  }

  // Whether something that is drawn of a world has a corner here. The engine knows which are walls'.
  isVertex({ x, y }) {
    return [...this.page.picture.layer.children].some(({ thing, kind, at }) =>
      (kind === KIND.line || kind === KIND.polygon) && /^$|(^|\/)world\//.test(this.lesson.keys[thing][0]) &&
      at.some((n, i) => i % 2 === 0 && Math.hypot(n - x, at[i + 1] - y) < REACH / this.scale));
  }

  sizes(one) {
    const [drawn] = this.drawnOf(one);
    return drawn && ATLAS.test(this.lesson.keys[drawn.key][0]);
  }

  // Of a texture it is the lower right corner that moves, and with it its size.
  isCorner(one, { x, y }, event) {
    if (this.cornerAt({ x, y }, event) === one) return true;
    const [left, upper, right, lower] = this.boxOf(one);
    return Math.hypot(right - x, lower - y) < Math.min(3 * REACH, 0.4 * (right - left), 0.4 * (lower - upper));
  }

  // The texture whose corner is nearest, if that is within reach.
  cornerAt({ x, y }, { pointerType }) {
    let [found, least] = [null, (pointerType === "touch" ? FINGER : REACH) / this.scale];
    for (const { thing, at } of this.page.picture.layer.children) {
      const [key, one] = this.lesson.keys[thing];
      const way = /(^|\/)atlas\/texture\//.test(key) ? Math.hypot(at[0] + at[2] - x, at[1] + at[3] - y) : Infinity;
      if (way < least) [found, least] = [one, way];
    }
    return found;
  }

  // What is drawn of a body, without its name.
  drawnOf(one, lesson = this.lesson, index = this.page.picture.index) {
    return lesson.lists[index].map((row) => lesson.shape(row)).filter(({ key, kind }) => {
      const [name, first] = lesson.keys[key];
      return kind !== KIND.text && first === one && MOVED.test(name);
    });
  }

  // The box around that, [x, y, x, y].
  boxOf(one, lesson, index) {
    return boxAround(this.drawnOf(one, lesson, index).flatMap(({ kind, at }) =>
      kind === KIND.rect ? [at[0], at[1], at[0] + at[2], at[1] + at[3]] : at));
  }

  middleOf(one) {
    const [left, upper, right, lower] = this.boxOf(one);
    return { x: (left + right) / 2, y: (upper + lower) / 2 };
  }

  // --- by pointer

  down(event) {
    [this.dragged, this.landed] = [this.landed, false]; // a press that ends a flight is no click
    this.pressed = event;
    this.beside = false;
    if (event.button || this.held) return;
    const one = this.at(event);
    if (one === null) return;
    const { x, y } = this.page.placeOf(event);
    const sizes = this.sizes(one);
    if (sizes && !this.isCorner(one, { x, y }, event)) return (this.beside = true);
    const turns = !sizes && (event.altKey || event.target === this.handle);
    const place = { from: { x, y }, at: { x, y }, turn: 0 };
    this.held = { one, ...place, pointer: event.pointerId, turns, start: event, track: [] };
  }

  move(event) {
    const { held } = this;
    if (!held && this.beside && event.buttons) this.live.say(say("A texture’s size is what can be changed: drag its corner."));
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
    const sizes = one && this.sizes(one);
    const isCorner = sizes && this.isCorner(one, this.page.placeOf(event), event);
    $("stage").dataset.hand = one === null ? "" : isCorner ? "size" : sizes ? "texture" : one && this.live.passes ? "throw" : "grab";
    if (one) this.offer(one, sizes);
    else if (event.target.parentNode === this.page.picture.layer) this.handle.remove();
  }

  // A handle: at a texture's corner, or beside a body of a world in which things turn.
  offer(one, sizes) {
    if (this.held || !(sizes || this.live.passes)) return this.handle.remove();
    const [, upper, right, lower] = this.boxOf(one);
    this.handled = one;
    this.handle.setAttribute("cx", sizes ? right : right + 8);
    this.handle.setAttribute("cy", sizes ? lower : upper - 8);
    this.handle.setAttribute("r", Math.max(9, 8 / this.scale));
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
    this.welcome();
    if (live.guess) live.guess.before = countOf(page, live.guess.predict);
    this.watch(held.one === WALL ? null : held.one, "hold");
    $("stage").dataset.hand = "grabbing";
    live.editor.flush();
    live.soon("grab", async () => {
      const { one: entity, from } = held;
      const { refused } = live.broken ? { refused: [{ message: live.broken }] }
        : await live.engine.ask({ do: "grab", frame: page.index, entity, ...from });
      if (!refused) return;
      held.refused = true;
      this.watch(null);
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
    page.words.grown = answer.steps - live.scene.steps;
    this.look(answer);
    live.editor.show(answer.text);
    live.mark(answer.text);
    return answer;
  }

  // One frame that the engine has drawn.
  look({ lesson, facts, like }) {
    const { live, page } = this;
    page.look(live.retoldAlone(new Lesson(lesson, page.lesson), facts, like), facts);
    page.pointing.light();
    const [{ step, caption }] = page.picture.lesson.frames;
    page.tellStop(step, caption);
  }

  // The hand lets go: the whole is run from the text that came of it, and what was thrown flies first.
  release(held, speed) {
    const { live } = this;
    this.held = null;
    this.deed = speed ? "threw" : "moved";
    $("stage").dataset.hand = "";
    if (speed) live.soon("throw", () => held.refused || this.ask(held, speed));
    live.soon("release", async () => {
      const { last } = held;
      if (!last) return;
      live.take(last.text, "hand");
      live.cause = null;
      const moment = speed && (await this.fly(last));
      await live.run(moment ? { moment } : { index: last.index });
      this.tell(held.one);
      if (!speed && live.passes && kindOf(held.one) === "body") live.say(say("It was put down here: play goes on from here."));
      if (live.guess) judge(live, live.guess);
    });
  }

  // A run of its own, whose steps stop every few moments, is seen in its world's own time until it ends
  // or the reader does something else. Tells the moment that it has come to.
  async fly({ index, lesson: { frames: [{ step, time: start }] } }) {
    const { page, live: { engine } } = this;
    const { frames, seconds } = await engine.ask({ do: "fly" }).catch(() => ({}));
    if (!frames) return null; // more than can be shown
    const ends = new AbortController();
    const stop = ({ type, target }) => {
      if ($("bar").contains(target)) return; // its buttons know of what plays
      this.landed = type === "pointerdown" && $("stage").contains(target);
      setTimeout(() => page.pause());
    };
    for (const kind of ["pointerdown", "keydown"]) document.addEventListener(kind, stop, { capture: true, signal: ends.signal });
    page.playing = FLIGHT;
    $("play").setAttribute("aria-pressed", "true");
    const began = performance.now();
    let [moment, seen] = [{ step, time: start }, page.index];
    const gone = () => ((performance.now() - began) / 1000) * Number($("speed").value);
    try {
      for (let i = index + 1; page.playing === FLIGHT && i < frames; i += Math.max(1, Math.floor((gone() + start - moment.time) / seconds))) {
        const drawn = await engine.ask({ do: "frame", index: i });
        const [frame] = drawn.lesson.frames;
        await new Promise((then) => setTimeout(then, 1000 * (frame.time - start - gone())));
        if (page.playing !== FLIGHT) break;
        moment = frame;
        seen = page.index = leadsTo(page.lesson, { ...frame, step: frame.step - page.words.grown });
        this.look(drawn);
      }
    } finally {
      ends.abort();
      page.pause();
    }
    return page.index === seen ? moment : page.lesson.frames[page.index];
  }

  // --- of which body words are told

  // Its nodes and pairs stay lit, and a sentence says them, until another one is held.
  watch(one, deed) {
    const { pointing } = this.page;
    this.page.watched = one;
    this.deed = deed;
    $("remove").disabled = !one;
    if (!pointing) return;
    pointing.watched = one;
    pointing.light();
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
    $("said").textContent = `${body ? say("{} at {}", body[5] ?? body[1], pointSaid(body[2])) : nameOf(one)}. ${this.words.sentence(this.page.lesson, index, facts[index])}`;
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

  // --- that it can be done

  // What can be moved pulses, and words say so, until somebody has done such a thing.
  invite() {
    this.done = ""; // kinds of things
    try {
      this.done = localStorage.getItem(this.remembered) ?? "";
    } catch {} // a page may be kept from remembering
    this.beckon();
  }

  // Where it is kept that somebody has, of each page.
  get remembered() {
    return `lantern-hand ${location.pathname}`;
  }

  // The first thing of the frame that can be moved.
  get inviting() {
    const fixed = new Set(this.page.facts[this.page.index].flatMap(({ bodies, name: side }) =>
      bodies.flatMap(([, name, , , state]) => (state === "static" ? [entity(side, "body", name)] : []))));
    const shape = this.lesson.lists[this.page.picture.index].map((row) => this.lesson.keys[this.lesson.shape(row).key])
      .find(([key, one]) => one && MOVED.test(key) && !fixed.has(one));
    return shape?.[1];
  }

  beckon() {
    this.mark?.remove();
    const one = this.inviting;
    this.kind = !one ? this.live.scene.level && "wall" : this.sizes(one) ? "texture" : this.live.passes ? "throw" : "body";
    const invites = this.kind && this.done !== undefined && !this.done.includes(this.kind);
    $("invitation").hidden = !invites;
    $("invitation").textContent = say("{}: the engine answers.", say(INVITATIONS[this.kind]));
    if (!one || !invites) return;
    const [left, upper, right, lower] = this.boxOf(one);
    this.mark = this.page.picture.make("g");
    this.mark.setAttribute("class", "beckon");
    this.mark.innerHTML = `<rect x="${left - 8}" y="${upper - 8}" width="${right - left + 16}" height="${lower - upper + 16}" rx="10"/>
<path transform="translate(${right - 8} ${lower - 8}) scale(${1.7 * Math.max(1, 0.45 / this.scale)})" d="M9 14V5a2 2 0 0 1 4 0v7l5 1a2.5 2.5 0 0 1 2 3l-1 4a4 4 0 0 1-4 3h-2a5 5 0 0 1-4-2l-4-5a1.7 1.7 0 0 1 2.5-2.2z"/>`;
    this.page.picture.svg.append(this.mark);
  }

  // It has been done.
  welcome() {
    const what = this.kind === "throw" ? "throw body" : this.kind; // who throws can drag
    if (!this.done.includes(what)) this.done += ` ${what}`;
    this.beckon();
    try {
      localStorage.setItem(this.remembered, this.done);
    } catch {}
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
