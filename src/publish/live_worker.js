// The engine in a Worker: it is unpacked and started here, and answers one request after the other.

let answer; // of a request's JSON, as JSON

// What wasi-libc asks of a system that is not there: a clock, and words for the console.
function system(memory) {
  const view = () => new DataView(memory().buffer);
  const none = (...places) => {
    for (const place of places) view().setUint32(place, 0, true);
    return 0;
  };
  return {
    environ_sizes_get: none,
    args_sizes_get: none,
    environ_get: () => 0,
    args_get: () => 0,
    clock_time_get: (clock, precision, place) => {
      view().setBigUint64(place, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    fd_write: (file, parts, count, written) => {
      let bytes = 0;
      for (let i = 0; i < count; i++) bytes += view().getUint32(parts + 8 * i + 4, true);
      view().setUint32(written, bytes, true);
      return 0;
    },
    proc_exit: (code) => {
      throw new Error(`the engine ended with ${code}`);
    },
  };
}

async function instanceOf(module) {
  let exports;
  const known = system(() => exports.memory);
  const imports = {};
  for (const { module: room, name } of WebAssembly.Module.imports(module))
    (imports[room] ??= {})[name] = known[name] ?? (() => 8); // there is no such file
  ({ exports } = await WebAssembly.instantiate(module, imports));
  exports._initialize?.();
  return exports;
}

// Of base64 of a zlib stream: it is compiled while it is unpacked.
async function unpacked(packed) {
  const { body } = Uint8Array.fromBase64 ? new Response(Uint8Array.fromBase64(packed.trim())) : await fetch(`data:;base64,${packed.trim()}`);
  const headers = { "Content-Type": "application/wasm" };
  return WebAssembly.compileStreaming(new Response(body.pipeThrough(new DecompressionStream("deflate")), { headers }));
}

// With the answer to the first request, if there is one.
async function start({ packed, module, first }) {
  module ??= await unpacked(packed);
  const engine = await instanceOf(module);
  const memory = () => new Uint8Array(engine.memory.buffer);
  const ask = (request) => {
    const bytes = new TextEncoder().encode(request);
    const room = engine.room(bytes.length);
    memory().set(bytes, room);
    const length = engine.ask(room, bytes.length);
    engine.leave(room);
    return new TextDecoder().decode(memory().subarray(engine.answer_at(), engine.answer_at() + length));
  };
  // A drag goes on with the run that its grab has begun, and uses it up: the next one finds the memory
  // as it was, or has all begun again if there is more of it now.
  let kept = null;
  const keep = (grab) => {
    const said = ask(grab);
    kept = said.endsWith('"kept": true}') ? { grab, memory: memory().slice(), used: false } : null;
    return said;
  };
  answer = (request) => {
    if (!request.startsWith('{"do":"drag"')) return keep(request);
    if (kept?.used && kept.memory.length < memory().length) keep(kept.grab);
    else if (kept?.used) memory().set(kept.memory);
    if (kept) kept.used = true;
    return ask(request);
  };
  return { module, answer: first && answer(first) };
}

onmessage = async ({ data }) => {
  try {
    postMessage(data.ask === undefined ? await start(data) : { answer: answer(data.ask) });
  } catch (error) {
    postMessage({ failed: String(error) });
  }
};
