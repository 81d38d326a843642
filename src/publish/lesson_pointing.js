// Pointing at one thing lights up all that belongs to it, in every panel. What belongs together is
// told by the keys of shapes (entities such as "node/root.0", "body/ann", "pair/ann|bob") and by the
// frame's facts: which bodies are in which node, which bodies are a pair.

const kindOf = (entity) => entity.split("/").at(-2);
const nameOf = (entity) => entity.split("/").at(-1);
const sideOf = (entity) => entity.split("/").slice(0, -2).join("/");
const entity = (side, kind, name) => `${side ? `${side}/` : ""}${kind}/${name}`;

const pairOf = (a, b) => (a < b ? `${a}|${b}` : `${b}|${a}`);

// One side's facts by name: a body that leaves and comes back gets another id.
class Relations {
  constructor(facts) {
    this.side = facts.name;
    const names = new Map([...facts.bodies, ...facts.textures].map(([id, name]) => [id, name || `#${id}`]));
    this.names = [...names.values()];
    this.labels = new Map(facts.bodies.flatMap(([, name, , , , label]) => (label ? [[name, label]] : [])));
    this.pairs = facts.pairs.map(([a, b]) => [names.get(a), names.get(b)]);
    this.nodes = new Map(facts.nodes.map(([way, label, depth, leaf, bodies, outline, slot]) =>
      [way, { way, label, depth, leaf, bodies: new Set(bodies.map((id) => names.get(id))), outline, slot }]));
    for (const node of this.nodes.values()) this.fillAbove(node);
  }

  // A node holds what the leaves below it hold.
  fillAbove(node) {
    if (!node.leaf) return;
    for (let way = node.way; way.includes("."); ) {
      way = way.slice(0, way.lastIndexOf("."));
      const above = this.nodes.get(way);
      if (above) for (const name of node.bodies) above.bodies.add(name);
    }
  }

  // As the picture calls it.
  called(name) {
    return this.labels.get(name) ?? name;
  }

  leavesWith(...names) {
    return [...this.nodes.values()].filter(
      (node) => node.leaf && names.every((name) => node.bodies.has(name)));
  }

  nodeInSlot(slot) {
    return [...this.nodes.values()].find((node) => node.slot === slot);
  }

  // The deepest node whose cell holds a point of the page.
  nodeAt(x, y) {
    let found = null;
    for (const node of this.nodes.values())
      if ((!found || node.depth >= found.depth) && holds(node.outline, x, y)) found = node;
    return found;
  }
}

// Whether a frame shows nodes at all: else nobody asks for their names and places.
const showsNodes = (lesson, index) => lesson.lists[index].some((row) =>
  kindOf(lesson.keys[lesson.shape(row).key][1] ?? "") === "node");

