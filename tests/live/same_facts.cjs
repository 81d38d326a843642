// Every sequence in the page's engine: facts and SVGs are those of the program, byte for byte; and a
// hand's drags, which go on from a copied memory, show what their texts do in an engine of their own.
// Usage: node same_facts.cjs ENGINE RENDERED SCENARIO..., where `lantern render SCENARIO... --format svg
// -o RENDERED` has been.
const fs = require("fs");
const path = require("path");
const { Engine } = require("./engine.cjs");

const MOST_MB = 64; // of memory for any of them

// What tells of the files and the program, not of the frame.
const ownFacts = (json) => json.replace(/,\n"made_from": [\s\S]*$/, "\n}\n");
const ownSvg = (svg) => svg.replace(/<!-- Lantern made this[^\n]*\n$/, "").replace(/\bl[0-9a-f]{8}-/g, "l-");

function firstDifference(a, b) {
  const [x, y] = [a.split("\n"), b.split("\n")];
  const i = x.findIndex((line, k) => line !== y[k]);
  return `line ${i + 1}:\n  ${x[i]?.slice(0, 300)}\n  ${y[i]?.slice(0, 300)}`;
}

// Of a body on the last frame whose run is kept: how many drags, and how many differ.
function dragged(engine, other, name, frame) {
  const [side] = engine.ask({ do: "frame", index: frame }).facts[0];
  const entities = (side.bodies ?? []).slice(0, 8).map(([, body]) => `${side.name && side.name + "/"}body/${body}`);
  const entity = entities.find((one) => engine.ask({ do: "grab", frame, entity: one, x: 800, y: 400 }).kept);
  const differs = (entity ? [805, 830] : []).map((x) => {
    const drag = engine.ask({ do: "drag", x, y: 410 });
    const opened = other.ask({ do: "open", text: drag.text, name });
    const whole = opened.refused ? opened : other.ask({ do: "frame", index: drag.index });
    if (`${whole.hashes}` === `${drag.hashes}`) return false;
    console.log(`${name}, frame ${frame}, ${entity} dragged to ${x}: ${drag.hashes}, not ${whole.said ?? whole.hashes}`);
    return true;
  });
  return [differs.length, differs.filter(Boolean).length];
}

async function main([wasm, rendered, ...scenarios]) {
  const module = await WebAssembly.compile(fs.readFileSync(wasm));
  let [frames, different, most, drags] = [0, 0, 0, 0];
  for (const file of scenarios) {
    const name = path.basename(file, ".toml");
    const engine = await Engine.start(module);
    const opened = engine.ask({ do: "open", text: fs.readFileSync(file, "utf8"), name: file });
    if (opened.refused) throw new Error(`${file}: ${opened.said}`);
    for (const warning of opened.unmet) throw new Error(`${file}: ${warning.message}`);
    for (let index = 0; index < opened.frames; index++) {
      const native = path.join(rendered, name, `${name}_${String(index).padStart(4, "0")}`);
      const pairs = {
        facts: [ownFacts(fs.readFileSync(`${native}.json`, "utf8")), engine.ask({ do: "facts", index }).facts],
        picture: [ownSvg(fs.readFileSync(`${native}.svg`, "utf8")), engine.ask({ do: "svg", index, width: 1600, height: 900 }).svg],
      };
      frames += 1;
      for (const [what, [program, page]] of Object.entries(pairs)) {
        if (program === page) continue;
        different += 1;
        console.log(`${name}, frame ${index}: another ${what}, ${firstDifference(program, page)}`);
        break;
      }
    }
    const [more, other] = dragged(engine, await Engine.start(module), file, opened.frames - 1);
    drags += more;
    different += other;
    most = Math.max(most, engine.bytes());
  }
  console.log(`${frames} frames, ${drags} drags, ${different} differ; at most ${(most / 2 ** 20).toFixed(0)} MB of ${MOST_MB}`);
  if (frames === 0 || drags === 0 || different > 0 || most > MOST_MB * 2 ** 20) process.exitCode = 1;
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error);
  process.exitCode = 1;
});
