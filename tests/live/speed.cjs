// How quick the page's engine is: a hand's drags, from the question to the parsed answer, and what
// they are made of. Numbers to be read, not held: they are of this machine and what else it does.
// Usage: node speed.cjs ENGINE SCENARIOS
const fs = require("fs");
const os = require("os");
const path = require("path");
const { Engine } = require("./engine.cjs");

const DRAGS = 60;
const WARM = 15; // until the code is compiled well

// What a hand takes: the texture or body of that name, or any; "" is a corner.
const HANDS = [
  ["ghost_quadtree"], ["pong_bsp"], ["pong_game"], ["doom_level_bsp", ""], ["octree_split"], ["kdtree_atlas"],
  ["falling_boxes"], ["islands_graph"],
];

const sorted = (times) => [...times].sort((a, b) => a - b);
const at = (times, part) => sorted(times)[Math.min(times.length - 1, Math.floor(part * times.length))];
const ms = (time) => time.toFixed(time < 10 ? 1 : 0).padStart(5);

function timed(act) {
  const start = performance.now();
  const value = act();
  return [performance.now() - start, value];
}
function median(times, act) {
  act();
  return at(Array.from({ length: times }, () => timed(act)[0]), 0.5);
}

// The first thing that can be taken, on the latest frame that has one: [frame, entity, x, y].
function taken(engine, { lesson, facts }, only) {
  for (let frame = facts.length - 1; frame >= 0; frame--) {
    let places = [];
    if (only === "") {
      // Ends of lines, in hundredths of a page unit: some of them are walls.
      const ends = lesson.rows.filter((row) => row[0] === 1).map((row) => [row[3] / 100, row[4] / 100]);
      places = ends.slice(0, 40).map(([x, y]) => ["", x, y]);
    } else
      for (const { name, bodies = [], textures = [] } of facts[frame])
        for (const [, called] of [...bodies, ...textures]) places.push([`${name && name + "/"}body/${called}`, 800, 400]);
    for (const [entity, x, y] of places)
      if (engine.ask({ do: "grab", frame, entity, x, y }).grabbed && engine.ask({ do: "drag", x: x + 2, y }).text)
        return { frame, entity, x, y };
  }
  return null;
}

async function main([wasm, scenarios]) {
  const load = () => os.loadavg().map((one) => one.toFixed(1)).join(" ");
  console.log(`${os.cpus().length} cores, ${os.cpus()[0].model}, node ${process.version}, load ${load()}`);
  const [compiled, module] = await timedAsync(() => WebAssembly.compile(fs.readFileSync(wasm)));
  console.log(`compiled in ${ms(compiled)} ms`);
  console.log("In milliseconds, but for a/s: frames a second. Parts of a drag are measured on their own, one by one.");
  console.log("                a drag:                       | its parts:                          | all:");
  console.log("                first least middle  95%  a/s  | edit  read   run layout draw parse |open lesson a/s  svg | MB");
  for (const [name, only] of HANDS) {
    const text = fs.readFileSync(path.join(scenarios, `${name}.toml`), "utf8");
    const engine = await Engine.start(module);
    const ask = (request) => {
      const answer = engine.ask(request);
      if (answer.refused && request.do !== "open" && request.do !== "grab" && request.do !== "drag") throw new Error(answer.said);
      return answer;
    };
    const opened = ask({ do: "open", text, name });
    if (opened.refused) throw new Error(opened.said);
    const lesson = ask({ do: "lesson" });
    const hand = taken(engine, lesson, only);
    if (!hand) {
      console.log(`${name}: nothing can be taken`);
      continue;
    }
    const drags = [];
    const parses = [];
    let refused = 0;
    for (let i = 0; i < DRAGS; i++) {
      const drag = JSON.stringify({ do: "drag", x: hand.x + 3 * Math.sin(i), y: hand.y + 3 * Math.cos(i), turn: 0 });
      const [asked, json] = timed(() => engine.asked(drag));
      const [parsed, answer] = timed(() => JSON.parse(json));
      refused += answer.refused ? 1 : 0;
      drags.push(asked + parsed);
      parses.push(parsed);
    }
    const good = drags.slice(WARM);
    // What a drag does, one after the other: a change to the text, that read, run until the frame is
    // there, the layout frozen for its group, the frame drawn and written, and the answer read.
    const edit = median(15, () => ask({ do: "set", path: "title", value: '"x"' }));
    const read = median(15, () => ask({ do: "open", text: text + '\n[[step]]\ndo = "nothing"\n', name }));
    const drawn = median(15, () => ask({ do: "frame", index: hand.frame }));
    const svg = median(9, () => ask({ do: "svg", index: hand.frame, width: 1600, height: 900 }));
    const all = median(3, () => ask({ do: "lesson" }));
    const opens = [];
    const firsts = []; // frames after it
    for (let i = 0; i < 9; i++) {
      opens.push(timed(() => ask({ do: "open", text, name }))[0]);
      firsts.push(timed(() => ask({ do: "frame", index: hand.frame }))[0]);
    }
    const open = at(opens, 0.5);
    const parse = at(parses.slice(WARM), 0.5);
    const drag = at(good, 0.5);
    const parts = [edit, read, Math.max(0, open - read), Math.max(0, at(firsts, 0.5) - drawn), drawn, parse];
    console.log(
      `${name.padEnd(15)} ${[drags[0], at(good, 0), drag, at(good, 0.95), 1000 / drag].map(ms).join(" ")}  |${parts.map(ms).join(" ")} |` +
        `${[open, all, (1000 * opened.frames) / (open + all), svg].map(ms).join(" ")} | ${(engine.bytes() / 2 ** 20).toFixed(0)}   ` +
        `${hand.entity || "a corner"}, frame ${hand.frame + 1} of ${opened.frames}${refused ? `, ${refused} refused` : ""}`,
    );
  }
  console.log(`load ${load()}`);
}

async function timedAsync(act) {
  const start = performance.now();
  const value = await act();
  return [performance.now() - start, value];
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error);
  process.exitCode = 1;
});
