// What all parts of the page share. The same text runs in a page and in its workers.
"use strict";

/** The module with its memory. */
class Engine {
  constructor(module) {
    // Nothing of the browser is used; what a library would ask for (the time) is never called.
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      (imports[from] ??= {})[name] = () => 0;
    }
    this.exports = new WebAssembly.Instance(module, imports).exports;
  }

  /** The answer to a request, both as JSON. */
  ask(request) {
    const { memory, room, ask, answer_at, answer_length } = this.exports;
    const text = new TextEncoder().encode(JSON.stringify(request));
    const at = room(text.length);
    new Uint8Array(memory.buffer, at, text.length).set(text);
    ask();
    return JSON.parse(new TextDecoder().decode(new Uint8Array(memory.buffer, answer_at(), answer_length())));
  }

  /** What the running simulation does in the next periods: points of so many numbers, and impacts. */
  goOn(periods, samples, width = 3) {
    const { memory, go_on, numbers_at } = this.exports;
    const length = go_on(periods, samples);
    const numbers = new Float64Array(memory.buffer, numbers_at(), length);
    const points = numbers.slice(1, 1 + width * numbers[0]);
    return { points, impacts: numbers.slice(1 + width * numbers[0]) };
  }
}

/** A worker that always has the newest request next, and never more than one. */
function Desk(module, source) {
  const worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
  let busy = null, next = null, count = 0;
  const send = (one) => { busy = one; worker.postMessage({ id: (one.id = ++count), request: one.request }); };
  worker.onmessage = ({ data }) => {
    const { done } = busy;
    busy = null;
    if (next) send(next);
    next = null;
    done(data.answer);
  };
  worker.postMessage({ module });
  this.end = () => worker.terminate();
  this.ask = (request) => new Promise((done) => {
    const one = { request, done };
    if (busy) next = one; else send(one);
  });
}

/** A tag with attributes and children. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children);
  return element;
}

const button = (words, act, more = {}) => make("button", { type: "button", onclick: act, ...more }, words);

/** What is older than the sliders looks so, until it is no longer. */
const old = (element) => element.setAttribute("aria-busy", "true"), fresh = (element) => element.removeAttribute("aria-busy");

/** Whether drawings are for a phone. */
const narrow = () => innerWidth < 640;
const DAMAGED = "The link is damaged; this is another case.";

/** The module, which the page holds packed behind its length. */
function packedModule() {
  const packed = bytesOf(document.getElementById("live-module").textContent);
  return WebAssembly.compile(unlzma(packed.subarray(4), new DataView(packed.buffer).getUint32(0)));
}

// The Markdown of the program: a line, a sentence of it, and a row of a table.
const plain = (line) => line.replaceAll("`", "").replace(/\[(.+?)\]\(.*?\)/g, "$1").replace(/&#(\d+);/g, (_, code) => String.fromCharCode(code));
const sentence = (line) => make("p", {}, ...plain(line).split("**").map((part, k) => k % 2 ? make("strong", {}, part) : part));
const cells = (line) => line.split("|").slice(1, -1).map((cell) => plain(cell.trim()));
/** Sentences, and a table. */
function blocks(markdown, label = "Criteria") {
  const lines = markdown.split("\n").filter((line) => line), isRow = (line) => line.startsWith("|");
  const [heads, , ...rows] = lines.filter(isRow).map(cells);
  const row = (tag, cells) => make("tr", {}, ...cells.map((cell) => make(tag, {}, cell)));
  const table = heads && make("div", { class: "table", tabindex: 0, role: "region", "aria-label": label },
    make("table", {}, make("thead", {}, row("th", heads)), make("tbody", {}, ...rows.map((cells) => row("td", cells)))));
  const [first, ...others] = lines.filter((line) => !isRow(line)).map(sentence);
  return [first, table, ...others].filter(Boolean);
}

// The state as a part of the address: the text of the case, deflated, and of several modes the excitation of the sliders.
async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
async function linkTo(text, at) {
  const packed = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(text));
  const code = btoa(String.fromCharCode(...packed)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  return `${location.href.split("#")[0]}#case=${code}${at ? `&at=${at.load},${at.frequency},${at.amplitude}` : ""}`;
}
/** The state of an address; the text is empty where it is damaged. */
async function linked(hash = location.hash) {
  const parts = new URLSearchParams(hash.slice(1)), code = parts.get("case");
  if (code === null) return null;
  try {
    const bytes = Uint8Array.from(atob(code.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    const [load, frequency, amplitude] = parts.get("at")?.split(",").map(Number) ?? [];
    return { text: new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes)), at: load === undefined ? load : { load, frequency, amplitude } };
  } catch { return { text: "" }; }
}

/** The next round number. */
function round(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((step) => step * power >= value * (1 - 1e-9)) * power;
}

/** A value at a share of a slider or an axis, and the share of a value. */
const along = ({ range: [low, high], log }, share) => log ? low * (high / low) ** share : low + share * (high - low);
const share = ({ range: [low, high], log }, value) => log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);

const number = (value) => Number(value.toPrecision(3));

/** A canvas as large as on the screen, empty, and its size in pixels of the page. */
function sheet(canvas, height) {
  const dots = devicePixelRatio || 1, width = canvas.clientWidth;
  if (canvas.width !== Math.round(width * dots) || canvas.height !== Math.round(height * dots)) {
    canvas.style.height = `${height}px`;
    [canvas.width, canvas.height] = [width, height].map((side) => Math.round(side * dots));
  }
  const g = canvas.getContext("2d");
  g.setTransform(dots, 0, 0, dots, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = "13px system-ui, sans-serif";
  return { g, width, height };
}
