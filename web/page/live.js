// The live page: sliders over a case file. What a frame has time for is computed in the page; map and study follow from workers,
// and look old until then.
/** Periods after which the simulation of a case is first seen: its verdict is of what comes after the transient. */
const SETTLED = 400;
/** Figures that stand before the fold. */
const FIRST = ["amplitude", "map"];

function Live(place) {
  // The case as text, its sliders, and what was before and after it.
  // A page that has this one in a frame may ask for some figures and sliders alone, and for a preset by a word of its name:
  // ?show=sim&sliders=restitution&begin=symmetric.
  const asks = new URLSearchParams(location.search), list = (key) => asks.get(key)?.split(",");
  const shown = list("show"), chosen = list("sliders");
  const wanted = (name) => !shown || shown.includes(name);
  document.body.classList.toggle("live-small", Boolean(shown));
  let text = "", controls = [], notes = [], past = [], future = [], asked = 0, waiting = null;
  const values = new Map(), sliders = new Map(), figures = new Map();
  let here, desks, compiled, stop = null, judge = null, keeps = false, judges = false, written, choose;
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
  const button = (words, act, more = {}) => make("button", { type: "button", onclick: act, ...more }, words);
  const best = button("Best clearance", search);
  const undo = button("↶", () => step(past, future), { disabled: true, "aria-label": "Undo", title: "Undo" });
  const redo = button("↷", () => step(future, past), { disabled: true, "aria-label": "Redo", title: "Redo" });
  // The first figures use words that need no theory; pages that explain it show theirs.
  const detail = make("input", { type: "checkbox", onchange: () => follow() });
  const look = () => ({ narrow: narrow(), plain: !shown && !detail.checked });
  const running = new Running(() => here, say);
  const frames = [];

  // For tests and for whoever looks into the console.
  place.live = { ask: (request) => desks[1].ask(request), frames, settled, link: () => linkTo(text), running: () => running.state(), engine: () => here, get text() { return text; } };

  this.begin = async () => {
    try {
      const module = await packedModule();
      here = new Engine(module);
      compiled = module;
      const source = document.getElementById("live-script").textContent;
      desks = [new Desk(module, source), new Desk(module, source)];
    } catch (error) {
      place.replaceChildren(make("p", { class: "live-problem" }, `This page needs a browser with WebAssembly (${error.message}).`));
      return;
    }
    const presets = here.ask({ ask: "presets" });
    const parts = [["verdict", headline], ["verdict", advice], ["running", running.figure], ["verdict", verdict], ["decision", decision]].filter(([name]) => wanted(name)).map(([, part]) => part);
    place.replaceChildren(bar(presets), status, make("div", { class: "live-columns" },
      make("div", { class: "live-left" }, problem, panel), make("div", {}, ...parts, board, ...(shown ? [] : [make("label", { class: "live-detail" }, detail, " Name the theory's limits, with exact orbits beside them"), fold]))));
    const own = document.getElementById("live-case")?.textContent;
    const link = await linked(), first = Math.max(0, presets.findIndex(([name]) => name.includes(asks.get("begin") ?? "")));
    open(link || (own ?? presets[first][1]));
    if (!link && own === undefined) choose.value = String(first);
    if (link === "") complain([{ message: DAMAGED }]);
    // A link that is pasted into an open page, and the browser's way back.
    addEventListener("hashchange", async ({ newURL }) => {
      // By now the address may be that of the case before again.
      const other = await linked(new URL(newURL).hash);
      if (other === "") complain([{ message: DAMAGED }]);
      if (!other || other === text) return;
      remember();
      open(other);
    });
    // A frame is as high as what is in it.
    const page = document.querySelector("main");
    if (shown && parent !== self) new ResizeObserver(() => parent.postMessage({ height: Math.ceil(page.getBoundingClientRect().height) }, "*")).observe(page);
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
    const use = button("Use this case file", () => { remember(); open(file.value); });
    const paste = make("details", { class: "live-file", ontoggle: () => { file.value = text; } },
      make("summary", {}, "Case file: copy or paste"), file, use, " ", button("Copy as case file", () => copy(text, "The case file is in the clipboard.")));
    return make("div", { class: "live-bar" }, make("label", {}, "Begin with ", choose), best, undo, redo,
      button("Copy link", async () => copy(await linkTo(text), "The link is in the clipboard; it holds the whole case.")),
      paste);
  }

  function say(words) { status.textContent = words; }
  const changed = (name) => name.endsWith(", changed") ? name : `${name}, changed`;
  /** What the menu calls a case that is none of its own. */
  function named(name) { [choose.value, choose.options[0].textContent] = ["", name]; }

  async function copy(words, done) {
    try { await navigator.clipboard.writeText(words); say(done); }
    catch { say("The browser does not let this page copy. Open “Case file: copy or paste” and copy from there."); }
  }

  function remember() { if (text && past.at(-1) !== text) past.push(text); future.length = 0; buttons(); }
  function buttons() { undo.disabled = !past.length; redo.disabled = !future.length; }
  function step(from, to) {
    if (!from.length) return;
    settle();
    to.push(text);
    open(from.pop());
    buttons();
  }

  function complain(problems) {
    problem.hidden = !problems;
    problem.textContent = (problems ?? []).map((one) =>
      [one.line && `Line ${one.line}: `, one.message, one.expected && `; ${one.expected}`, one.help && ` (${one.help})`]
        .filter(Boolean).join("")).join("\n");
  }

  /** Shows another case: its sliders, then everything else. */
  function open(wanted, goesOn = false) {
    const answer = here.ask({ ask: "open", text: wanted });
    complain(answer.problems);
    if (answer.problems) {
      // No verdict stands there for a case that was refused.
      decided([]);
      headline.replaceChildren();
      verdict.replaceChildren(make("p", {}, "The case was refused. Sliders and figures are those of the case before."));
      return;
    }
    const before = new Map(controls.map((one) => [one.key, one]));
    ({ text, controls } = answer);
    // A slider stays as it is where the case only goes on.
    for (const one of goesOn ? controls : []) {
      const { range, log, unit } = before.get(one.key) ?? one;
      if (range[0] <= one.value && one.value <= range[1]) Object.assign(one, { range, log, unit });
    }
    named("your case");
    advice.textContent = "";
    place.dataset.title = answer.title;
    sliders.clear();
    const rows = controls.map(slider), first = ["clearance", "restitution", "amplitude", "frequency", ...(chosen ?? [])];
    const isFirst = (_, k) => first.includes(controls[k].key);
    panel.replaceChildren(make("h3", {}, answer.title), ...rows.filter(isFirst),
      make("details", { class: "live-further", hidden: Boolean(chosen) }, make("summary", {}, "Mass and damping"), ...rows.filter((row, k) => !isFirst(row, k))));
    rows.forEach((row, k) => { row.hidden = chosen && !chosen.includes(controls[k].key); });
    [notes, judges] = [answer.notes, answer.judges];
    running.change(text, "push", SETTLED);
    change(new Map());
  }

  function slider(of) {
    const id = `live-${of.key}`;
    const range = make("input", { id, type: "range", min: 0, max: 1000, step: 1, oninput: () => move(of, at(of, range.value / 1000)), onchange: pause });
    const field = make("input", { type: "number", step: "any", "aria-label": `${of.name} in ${of.unit.symbol || "1"}`,
      onchange: () => { settle(); typed(of, field.value.trim() === "" ? NaN : field.value * of.unit.size); } });
    const good = make("span", { class: "live-good", hidden: true }, make("span"), make("small"));
    sliders.set(of.key, { range, field, good });
    return make("div", { class: "live-slider" }, make("label", { for: id }, `${of.name} ${of.symbol}`),
      make("span", { class: "live-field" }, field, make("span", {}, of.unit.symbol)), range, good);
  }
  function at({ range: [low, high], log }, part) { return log ? low * (high / low) ** part : low + part * (high - low); }
  function part({ range: [low, high], log }, value) {
    return log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
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
  let moving = false, pausing, skipped = false;
  function move(of, value) {
    if (!Number.isFinite(value)) return;
    if (!moving) { remember(); moving = true; }
    values.set(of.key, value);
    if (waiting === null) waiting = requestAnimationFrame(() => { waiting = null; const some = new Map(values); values.clear(); change(some); });
  }
  function settle() {
    clearTimeout(pausing);
    moving = false;
    if (skipped) drawMap();
  }
  function pause() { clearTimeout(pausing); pausing = setTimeout(settle, 700); }

  /** The case with other values: at once what is cheap, the rest when it comes. */
  function change(some) {
    const begin = performance.now();
    const answer = here.ask({ ask: "change", text, values: Object.fromEntries(some), ...look() });
    complain(answer.problems);
    if (answer.problems) return show(controls, true);
    const other = answer.text !== text;
    text = answer.text;
    show(answer.controls);
    for (const one of answer.figures) draw(one);
    if (other) {
      advice.textContent = "";
      running.change(text, "here");
      // It is no longer the case of that name.
      named(changed(choose.selectedOptions[0].textContent));
      panel.firstChild.textContent = changed(place.dataset.title);
    }
    const onlyCase = [...some.keys()].every((key) => key === "frequency" || key === "clearance");
    follow(some.size > 0 && onlyCase);
    frames.push(performance.now() - begin);
    if (frames.length > 1000) frames.shift();
  }

  /** A browser makes often used code fast; the first movement of a slider finds it so. */
  function warm(left = 80) {
    if (left === 0 || past.length) return;
    (self.requestIdleCallback ?? setTimeout)(() => {
      here.ask({ ask: "change", text, values: {} });
      warm(left - 1);
    });
  }

  function show(now, all = false) {
    for (const one of now) {
      const of = controls.find(({ key }) => key === one.key), { range, field } = sliders.get(one.key);
      [of.value, of.words] = [one.value, one.words];
      range.value = 1000 * part(of, one.value);
      range.setAttribute("aria-valuetext", one.words);
      if (all || document.activeElement !== field) field.value = Number((one.value / of.unit.size).toPrecision(4));
    }
    mark();
    if (document.activeElement !== file) file.value = text;
  }

  /** What workers make. The areas do not depend on the case's own frequency and clearance. */
  async function follow(keepMap = false) {
    const version = ++asked;
    if (!shown) [verdict, headline].forEach(old);
    for (const [name, one] of figures) if (name !== "sim" && !(name === "map" && keepMap)) old(one);
    const done = (act) => (answer) => { if (version === asked) act(answer); };
    // While the case moves over it the map itself stays true; what its caption says of the case does not.
    skipped = wanted("map") && keepMap && figures.has("map") && moving;
    if (skipped) old(figures.get("map").lastChild);
    const needsStudy = !shown || shown.some((name) => !["map", "sim", "running"].includes(name));
    await Promise.all([
      wanted("map") && !skipped && drawMap(),
      needsStudy && desks[1].ask({ ask: "study", text, ...look() }).then(done(showStudy)),
    ]);
  }
  async function drawMap() {
    skipped = false;
    const version = asked, answer = await desks[0].ask({ ask: "map", text, ...look() });
    if (version === asked) showMap(answer);
  }

  /** Criteria over the case's band, in a worker of their own: that may take seconds. */
  async function decide() {
    if (!judges) return decided([]);
    judge ??= new Desk(compiled, document.getElementById("live-script").textContent);
    const version = asked;
    old(decision);
    const { markdown } = await judge.ask({ ask: "judge", text });
    if (version === asked) decided(markdown ? blocks(markdown) : []);
  }
  function decided(parts) {
    fresh(decision);
    decision.replaceChildren(...parts);
  }

  /** The clearance that the program would choose, in a worker of its own: it takes seconds, and the button ends it. */
  async function search() {
    if (stop) return stop();
    const seeker = new Desk(compiled, document.getElementById("live-script").textContent), ended = new Promise((done) => { stop = done; });
    let seconds = 0;
    const looking = () => { best.textContent = `Stop looking (${seconds} s)`; seconds += 1; };
    looking();
    const clock = setInterval(looking, 1000);
    const from = text, few = await Promise.race([seeker.ask({ ask: "optimize_few", text }), ended]);
    if (few?.said) advice.textContent = few.said;
    const answer = few && await Promise.race([seeker.ask({ ask: "optimize", text }), ended]);
    clearInterval(clock);
    seeker.end();
    [stop, best.textContent] = [null, "Best clearance"];
    if (answer?.problems) return complain(answer.problems);
    if (answer?.text && from === text) {
      const name = choose.selectedOptions[0].textContent;
      remember();
      open(answer.text, true);
      named(changed(name));
      panel.firstChild.textContent = changed(place.dataset.title);
    }
    advice.textContent = answer ? answer.said : "Stopped: the clearance is as it was.";
  }

  /** Where on its track the clearance has a stable 1:1 motion. */
  function track({ document: { theory } }) {
    const of = controls.find((one) => one.key === "clearance"), { good } = sliders.get("clearance") ?? {};
    if (!good) return;
    const ends = (theory?.stretches ?? []).map((stretch) => stretch.map((end) => Math.min(1, Math.max(0, part(of, end?.at?.value ?? end?.value ?? NaN)))));
    const [first, last] = ends.sort((a, b) => (b[1] - b[0]) - (a[1] - a[0]))[0] ?? [];
    good.hidden = !(last > first);
    if (good.hidden) return;
    good.firstChild.style.marginLeft = `${100 * first}%`;
    good.firstChild.style.width = `${100 * (last - first)}%`;
    const end = (part) => Number((at(of, part) / of.unit.size).toPrecision(3));
    good.lastChild.textContent = `two symmetric impacts per period: ${end(first)} to ${end(last)} ${of.unit.symbol}`;
  }

  /** Until everything on the page belongs to the sliders. */
  async function settled() {
    while (waiting !== null || place.querySelector("[aria-busy=true]")) await new Promise((done) => setTimeout(done, 5));
    await written;
  }

  function old(element) { element.setAttribute("aria-busy", "true"); }
  function fresh(element) { element.removeAttribute("aria-busy"); }

  function draw({ name, svg, title, caption }) {
    if (!figures.has(name)) {
      const one = make("figure", { "data-name": name }, make("div", { class: "drawing", tabindex: 0, role: "region" }), make("figcaption"));
      figures.set(name, one);
      const order = ["amplitude", "map", "sim", "ranges", "response", "motion-1", "return-map-1", "plane"];
      const rank = (name) => (order.indexOf(name) + 99) % 99;
      const sorted = [...figures].sort(([a], [b]) => rank(a) - rank(b)), isFirst = ([name]) => shown || FIRST.includes(name);
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

  function showStudy(answer) {
    if (answer.problems) return complain(answer.problems);
    const [first, ...screen] = firstScreen(answer);
    headline.className = `live-headline ${answer.document.verdict.tone ?? ""}`;
    const known = [...first].map((one) => one.textContent).join("");
    headline.replaceChildren(...first, ...(/±|\(\+[\d.]+\s[^%d]/.test(known) ? [make("small", {}, " ± and brackets: how far it may be off")] : []));
    fresh(headline);
    const [section, ...others] = screen, balance = answer.balance ? [make("p", {}, answer.balance)] : [];
    verdict.replaceChildren(...balance, section, ...others, ...notes.map((note) => make("p", { class: "live-note" }, note)));
    const version = asked;
    if (keeps) written = linkTo(text).then((address) => { if (version === asked) history.replaceState(null, "", address); });
    fresh(verdict);
    track(answer);
    if (wanted("decision")) decide();
    const names = new Set(answer.figures.map(({ name }) => name)).add("map").add("sim");
    for (const [name, figure] of figures) if (!names.has(name)) { figure.remove(); figures.delete(name); }
    answer.figures.forEach(draw);
  }

  /** A level in per cent, and what other brackets mean. */
  const inPercent = (words) => words.replace(/\(([+−])([\d.]+)\sdB\)/, (_, sign, level) => {
    const share = 100 * (10 ** ((sign === "−" ? -level : +level) / 20) - 1);
    return `(${share < 0 ? "−" : "+"}${Math.abs(share) < 9.5 ? Math.abs(share).toPrecision(1) : Math.abs(share).toFixed(0)} %)`;
  });

  /** The verdict's first words, the rest of it and the first numbers, from the Markdown of the report. */
  function firstScreen({ first_screen, document: { verdict: { tone } } }) {
    const lines = first_screen.split("\n");
    const quoted = (begin) => lines.filter((line) => line.startsWith(begin)).map((line) => line.slice(2));
    const [first = "", ...others] = quoted("> ");
    // "Works. 1.6 mm instead of 4 mm; ...", and why it is mixed.
    const why = /, not the steady [^;]*/.exec(first)?.[0].replace(/\.$/, "") ?? "", [amounts, ...parts] = first.split("; ");
    const rests = parts.findIndex((part) => part.includes("stays inactive")), idle = rests < 0 ? "" : `; ${parts.splice(rests, 1)[0].replace(/\.$/, "")}`;
    const [begin, rest] = [inPercent(amounts) + why + idle, parts.join("; ").replace(why, "")];
    const said = [rest && rest[0].toUpperCase() + rest.slice(1).replace(/([^.])$/, "$1."), ...others].filter(Boolean).map(sentence);
    const [names = [], , numbers = [], layers = []] = lines.filter((line) => line.startsWith("|")).map(cells);
    return [sentence(begin).childNodes, make("section", { class: `verdict ${tone ?? ""}`, hidden: !said.length }, ...said), ...quoted("- ").map((line) => sentence(line.replace(/Line \d+ of the case: /, ""))),
      make("dl", { class: "live-numbers" }, ...names.map((name, k) => make("div", {}, make("dt", {}, name), make("dd", {}, numbers[k], make("small", {}, layers[k]))))),
      make("p", { class: "live-note" }, "A tuned mass damper is tuned to the structure and needs its stroke as room; the ball is not tuned and needs its cavity.")];
  }

  // The map's mark: an axis value is `at`, and one in SI `values`.
  let chart = null;
  const star = button("★", () => {}, { class: "live-mark", "aria-label": "This case on the map; arrow keys change frequency and clearance" });
  function showMap(answer) {
    if (answer.problems) { figures.get("map")?.remove(); figures.delete("map"); return; }
    const focused = document.activeElement === star, drawing = draw(answer).firstChild;
    chart = answer.panel && { ...answer.panel, factor: answer.panel.values.map((value, k) => value / answer.panel.at[k]) };
    if (!chart) return;
    const sheet = make("div", { class: "live-sheet" });
    sheet.append(drawing.firstElementChild, star);
    drawing.replaceChildren(sheet);
    if (focused) star.focus({ preventScroll: true });
    sheet.onpointerdown = (event) => {
      // A finger beside the star scrolls.
      if (event.pointerType === "touch" && event.target !== star) return;
      sheet.setPointerCapture(event.pointerId);
      drag(event);
      sheet.onpointermove = drag;
      event.preventDefault();
      star.focus({ preventScroll: true });
    };
    sheet.onpointerup = sheet.onpointercancel = () => { sheet.onpointermove = null; settle(); };
    star.onkeydown = (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!way) return;
      event.preventDefault();
      const shares = places().map((share, k) => share + 0.01 * way[k]);
      put(shares);
      pause();
    };
    mark();
  }
  const now = () => ["frequency", "clearance"].map((key) => controls.find((one) => one.key === key));
  /** Where the case is: shares of the axes. */
  function places() {
    return now().map((of, k) => { const [first, last, log] = chart.axes[k]; return part({ range: [first, last], log }, of.value / chart.factor[k]); });
  }
  function put(shares) {
    now().forEach((of, k) => {
      const [first, last, log] = chart.axes[k];
      move(of, at({ range: [first, last], log }, Math.min(1, Math.max(0.002, shares[k]))) * chart.factor[k]);
    });
  }
  function drag(event) {
    const box = event.currentTarget.querySelector("svg").getBoundingClientRect(), [left, top, right, bottom] = chart.room;
    put([((event.clientX - box.left) / box.width - left) / (right - left), (bottom - (event.clientY - box.top) / box.height) / (bottom - top)]);
  }
  function mark() {
    if (!chart || !now().every(Boolean)) return;
    const [left, top, right, bottom] = chart.room, [x, y] = places().map((share) => Math.min(1, Math.max(0, share)));
    star.style.left = `${100 * (left + x * (right - left))}%`;
    star.style.top = `${100 * (bottom - y * (bottom - top))}%`;
  }
}

/** The simulation that runs: the box on its spring with the ball in it, beside the structure without one; displacement over
 *  time, the absorber in its cavity with impacts, and the return map. */
function Running(engine, say) {
  const WINDOW = 10, IMPACTS = 2000, SAMPLES = 48, FLASH = 0.12;
  let clock = 0, simulated = 0, begin = 0, points = [], impacts = [], last = null, shown = true;
  // Clearance in the case's unit, the structure alone, the largest displacement so far, and what an axis ends at, over the clearance.
  let of = { clearance: 1, unit: "b", bare: null }, largest = 0, reach = 1, told = 0, audio = null;
  let paused = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const canvas = (label) => make("canvas", { role: "img", "aria-label": label });
  const scene = canvas("The structure as a box on its spring with the absorber as a ball in it, and below the structure without an absorber");
  const motion = canvas("Displacement of the structure, with and without absorber, and position of the absorber between its walls over the last ten periods");
  const map = canvas("Return map: each time between impacts over the one before");
  const pause = make("button", { type: "button", onclick: () => { paused = !paused; label(); } });
  const label = () => { pause.textContent = paused ? "Run" : "Pause"; };
  const sound = make("button", { type: "button", "aria-pressed": "false", onclick: () => {
    audio = audio ? (audio.close(), null) : new AudioContext();
    sound.setAttribute("aria-pressed", String(Boolean(audio)));
  } }, "Sound");
  const speed = make("select", {}, ...[[0.5, "slow motion"], [2, "2 periods a second"], [10, "10 periods a second"], [200, "200 periods a second"]].map(([value, words]) =>
    make("option", { value, selected: value === 2 }, words)));
  const held = make("strong");
  label();
  this.figure = make("figure", { class: "live-running", "data-name": "running" },
    make("div", { class: "live-bar" }, pause, make("label", {}, make("span", {}, "Speed "), speed), sound,
      make("button", { type: "button", onclick: () => this.change(this.text, "push") }, "With a push"),
      make("button", { type: "button", onclick: () => this.change(this.text, "rest") }, "From rest")),
    make("div", { class: "live-canvases" }, scene, motion),
    make("figcaption", {}, held, "The full system, impact by impact; a slider changes it while it runs. The box is the structure, the ball the absorber; a wall that is hit turns red. The red arrow is the push of the ball on it, the arrow above the box the way that it moves: a push against that way brakes the structure. Grey and dashed: the same structure without an absorber."),
    make("details", {}, make("summary", {}, "Times between impacts"), map,
      make("p", { class: "live-note" }, "The time between impacts over the one before, in periods; two symmetric impacts per period are the point (0.5, 0.5), on the line of all motions with two impacts per period. From rest the absorber may stay inactive, which a push prevents.")));
  new IntersectionObserver(([one]) => { shown = one.isIntersecting; }).observe(scene);

  /** Runs a case on from where the simulation is, or anew: at rest, or with an absorber that was pushed. */
  this.change = (text, from, unseen = 0) => {
    this.text = text;
    const answer = engine().ask({ ask: "run", text, from });
    if (answer.problems) return say(answer.problems[0].message);
    const before = of.clearance;
    of = { ...answer, unit: answer.unit || "b" };
    held.textContent = answer.carried;
    if (from !== "here") { points = []; clock = simulated = largest = 0; }
    // Lengths of before are over another clearance.
    for (let k = 0; k < points.length; k += 3) { points[k + 1] *= before / of.clearance; points[k + 2] *= before / of.clearance; }
    largest *= before / of.clearance;
    reach = 0;
    for (let left = unseen; left > 0; left -= 40) engine().goOn(40, 1);
    begin = simulated - unseen;
    impacts = [];
    told = clock;
    if (paused) { clock += WINDOW; drawn(); }
    if (last === null) last = requestAnimationFrame(frame);
  };
  this.state = () => ({ clock, impacts: impacts.length / 2, points: points.length / 3, reach: reach * of.clearance });

  function ahead() {
    const periods = Math.min(40, Math.ceil(clock - simulated));
    if (periods > 0) {
      const news = engine().goOn(periods, SAMPLES);
      for (let k = 0; k < news.points.length; k += 3) points.push(begin + news.points[k], news.points[k + 1], news.points[k + 2]);
      for (let k = 0; k < news.impacts.length; k += 2) impacts.push(begin + news.impacts[k], news.impacts[k + 1]);
      for (let k = 1; k < news.points.length; k += 3) largest = Math.max(largest, Math.abs(news.points[k]));
      simulated += periods;
      clock = Math.min(clock, simulated);
      let first = 0;
      while (first < points.length && points[first] < clock - WINDOW) first += 3;
      points.splice(0, first);
      impacts.splice(0, Math.max(0, impacts.length - 2 * IMPACTS));
    }
    // The axis only grows, to a round number: a decay or a beating is seen as it is. What is far off it is said.
    const bare = of.bare ? Math.hypot(...of.bare) : 0, most = Math.max(largest, Math.min(bare, 4 * (largest + 1))) * of.clearance;
    if (most > reach * of.clearance) reach = round(1.05 * most) / of.clearance;
  }
  const alone = (t) => of.bare && of.bare[0] * Math.cos(2 * Math.PI * t) + of.bare[1] * Math.sin(2 * Math.PI * t);

  function frame(time) {
    const before = typeof last === "number" && frame.time ? time - frame.time : 0;
    frame.time = time;
    if (!paused && shown) { clock += Math.min(before, 100) / 1000 * speed.value; drawn(); }
    requestAnimationFrame(frame);
  }

  const HEIGHT = 250, SCENE = 186;

  function drawn() {
    ahead();
    const style = getComputedStyle(motion);
    const [ink, soft, line, blue, red] = ["--ink", "--soft", "--line", "--link", "--bad"].map((name) => style.getPropertyValue(name));
    box(sheet(scene, SCENE), { ink, soft, line, blue, red });
    strip(sheet(motion, HEIGHT), { ink, soft, line, blue, red });
    if (map.clientWidth) square(sheet(map, HEIGHT), { soft, line, blue });
    click();
  }

  /** A click for the first impact since the last frame, where somebody wants to hear it. */
  function click() {
    let heard = false;
    for (let k = 0; k < impacts.length && !heard; k += 2) heard = impacts[k] > told && impacts[k] <= clock;
    told = clock;
    if (!audio || !heard || speed.value > 10) return;
    const now = audio.currentTime, tone = audio.createOscillator(), gain = audio.createGain();
    tone.frequency.value = 1400;
    gain.gain.setValueAtTime(0.12, now);
    gain.gain.exponentialRampToValueAtTime(0.001, now + 0.04);
    tone.connect(gain).connect(audio.destination);
    tone.start(now);
    tone.stop(now + 0.05);
  }

  /** The largest displacement of the last ten periods. */
  function lately() {
    let most = 0;
    for (let k = 0; k < points.length && points[k] <= clock; k += 3) most = Math.max(most, Math.abs(points[k + 1]));
    return most;
  }

  /** Displacement and gap at the clock, between the points beside it, and which way the displacement goes. */
  function state() {
    let k = points.length - 6;
    while (k > 0 && points[k] > clock) k -= 3;
    if (k < 0) return [0, 0, 0];
    const part = Math.min(1, Math.max(0, (clock - points[k]) / (points[k + 3] - points[k] || 1)));
    return [...[1, 2].map((i) => points[k + i] + part * (points[k + 3 + i] - points[k + i])), Math.sign(points[k + 4] - points[k + 1])];
  }

  function box({ g, width, height }, { ink, soft, line, blue, red }) {
    const [x, gap, way] = state(), ghost = alone(clock), rows = [66, 144], half = 24;
    // The cavity is to scale with the displacement, as far as a ball can be seen in it.
    const room = width - 70, size = room / (2 * reach + 2.6), ball = Math.max(7, Math.min(15, 0.3 * size));
    const cavity = Math.max(size, 16), middle = 60 + room / 2;
    const spring = (from, to, y) => {
      g.beginPath(); g.moveTo(from, y);
      for (let k = 0; k <= 12; k += 1) g.lineTo(from + 8 + (to - from - 16) * k / 12, y + (k % 2 ? 6 : -6));
      g.lineTo(to, y); g.stroke();
    };
    const arrow = (from, y, way) => {
      g.beginPath(); g.moveTo(from, y); g.lineTo(from + 28 * way, y);
      g.moveTo(from + 20 * way, y - 5); g.lineTo(from + 28 * way, y); g.lineTo(from + 20 * way, y + 5); g.stroke();
    };
    /** A word that goes on from a place one way. */
    const word = (words, from, y, way) => { g.fillStyle = g.strokeStyle; g.textAlign = way > 0 ? "left" : "right"; g.fillText(words, from, y); g.textAlign = "left"; };
    g.lineWidth = 3; g.strokeStyle = soft;
    g.beginPath(); g.moveTo(6, 8); g.lineTo(6, height - 8); g.stroke();
    g.setLineDash([2, 4]); g.lineWidth = 1; g.strokeStyle = line;
    g.beginPath(); g.moveTo(middle, 6); g.lineTo(middle, height - 6); g.stroke();
    g.setLineDash([]);
    const wide = cavity + ball;
    const at = (x) => Math.max(wide + 40, Math.min(width - wide - 4, middle + x * size));
    g.lineWidth = 1.5; g.strokeStyle = soft;
    spring(6, at(x) - wide, rows[0]);
    g.lineWidth = 2; g.strokeStyle = ink;
    g.strokeRect(at(x) - wide, rows[0] - half, 2 * wide, 2 * half);
    for (const side of [-1, 1]) {
      let hit = false;
      for (let k = impacts.length - 2; k >= 0 && impacts[k] > clock - Math.min(FLASH * speed.value, 0.24); k -= 2) hit ||= impacts[k] <= clock && impacts[k + 1] === -side;
      if (!hit) continue;
      g.fillStyle = g.strokeStyle = red;
      g.fillRect(at(x) + side * wide - 4, rows[0] - half, 8, 2 * half);
      arrow(at(x) + side * (wide + 10), rows[0], side);
      word("push", at(x) + side * (wide + 10), rows[0] - 9, side);
    }
    g.strokeStyle = ink;
    if (way) {
      arrow(at(x) + 4 * way, rows[0] - half - 9, way);
      word("moves", at(x), rows[0] - half - 5, -way);
    }
    g.fillStyle = blue;
    g.beginPath(); g.arc(at(x) - gap * cavity, rows[0] + half - ball - 1, ball, 0, 7); g.fill();
    g.fillStyle = soft;
    const idle = clock > WINDOW && !impacts.some((value, k) => k % 2 === 0 && value > clock - WINDOW);
    g.fillText(`with absorber, ±${number(lately() * of.clearance)} ${of.unit} ${idle ? "now: no impacts" : "in these ten periods"}`, 16, 16);
    // How long a round length is here.
    const length = round(40 / size * of.clearance), end = width - 10, begin = end - length / of.clearance * size;
    g.strokeStyle = soft; g.lineWidth = 2;
    g.beginPath(); g.moveTo(begin, height - 7); g.lineTo(end, height - 7); g.stroke();
    g.textAlign = "right"; g.fillText(`${number(length)} ${of.unit}`, begin - 6, height - 3); g.textAlign = "left";
    const peak = of.bare ? Math.hypot(...of.bare) : Infinity;
    const words = of.bare ? `without, ±${number(peak * of.clearance)} ${of.unit}${peak > reach ? ", off this scale" : ""}` : "without: nothing limits it";
    g.fillText(words, 16, 110);
    if (!of.bare) return;
    g.setLineDash([6, 4]); g.strokeStyle = soft; g.lineWidth = 1.5;
    spring(6, at(ghost) - wide, rows[1]);
    g.strokeRect(at(ghost) - wide, rows[1] - half, 2 * wide, 2 * half);
    g.setLineDash([]);
  }

  function strip({ g, width, height }, { ink, soft, line, blue, red }) {
    const left = 74, right = width - 6, from = clock - WINDOW, middles = [66, 178], halves = [54, 44];
    const across = (t) => left + (t - from) / WINDOW * (right - left);
    const rule = (x1, y1, x2, y2) => { g.beginPath(); g.moveTo(x1, y1); g.lineTo(x2, y2); g.stroke(); };
    g.lineWidth = 1; g.strokeStyle = line;
    for (let t = Math.ceil(from); t <= clock; t += 1) rule(across(t), 6, across(t), height - 24);
    for (const share of [-1, 0, 1]) rule(left, middles[0] - share * halves[0], right, middles[0] - share * halves[0]);
    g.fillStyle = soft; g.textAlign = "right";
    const end = number(reach * of.clearance);
    [[`+${end}`, -1], [of.unit, 0], [`−${end}`, 1]].forEach(([word, share]) => g.fillText(word, left - 6, middles[0] + share * halves[0] + 4));
    [[`+${number(of.clearance)}`, -1], ["in the box", 0], [`−${number(of.clearance)}`, 1]].forEach(([word, share]) => g.fillText(word, left - 6, middles[1] + share * halves[1] + 4));
    g.fillText("time in periods", right, height - 6);
    g.textAlign = "left";
    g.save();
    g.beginPath(); g.rect(left, 0, right - left, height); g.clip();
    if (of.bare) {
      g.save();
      g.beginPath(); g.rect(left, middles[0] - halves[0], right - left, 2 * halves[0]); g.clip();
      g.setLineDash([5, 4]); g.strokeStyle = soft; g.lineWidth = 1.2; g.beginPath();
      for (let k = 0; k <= 480; k += 1) g.lineTo(across(from + k * WINDOW / 480), middles[0] - alone(from + k * WINDOW / 480) / reach * halves[0]);
      g.stroke();
      g.restore();
    }
    const curve = (index, middle, half) => {
      g.strokeStyle = blue; g.lineWidth = 1.6; g.beginPath();
      for (let k = 0, pen = false; k < points.length && points[k] <= clock; k += 3) {
        if (points[k] < from) continue;
        const x = across(points[k]), y = middle - points[k + index] * half;
        pen ? g.lineTo(x, y) : g.moveTo(x, y);
        pen = true;
      }
      g.stroke();
    };
    curve(1, middles[0], halves[0] / reach);
    curve(2, middles[1], halves[1]);
    g.strokeStyle = ink; g.lineWidth = 2;
    for (const side of [-halves[1], halves[1]]) rule(left, middles[1] + side, right, middles[1] + side);
    g.fillStyle = red;
    for (let k = 0; k < impacts.length; k += 2) {
      if (impacts[k] < from || impacts[k] > clock) continue;
      g.beginPath(); g.arc(across(impacts[k]), middles[1] - halves[1] * impacts[k + 1], 3.5, 0, 7); g.fill();
    }
    g.restore();
  }

  function square({ g, width, height }, { soft, line, blue }) {
    const side = Math.min(height - 48, width - 60), left = (width - side) / 2 + 10, top = 8, bottom = top + side;
    const pairs = [];
    for (let k = 4; k < impacts.length; k += 2) pairs.push([impacts[k - 2] - impacts[k - 4], impacts[k] - impacts[k - 2]]);
    const most = pairs.reduce((most, [a, b]) => Math.max(most, a, b), 1) * 1.05;
    const x = (t) => left + t / most * side, y = (t) => bottom - t / most * side;
    g.strokeStyle = line; g.lineWidth = 1.5;
    g.strokeRect(left, top, side, side);
    g.beginPath(); g.moveTo(x(0), y(1)); g.lineTo(x(1), y(0)); g.moveTo(x(0), y(0)); g.lineTo(x(most), y(most)); g.stroke();
    g.fillStyle = soft; g.textAlign = "center";
    g.fillText("time between impacts (periods)", left + side / 2, height - 6);
    g.fillText("0", left - 8, bottom + 4); g.fillText("1", x(1), bottom + 14); g.fillText("1", left - 8, y(1) + 4);
    g.save(); g.translate(left - 20, top + side / 2); g.rotate(-Math.PI / 2); g.fillText("the next one", 0, 0); g.restore();
    g.textAlign = "left";
    g.fillStyle = blue;
    for (const [a, b] of pairs) g.fillRect(x(a) - 1.5, y(b) - 1.5, 3, 3);
  }
}
