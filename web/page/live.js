// The live page: sliders over a case file of one mode (one.js) or of several modes or absorbers (several.js). What a frame has time for
// is computed in the page; the rest follows from workers, and looks old until then.
/** Periods after which the simulation of a case is first seen: what is said of it is of what comes after the transient. */
const SETTLED = 400;
/** Figures that stand before the fold. */
const FIRST = ["amplitude", "map"];
/** Sliders behind a fold. */
const FURTHER = ["mass_ratio", "damping", "damping_ratio"];

function Live(place) {
  // A page that has this one in a frame may ask for some figures and sliders alone, and for a preset by a word of its name:
  // ?show=sim&sliders=restitution&begin=symmetric.
  const asks = new URLSearchParams(location.search), list = (key) => asks.get(key)?.split(",");
  const shown = list("show"), chosen = list("sliders");
  const wanted = (name) => !shown || shown.includes(name);
  document.body.classList.toggle("live-small", Boolean(shown));
  // The case as text, of several modes the load with the excitation of the sliders, the sliders, and what was before and after.
  let text = "", at, controls = [], notes = [], past = [], future = [], asked = 0, waiting = null;
  const values = new Map(), sliders = new Map(), figures = new Map();
  let here, desks, compiled, keeps = false, written, choose, loads, kind;
  const status = make("p", { class: "live-status", role: "status" });
  const problem = make("p", { class: "live-problem", role: "alert", hidden: true });
  const headline = make("p", { class: "live-headline", role: "status" });
  // What the search has found stands beside the verdict, until the case is another.
  const advice = make("p", { class: "live-advice", role: "status" });
  const verdict = make("div", { class: "live-verdict", "aria-live": "polite" });
  const decision = make("div", { class: "live-decision", "aria-live": "polite" });
  const panel = make("form", { class: "live-sliders", "aria-label": "Sliders", onsubmit: (e) => e.preventDefault() });
  const board = make("div", { class: "live-figures" });
  // One understands the first figures first; the others are a fold deeper.
  const deeper = make("div", { class: "live-figures" });
  const fold = make("details", { class: "live-deeper" }, make("summary", {}, "More figures: manifold, motions, return map"), deeper);
  const file = make("textarea", { rows: 16, spellcheck: "false", "aria-label": "Case file" });
  const undo = button("↶", () => step(past, future), { disabled: true, "aria-label": "Undo", title: "Undo" });
  const redo = button("↷", () => step(future, past), { disabled: true, "aria-label": "Redo", title: "Redo" });
  // The first figures use words that need no theory; pages that explain it show theirs.
  const detail = make("input", { type: "checkbox", onchange: () => follow([]) });
  const theory = make("label", { class: "live-detail" }, detail, " Name the theory's limits, with exact orbits beside them");
  const look = () => ({ narrow: narrow(), plain: !shown && !detail.checked });
  const running = new Running(() => here, complain);
  const frames = [];
  // What a kind of case has of the page.
  const page = {
    figures, sliders, headline, advice, verdict, decision, board, wanted, shown, ask, draw, adopt, move, pause, settle, complain,
    request: () => ({ text, at, ...look() }), controls: () => controls, moving: () => moving, desks: () => desks,
    desk: () => new Desk(compiled, document.getElementById("live-script").textContent),
  };
  const kinds = [new One(page), new Several(page)];
  [kind] = kinds;

  // For tests and for whoever looks into the console.
  place.live = { ask: (request) => desks[1].ask(request), frames, settled, link: () => linkTo(text, at), running: () => running.state(), engine: () => here, get text() { return text; }, get at() { return at; } };

  this.begin = async () => {
    try {
      compiled = await packedModule();
      here = new Engine(compiled);
      desks = [page.desk(), page.desk()];
    } catch (error) {
      place.replaceChildren(make("p", { class: "live-problem" }, `This page needs a browser with WebAssembly (${error.message}).`));
      return;
    }
    const presets = here.ask({ ask: "presets" });
    const parts = [["verdict", headline], ["verdict", advice], ["running", running.figure], ["verdict", verdict], ["decision", decision]].filter(([name]) => wanted(name)).map(([, part]) => part);
    place.replaceChildren(bar(presets), status, make("div", { class: "live-columns" },
      make("div", { class: "live-left" }, problem, panel), make("div", {}, ...parts, board, ...(shown ? [] : [theory, fold]))));
    // In a report the case is its own.
    const own = document.getElementById("live-case")?.textContent;
    const link = await linked(), first = Math.max(0, presets.findIndex(([name]) => name.includes(asks.get("begin") ?? "")));
    open(link?.text || (own ?? presets[first][1]), link?.at);
    if (!link?.text && own === undefined) choose.value = String(first);
    if (link?.text === "") complain([{ message: DAMAGED }]);
    // A link that is pasted into an open page, and the browser's way back.
    addEventListener("hashchange", async ({ newURL }) => {
      // By now the address may be that of the case before again.
      const other = await linked(new URL(newURL).hash);
      if (other?.text === "") complain([{ message: DAMAGED }]);
      if (!other?.text || state(other) === state({ text, at })) return;
      remember();
      open(other.text, other.at);
    });
    // A frame is as high as what is in it.
    const main = document.querySelector("main");
    if (shown && parent !== self) new ResizeObserver(() => parent.postMessage({ height: Math.ceil(main.getBoundingClientRect().height) }, "*")).observe(main);
    // A page of its own keeps its state in its address, so that a reload finds it again.
    keeps = own === undefined && !shown;
    settled().then(warm);
    addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.target.matches("input[type=number], textarea")) return;
      event.preventDefault();
      event.shiftKey ? step(future, past) : step(past, future);
    });
  };

  function bar(presets) {
    choose = make("select", { onchange: () => { const of = choose.value; if (of !== "") { remember(); open(presets[of][1]); choose.value = of; } } },
      make("option", { value: "" }, "your case"), ...presets.map(([name], k) => make("option", { value: k }, name)));
    loads = make("select", { onchange: () => { remember(); open(text, { load: +loads.value }); } });
    const use = button("Use this case file", () => { remember(); open(file.value); });
    const paste = make("details", { class: "live-file", ontoggle: () => { file.value = text; } },
      make("summary", {}, "Case file: copy or paste"), file, use, " ", button("Copy as case file", () => copy(text, "The case file is in the clipboard.")));
    return make("div", { class: "live-bar" }, make("label", {}, "Begin with ", choose), make("label", {}, "Load ", loads), kinds[0].best, undo, redo,
      button("Copy link", async () => copy(await linkTo(text, at), "The link is in the clipboard; it holds the whole case.")),
      paste);
  }

  function say(words) { status.textContent = words; }
  const changed = (name) => name.endsWith(", changed") ? name : `${name}, changed`;
  /** What the menu calls a case that is none of its own. */
  function named(name) { [choose.value, choose.options[0].textContent] = ["", name]; }
  /** The case is no longer that of its name. */
  function renamed(name = choose.selectedOptions[0].textContent) {
    named(changed(name));
    panel.firstChild.textContent = changed(place.dataset.title);
  }

  async function copy(words, done) {
    try { await navigator.clipboard.writeText(words); say(done); }
    catch { say("The browser does not let this page copy. Open “Case file: copy or paste” and copy from there."); }
  }

  const state = ({ text, at }) => JSON.stringify([text, at]);
  function remember() {
    if (text && !(past.length && state(past.at(-1)) === state({ text, at }))) past.push({ text, at });
    future.length = 0;
    buttons();
  }
  function buttons() { undo.disabled = !past.length; redo.disabled = !future.length; }
  function step(from, to) {
    if (!from.length) return;
    settle();
    to.push({ text, at });
    const one = from.pop();
    open(one.text, one.at);
    buttons();
  }

  function complain(problems) {
    problem.hidden = !problems;
    problem.textContent = (problems ?? []).map((one) =>
      [one.line && `Line ${one.line}: `, one.message, one.expected && `; ${one.expected}`, one.help && ` (${one.help})`]
        .filter(Boolean).join("")).join("\n");
  }

  /** Shows another case, of several modes under one of its loads: its sliders, then everything else. */
  function open(wanted, where, goesOn = false) {
    const answer = here.ask({ ask: "open", text: wanted, at: where });
    complain(answer.problems);
    if (answer.problems) {
      // No verdict stands there for a case that was refused.
      fresh(decision);
      decision.replaceChildren();
      headline.replaceChildren();
      verdict.replaceChildren(make("p", {}, "The case was refused. Sliders and figures are those of the case before."));
      return;
    }
    const before = new Map(controls.map((one) => [one.key, one])), other = answer.text !== text;
    ({ text, at, controls, notes } = answer);
    if (kind !== kinds[+Boolean(at)]) {
      for (const one of figures.values()) one.remove();
      figures.clear();
      kind = kinds[+Boolean(at)];
    }
    // A slider stays as it is where the case only goes on.
    for (const one of goesOn ? controls : []) {
      const { range, log, unit } = before.get(one.key) ?? one;
      if (range[0] <= one.value && one.value <= range[1]) Object.assign(one, { range, log, unit });
    }
    if (other) named("your case");
    loads.parentElement.hidden = !(answer.loads?.length > 1);
    loads.replaceChildren(...(answer.loads ?? []).map((words, k) => make("option", { value: k, selected: k === at.load }, words)));
    for (const one of [kinds[0].best, theory, fold]) one.hidden = Boolean(at);
    forget();
    decision.replaceChildren();
    [board, decision].forEach(fresh);
    place.dataset.title = answer.title;
    sliders.clear();
    const rows = controls.map(slider), isFirst = (_, k) => !FURTHER.includes(controls[k].key) || chosen?.includes(controls[k].key);
    panel.replaceChildren(make("h3", {}, answer.title), ...rows.filter(isFirst),
      make("details", { class: "live-further", hidden: rows.every(isFirst) || Boolean(chosen) }, make("summary", {}, "Mass and damping"), ...rows.filter((row, k) => !isFirst(row, k))));
    rows.forEach((row, k) => { row.hidden = chosen && !chosen.includes(controls[k].key); });
    kind.open(answer);
    running.change({ text, at }, "push", SETTLED);
    change(new Map());
  }

  /** A search is of no use to another case. */
  function forget() {
    advice.textContent = "";
    kinds[0].end();
  }

  /** The case with what a search has found in it. */
  function adopt(better) {
    const name = choose.selectedOptions[0].textContent;
    remember();
    open(better, at, true);
    renamed(name);
  }

  function slider(of) {
    const id = `live-${of.key}`, name = `${of.name}\u00a0${of.symbol}`;
    const range = make("input", { id, type: "range", min: 0, max: 1000, step: 1, oninput: () => move(of, along(of, range.value / 1000)), onchange: pause });
    const field = make("input", { type: "number", step: "any", "aria-label": `${name} in ${of.unit.symbol || "1"}`,
      onchange: () => { settle(); typed(of, field.value.trim() === "" ? NaN : field.value * of.unit.size); settle(); } });
    const good = make("span", { class: "live-good", hidden: true }, make("span"), make("small"));
    sliders.set(of.key, { range, field, good });
    return make("div", { class: "live-slider" }, make("label", { for: id }, name),
      make("span", { class: "live-field" }, field, make("span", {}, of.unit.symbol)), range, good);
  }

  /** A value from a field: a page cannot wait for what is far from any structure. */
  function typed(of, value) {
    const [low, high] = of.log ? [of.range[0] / 10, of.range[1] * 10] : of.key === "frequency" ? [0.2 * of.range[0], 5 * of.range[1]] : of.range;
    if (value >= low && value <= high) return move(of, value);
    const words = [low, high].map((end) => `${Number((end / of.unit.size).toPrecision(4))} ${of.unit.symbol}`.trim());
    show(controls, true);
    complain([{ message: `The ${of.name} goes from ${words.join(" to ")} here; for other values edit the case file.` }]);
  }

  // The first value of a movement is one step of undo, however far it goes; key presses in quick succession are one.
  let moving = false, pausing;
  function move(of, value) {
    if (!Number.isFinite(value)) return;
    if (!moving) { remember(); moving = true; }
    values.set(of.key, value);
    if (waiting === null) waiting = requestAnimationFrame(() => { waiting = null; const some = new Map(values); values.clear(); change(some); });
  }
  function settle() {
    clearTimeout(pausing);
    moving = false;
    kind.rest();
  }
  function pause() { clearTimeout(pausing); pausing = setTimeout(settle, 700); }

  /** The case with other values: at once what is cheap, the rest when it comes. */
  function change(some) {
    const begin = performance.now();
    const answer = here.ask({ ask: "change", ...page.request(), values: Object.fromEntries(some) });
    complain(answer.problems);
    if (answer.problems) return show(controls, true);
    const other = answer.text !== text, moves = other || state(answer) !== state({ text, at });
    ({ text, at } = answer);
    show(answer.controls);
    for (const one of answer.figures ?? []) draw(one);
    if (moves) {
      forget();
      running.change({ text, at }, "here");
    }
    if (other) renamed();
    follow([...some.keys()]);
    frames.push(performance.now() - begin);
    if (frames.length > 1000) frames.shift();
  }

  /** A browser makes often used code fast; the first movement of a slider finds it so. */
  function warm(left = 80) {
    if (left === 0 || past.length) return;
    (self.requestIdleCallback ?? setTimeout)(() => {
      here.ask({ ask: "change", text, at, values: {} });
      warm(left - 1);
    });
  }

  function show(now, all = false) {
    for (const one of now) {
      const of = controls.find(({ key }) => key === one.key), { range, field } = sliders.get(one.key);
      [of.value, of.words] = [one.value, one.words];
      range.value = 1000 * share(of, one.value);
      range.setAttribute("aria-valuetext", one.words);
      if (all || document.activeElement !== field) field.value = Number((one.value / of.unit.size).toPrecision(4));
    }
    kind.moved();
    if (document.activeElement !== file) file.value = text;
  }

  /** What workers make, after these sliders have moved. */
  function follow(keys) {
    asked += 1;
    if (!shown) [verdict, headline].forEach(old);
    kind.follow(keys, (answer) => {
      if (answer.problems) return complain(answer.problems);
      const { tone, first, rest } = kind.said(answer);
      headline.className = `live-headline ${tone ?? ""}`;
      headline.replaceChildren(...first);
      verdict.replaceChildren(...rest, ...notes.map((note) => make("p", { class: "live-note" }, note)));
      [verdict, headline].forEach(fresh);
      const version = asked;
      if (keeps) written = linkTo(text, at).then((address) => { if (version === asked) history.replaceState(null, "", address); });
    });
  }

  /** What a worker says of the case; nothing where the case is another by then. */
  async function ask(desk, what, act) {
    const version = asked, answer = await desk.ask({ ask: what, ...page.request() });
    if (version === asked) act(answer);
  }

  /** Until everything on the page belongs to the sliders. */
  async function settled() {
    while (waiting !== null || place.querySelector("[aria-busy=true]")) await new Promise((done) => setTimeout(done, 5));
    await written;
  }

  function draw({ name, svg, title, caption }) {
    if (!figures.has(name)) {
      const one = make("figure", { "data-name": name }, make("div", { class: "drawing", tabindex: 0, role: "region" }), make("figcaption"));
      figures.set(name, one);
      const order = ["amplitude", "map", "sim", "ranges", "response", "motion-1", "return-map-1", "plane"];
      const rank = (name) => (order.indexOf(name) + 99) % 99;
      const sorted = [...figures].sort(([a], [b]) => rank(a) - rank(b)), isFirst = ([name]) => shown || at || FIRST.includes(name);
      board.append(...sorted.filter(isFirst).map(([, figure]) => figure));
      deeper.append(...sorted.filter((one) => !isFirst(one)).map(([, figure]) => figure));
    }
    const figure = figures.get(name);
    figure.hidden = !wanted(name);
    figure.firstChild.innerHTML = svg;
    figure.firstChild.setAttribute("aria-label", title);
    figure.lastChild.textContent = caption.replace(/\$|\\|\*/g, "");
    fresh(figure.lastChild);
    fresh(figure);
    return figure;
  }
}

if (typeof document === "undefined") {
  let engine;
  self.onmessage = ({ data }) => {
    if (data.module) engine = new Engine(data.module);
    else self.postMessage({ id: data.id, answer: engine.ask(data.request) });
  };
} else {
  document.querySelectorAll("[data-live]").forEach((place) => {
    const live = new Live(place);
    // In a report it may never come into sight.
    new IntersectionObserver(([one], eye) => {
      if (!one.isIntersecting) return;
      eye.disconnect();
      live.begin();
    }, { rootMargin: "300px" }).observe(place);
    if (location.hash.startsWith("#case=")) place.scrollIntoView();
  });
}
