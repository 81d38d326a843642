// The engine of a live page. It starts, and runs the scenario that is seen first, before the rest of
// the page is read.

const MOST_SECONDS = 10; // for a run

const UPRIGHT = matchMedia("(max-width: 50rem) and (orientation: portrait)");

// How large pictures are, in page units: of an upright phone as high as there is room beside the
// words, else as a lesson is recorded.
function sheet() {
  if (!UPRIGHT.matches || new URLSearchParams(location.search).has("embed")) return {};
  const ratio = Math.max(0.65, Math.min(1.15, innerWidth / (innerHeight - 380)));
  return { width: 900, height: Math.round(900 / ratio) };
}

// What the engine could not bear.
class Ended extends Error {}

// The Worker. Where it takes too long, or fails, it is made anew; the request that `first()` gives brings
// it to where it was.
class Engine {
  constructor(packed, script, first) {
    this.from = { packed };
    this.script = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    this.first = first;
    this.line = this.started = this.start();
    this.started.catch(() => {}); // for those who wait for it
  }

  // The answer to the first request.
  async start() {
    this.worker = new Worker(this.script);
    const { module, answer } = await this.send({ ...this.from, first: JSON.stringify(this.first()) }, 6 * MOST_SECONDS);
    this.from = { module };
    return JSON.parse(answer);
  }

  // One request after the other. The time is that of this one alone.
  ask(request, seconds = MOST_SECONDS) {
    const asked = this.line.then(() => this.answer(request, seconds));
    this.line = asked.catch(() => {});
    return asked;
  }

  async answer(request, seconds) {
    try {
      const { answer } = await this.send({ ask: JSON.stringify(request) }, seconds);
      return JSON.parse(answer);
    } catch (error) {
      await this.start();
      throw error;
    }
  }

  send(message, seconds) {
    const { worker } = this;
    return new Promise((resolve, reject) => {
      const end = (why) => {
        clearTimeout(timer);
        worker.terminate();
        reject(new Ended(why));
      };
      const late = () => end(`This took longer than ${seconds} s and was ended.`);
      const timer = setTimeout(late, 1000 * seconds);
      worker.onerror = () => end("The engine could not be started.");
      worker.onmessage = ({ data }) => {
        if (data.failed) return end(`The engine failed and was started again: ${data.failed}`);
        clearTimeout(timer);
        resolve(data);
      };
      worker.postMessage(message);
    });
  }
}

const textIn = (id) => document.getElementById(id)?.textContent;
const firstScenario = JSON.parse(textIn("scenario"));
const wordTable = JSON.parse(textIn("word-table") ?? "null"); // null: English
const engine = new Engine(textIn("engine-packed") ?? window.lanternEngine, textIn("worker-script"), () =>
  ({ do: "open", words: wordTable, text: firstScenario.text, name: firstScenario.name, lesson: firstScenario.text, ...sheet() }));
