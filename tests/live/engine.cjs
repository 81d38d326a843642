// The page's engine in node: the worker's own script, with nothing of a page around it.
const fs = require("fs");
const path = require("path");
const vm = require("vm");

const WORKER = path.join(__dirname, "../../src/publish/live_worker.js");

class Engine {
  // `wasm`: the bytes of lantern.wasm, or its module.
  static async start(wasm) {
    const engine = new Engine();
    const context = vm.createContext({ WebAssembly, TextEncoder, TextDecoder, Uint8Array, DataView, performance });
    vm.runInContext(fs.readFileSync(WORKER, "utf8") + "\nglobalThis.asked = (q) => answer(q);", context);
    const { instanceOf, system } = context;
    context.instanceOf = async (module) => (engine.exports = await instanceOf(module));
    context.system = (memory) => ({ ...system(memory), fd_write: (...told) => engine.hear(memory(), ...told) });
    await context.start({ module: wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm) });
    return Object.assign(engine, { asked: context.asked, words: "" });
  }

  // `request`: an object, or JSON that may be none.
  ask(request) {
    return JSON.parse(this.asked(typeof request === "string" ? request : JSON.stringify(request)));
  }
  // Of a request that may be no UTF-8.
  askBytes(bytes) {
    const room = this.exports.room(bytes.length);
    new Uint8Array(this.exports.memory.buffer, room, bytes.length).set(bytes);
    const length = this.exports.ask(room, bytes.length);
    this.exports.leave(room);
    const answer = new Uint8Array(this.exports.memory.buffer, this.exports.answer_at(), length);
    return JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(answer));
  }

  // What the engine's memory has grown to: it does not shrink.
  bytes() {
    return this.exports.memory.buffer.byteLength;
  }

  // What a broken engine says before it ends.
  hear(memory, file, parts, count, written) {
    const view = new DataView(memory.buffer);
    let bytes = 0;
    for (let i = 0; i < count; i++) {
      const [at, length] = [view.getUint32(parts + 8 * i, true), view.getUint32(parts + 8 * i + 4, true)];
      this.words += Buffer.from(memory.buffer, at, length).toString();
      bytes += length;
    }
    view.setUint32(written, bytes, true);
    return 0;
  }
}

module.exports = { Engine };