function holds(outline, x, y) {
  let inside = false;
  for (let i = 0, j = outline.length - 2; i < outline.length; j = i, i += 2) {
    const [xi, yi, xj, yj] = [outline[i], outline[i + 1], outline[j], outline[j + 1]];
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}

class Pointing {
  // `watched`: what is lit where nothing else is pointed at.
  constructor(lesson, picture, facts, say, watched = null) {
    Object.assign(this, { lesson, picture, facts, say, watched, entity: null });
  }

  get sides() {
    if (this.known !== this.picture.index) {
      this.known = this.picture.index;
      this.relations = this.facts[this.known].map((side) => new Relations(side));
    }
    return this.relations;
  }

  side(of) {
    return this.sides.find((side) => side.side === sideOf(of)) ?? this.sides[0];
  }

  // The entity under the pointer: a body or pair that is drawn there, or else the cell.
  at(element, x, y) {
    const drawn = element?.thing === undefined ? [] : this.lesson.entitiesOf(element.thing);
    const best = drawn.find((one) => kindOf(one) !== "node") ?? drawn[0];
    const cell = this.sides.map((side) => [side, side.nodeAt(x, y)]).find(([, node]) => node);
    if (best && (kindOf(best) !== "node" || !cell)) return this.resolved(best);
    return cell ? entity(cell[0].side, "node", cell[1].way) : null;
  }

  // A slot of the pool is whatever node lies in it.
  resolved(one) {
    if (kindOf(one) !== "slot") return one;
    const node = this.side(one).nodeInSlot(Number(nameOf(one)));
    return node ? entity(sideOf(one), "node", node.way) : null;
  }

  // All that belongs to an entity, itself among it.
  related(one) {
    const found = new Set([one]);
    const kind = kindOf(one);
    const own = this.side(one);
    if (kind === "node") this.addNode(found, own, own.nodes.get(nameOf(one)));
    else for (const side of this.sides) this.addBodies(found, side, kind, nameOf(one));
    return found;
  }

  addNode(found, side, node) {
    if (!node) return;
    for (const name of node.bodies) found.add(entity(side.side, "body", name));
    for (const [a, b] of side.pairs)
      if (this.share(side, node, a, b)) found.add(entity(side.side, "pair", pairOf(a, b)));
    this.addPlace(found, side, node);
  }

  // A pair belongs to a node if both bodies meet in a leaf of it.
  share(side, node, a, b) {
    if (!node.bodies.has(a) || !node.bodies.has(b)) return false;
    return side.leavesWith(a, b).some((leaf) => `${leaf.way}.`.startsWith(`${node.way}.`));
  }

  addPlace(found, side, node) {
    found.add(entity(side.side, "node", node.way));
    if (node.slot >= 0) found.add(entity(side.side, "slot", node.slot));
  }

  // A body or a pair of them, with the leaves that hold them and the pairs that they are in.
  addBodies(found, side, kind, name) {
    const names = name.split("|");
    for (const one of names) found.add(entity(side.side, "body", one));
    for (const leaf of side.leavesWith(...names)) this.addPlace(found, side, leaf);
    if (kind === "pair") return found.add(entity(side.side, "pair", name));
    for (const [a, b] of side.pairs)
      if (a === name || b === name) found.add(entity(side.side, "pair", pairOf(a, b)));
  }

  words(one) {
    const side = this.side(one);
    const name = nameOf(one);
    const listOf = (names) => names.map((its) => side.called(its)).join(", ");
    if (kindOf(one) === "pair") return say("pair {}", listOf(name.split("|")));
    if (kindOf(one) === "body") {
      const shown = showsNodes(this.lesson, this.picture.index) ? side.leavesWith(name) : [];
      const leaves = shown.map((leaf) => labelOf(leaf.label)).join(", ");
      return leaves ? say("{}, in {}", side.called(name), leaves) : side.called(name);
    }
    const node = side.nodes.get(name);
    if (!node) return "";
    const called = say(node.leaf ? "leaf {}" : "node {}", labelOf(node.label));
    return node.bodies.size ? say("{} holds {}", called, listOf([...node.bodies])) : say("{} is empty", called);
  }

  // Lights up an entity and what belongs to it; null: nothing.
  light(one = this.watched) {
    if (one === this.entity && this.lit === this.picture.index) return;
    this.entity = one;
    this.lit = this.picture.index;
    const { layer, over, svg } = this.picture;
    over.replaceChildren();
    svg.classList.toggle("pointing", one !== null);
    svg.classList.toggle("watching", one !== null && one === this.watched);
    if (!one) {
      for (const element of layer.querySelectorAll(".lit")) this.picture.mark(element, element.marks.replace(" lit", ""));
      return this.say("");
    }
    const related = this.related(one);
    for (const element of layer.children) this.mark(element, related);
    this.outline(related);
    this.say(one === this.watched ? "" : this.words(one));
  }

  mark(element, related) {
    const entities = this.lesson.entitiesOf(element.thing);
    const isLink = entities.length > 0 && kindOf(entities[0]) === "pair";
    const isLit = entities.every((e) => related.has(e));
    this.picture.mark(element, entities.length ? ` thing${isLink ? " link" : ""}${isLit ? " lit" : ""}` : "");
  }

  // The cells of lit nodes, and what stands for them in the other panels.
  outline(related) {
    const boxes = new Map();
    for (const element of this.picture.layer.querySelectorAll(".lit")) {
      const [key, ...entities] = this.lesson.keys[element.thing];
      if (!/(tree\/node|memory\/leaf|pool|ledger)\//.test(key) || element.tagName !== "rect") continue;
      if (entities.every((e) => kindOf(e) !== "body") && !boxes.has(key)) boxes.set(key, element);
    }
    for (const box of boxes.values()) this.addOver("rect", RECT_AT, (name) => box.getAttribute(name));
    if (!showsNodes(this.lesson, this.picture.index)) return;
    for (const one of related) {
      const node = kindOf(one) === "node" && this.side(one).nodes.get(nameOf(one));
      if (node && node.outline.length) this.addOver("polygon", ["points"], () => node.outline.join(" "));
    }
  }

  addOver(tag, names, value) {
    const made = this.picture.make(tag);
    for (const name of names) made.setAttribute(name, value(name));
    this.picture.over.append(made);
  }

  // All that can be pointed at in this frame.
  get entities() {
    return this.sides.flatMap((side) => [
      ...[...side.nodes.keys()].map((way) => entity(side.side, "node", way)),
      ...side.names.map((name) => entity(side.side, "body", name)),
    ]);
  }
}
