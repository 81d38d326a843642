// The page's engine in node: the worker's own script, with nothing of a page around it.
const fs = require("fs");
const path = require("path");
const vm = require("vm");

const WORKER = path.join(__dirname, "../../src/publish/live_worker.js");

class Engine {
  // `wasm`: the bytes of lantern.wasm.
  static async start(wasm) {
    const context = vm.createContext({ WebAssembly, TextEncoder, TextDecoder, Uint8Array, DataView, performance, console });
    vm.runInContext(fs.readFileSync(WORKER, "utf8") + "\nglobalThis.instanceOf = instanceOf; globalThis.start = start; globalThis.asked = (q) => answer(q);", context);
    const module = await WebAssembly.compile(wasm);
    await context.start({ module });
    return Object.assign(new Engine(), { context });
  }
  ask(request) {
    return JSON.parse(this.context.asked(JSON.stringify(request)));
  }
  bytes() {
    return this.context.memoryBytes?.() ?? 0;
  }
}

module.exports = { Engine };
