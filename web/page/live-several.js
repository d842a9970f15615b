// The live page of structures of several modes: the excitation and the absorbers under sliders. The running simulation is computed in the
// page; what is known at the frequency, and the figure over the range, follow from workers and look old until then.

/** Periods after which the simulation of a case is first seen. */
const SETTLED = 200;
/** Absorbers that are drawn. */
const DRAWN = 3;

function Live(place) {
  let text = "", controls = [], load = 0, asked = 0, here, desks, choose, loads, notes = [];
  const fields = new Map(), values = new Map();
  let waiting = null, ranged = "";
  const status = make("p", { class: "live-status", role: "status" });
  const problem = make("p", { class: "live-problem", role: "alert", hidden: true });
  const headline = make("div", { class: "live-headline", role: "status" });
  const table = make("div", { "aria-live": "polite" });
  const panel = make("form", { class: "live-sliders", "aria-label": "Sliders", onsubmit: (e) => e.preventDefault() });
  const board = make("div", { class: "live-figures" });
  const file = make("textarea", { rows: 16, spellcheck: "false", "aria-label": "Case file" });
  const button = (words, act) => make("button", { type: "button", onclick: act }, words);
  const running = new Running(() => here, complain);

  // For tests and for whoever looks into the console.
  place.live = { ask: (request) => desks[1].ask(request), settled, at, running: () => running.state(), engine: () => here, get text() { return text; } };

  this.begin = async () => {
    try {
      const module = await packedModule(), source = document.getElementById("live-script").textContent;
      here = new Engine(module);
      desks = [new Desk(module, source), new Desk(module, source)];
    } catch (error) {
      place.replaceChildren(make("p", { class: "live-problem" }, `This page needs a browser with WebAssembly (${error.message}).`));
      return;
    }
    const presets = here.ask({ ask: "presets" });
    place.replaceChildren(bar(presets), status, make("div", { class: "live-columns" },
      make("div", { class: "live-left" }, problem, panel), make("div", {}, headline, running.figure, table, board)));
    // In a report the case is its own.
    const link = await linked(), own = document.getElementById("live-case")?.textContent;
    open(link || (own ?? presets[0][1]));
    if (!link && own === undefined) choose.value = "0";
    if (link === "") complain([{ message: DAMAGED }]);
    addEventListener("hashchange", async ({ newURL }) => {
      const other = await linked(new URL(newURL).hash);
      if (other === "") complain([{ message: DAMAGED }]);
      if (other && other !== text) open(other);
    });
  };

  function bar(presets) {
    choose = make("select", { onchange: () => { const of = choose.value; if (of !== "") { open(presets[of][1]); choose.value = of; } } },
      make("option", { value: "" }, "your case"), ...presets.map(([name], k) => make("option", { value: k }, name)));
    loads = make("select", { onchange: () => open(text, +loads.value) });
    const paste = make("details", { class: "live-file", ontoggle: () => { file.value = text; } },
      make("summary", {}, "Case file: copy or paste"), file, button("Use this case file", () => open(file.value)), " ",
      button("Copy as case file", () => copy(text, "The case file is in the clipboard.")));
    return make("div", { class: "live-bar" }, make("label", {}, "Begin with ", choose), make("label", {}, "Load ", loads),
      button("Copy link", async () => copy(await linkTo(text), "The link is in the clipboard; it holds the whole case.")), paste);
  }

  async function copy(words, done) {
    try { await navigator.clipboard.writeText(words); status.textContent = done; }
    catch { status.textContent = "The browser does not let this page copy. Open “Case file: copy or paste” and copy from there."; }
  }

  function complain(problems) {
    problem.hidden = !problems;
    problem.textContent = (problems ?? []).map((one) =>
      [one.line && `Line ${one.line}: `, one.message, one.expected && `; ${one.expected}`, one.help && ` (${one.help})`].filter(Boolean).join("")).join("\n");
    return problems;
  }

  /** Shows another case, or another load of it. */
  function open(wanted, number = 0) {
    const answer = here.ask({ ask: "open", text: wanted, load: number });
    if (complain(answer.problems)) return;
    const other = answer.text !== text;
    ({ text, controls, load, notes } = answer);
    if (other) choose.value = "";
    loads.replaceChildren(...answer.loads.map((words, k) => make("option", { value: k, selected: k === load }, words)));
    place.dataset.title = answer.title;
    fields.clear();
    values.clear();
    panel.replaceChildren(make("h3", {}, answer.title), ...controls.map(slider));
    ranged = "";
    running.change({ ask: "run", text, at: at() }, "push", SETTLED);
    follow();
  }

  /** The excitation of the sliders. */
  function at() {
    const of = (key) => controls.find((one) => one.key === key).value;
    return { load, frequency: of("frequency"), amplitude: of("amplitude") };
  }

  const value = ({ range: [low, high], log }, part) => log ? low * (high / low) ** part : low + part * (high - low);
  const part = ({ range: [low, high], log }, value) => log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);

  function slider(of) {
    const id = `live-${of.key}`, { size, symbol } = of.unit;
    const range = make("input", { id, type: "range", min: 0, max: 1000, step: 1, oninput: () => move(of, value(of, range.value / 1000)), onchange: () => over() });
    const field = make("input", { type: "number", step: "any", "aria-label": `${of.name} ${of.symbol} in ${symbol || "1"}`, onchange: () => { typed(of, field.value * size); over(); } });
    fields.set(of.key, { range, field });
    shown(of);
    return make("div", { class: "live-slider" }, make("label", { for: id }, `${of.name} ${of.symbol}`), make("span", { class: "live-field" }, field, make("span", {}, symbol)), range);
  }
  function shown(of) {
    const { range, field } = fields.get(of.key), words = Number((of.value / of.unit.size).toPrecision(4));
    range.value = 1000 * part(of, of.value);
    range.setAttribute("aria-valuetext", `${words} ${of.unit.symbol}`.trim());
    if (document.activeElement !== field) field.value = words;
  }
  function typed(of, wanted) {
    const [low, high] = of.range;
    if (wanted >= low && wanted <= high) return move(of, wanted);
    const ends = [low, high].map((end) => `${Number((end / of.unit.size).toPrecision(4))} ${of.unit.symbol}`.trim());
    fields.get(of.key).field.value = Number((of.value / of.unit.size).toPrecision(4));
    complain([{ message: `The ${of.name} goes from ${ends.join(" to ")} here; for other values edit the case file.` }]);
  }

  /** A slider moves: what moves is seen in the next frame. */
  function move(of, wanted) {
    of.value = wanted;
    shown(of);
    if (of.key !== "frequency" && of.key !== "amplitude") values.set(of.key, wanted);
    waiting ??= requestAnimationFrame(() => { waiting = null; changed(); });
  }
  function changed() {
    if (values.size) {
      const answer = here.ask({ ask: "change", text, values: Object.fromEntries(values) });
      if (complain(answer.problems)) return;
      text = answer.text;
      values.clear();
      choose.value = "";
      if (document.activeElement !== file) file.value = text;
    }
    complain();
    running.change({ ask: "run", text, at: at() }, "here");
    follow();
  }

  const old = (element) => element.setAttribute("aria-busy", "true"), fresh = (element) => element.removeAttribute("aria-busy");

  /** What is known at the frequency; the figure over the range follows when the slider rests. */
  async function follow() {
    const version = ++asked;
    [headline, table].forEach(old);
    if (!ranged) over();
    const answer = await desks[1].ask({ ask: "study", text, at: at() });
    if (version !== asked) return;
    [headline, table].forEach(fresh);
    if (complain(answer.problems)) return;
    const [said, ...others] = blocks(answer.markdown, "Long-term motions");
    headline.className = `live-headline ${answer.tone ?? ""}`;
    headline.replaceChildren(said);
    const number = fields.get("frequency").field.value;
    table.replaceChildren(make("h2", {}, `Every long-term motion that was found at ${number} ${controls[0].unit.symbol}`), ...others, ...notes.map((note) => make("p", { class: "live-note" }, note)));
  }

  /** The figure over the range of the load, which the frequency of the slider does not change. */
  async function over() {
    if (waiting !== null) return requestAnimationFrame(over);
    const { amplitude } = at(), wanted = JSON.stringify([text, load, amplitude]);
    if (wanted === ranged) return;
    ranged = wanted;
    old(board);
    const answer = await desks[0].ask({ ask: "range", text, at: at(), narrow: narrow() });
    if (wanted !== ranged) return;
    fresh(board);
    board.replaceChildren(...(answer.figures ?? []).map(({ name, svg, title, caption }) => {
      const drawing = make("div", { class: "drawing", tabindex: 0, role: "region", "aria-label": title });
      drawing.innerHTML = svg;
      return make("figure", { "data-name": name }, drawing, make("figcaption", {}, caption));
    }));
  }

  /** Until everything on the page belongs to the sliders. */
  async function settled() {
    while (waiting !== null || place.querySelector("[aria-busy=true]")) await new Promise((done) => setTimeout(done, 5));
  }
}

/** The simulation that runs: at each absorber's place a box with its ball, beside the same place without absorbers; displacement over
 * time, and each ball between its walls. */
function Running(engine, say) {
  const WINDOW = 10, SAMPLES = 48, FLASH = 0.12;
  // Points are [t, x_1, w_1, x_2, ...]: times in periods of the excitation, displacements in the page's unit, gaps over the clearance;
  // impacts [t, absorber, side].
  let points = [], impacts = [], clock = 0, begin = 0, simulated = 0, paused = matchMedia("(prefers-reduced-motion: reduce)").matches, last = null, reach = 1, largest = 0, shown = true;
  let of = { clearances: [1], bare: [[0, 0]], places: [""], unit: "", size: 1 };
  const all = () => of.clearances.length, drawn = () => Math.min(DRAWN, all()), width = () => 1 + 2 * all();
  const canvas = (label) => make("canvas", { role: "img", "aria-label": label });
  const scene = canvas("The structure at each absorber as a box on a spring with the ball in it, and behind it, dashed, without absorbers");
  const motion = canvas("Displacement at the first absorber, with and without absorbers, and the position of each ball between its walls over the last ten periods");
  const pause = make("button", { type: "button", onclick: () => { paused = !paused; label(); } });
  const label = () => { pause.textContent = paused ? "Run" : "Pause"; };
  const speed = make("select", {}, ...[[0.5, "slow motion"], [2, "2 periods a second"], [10, "10 periods a second"], [100, "100 periods a second"]].map(([value, words]) =>
    make("option", { value, selected: value === 2 }, words)));
  label();
  let request = null;
  this.figure = make("figure", { class: "live-running", "data-name": "running" },
    make("div", { class: "live-bar" }, pause, make("label", {}, make("span", {}, "Speed "), speed),
      make("button", { type: "button", onclick: () => this.change(request, "push") }, "With a push"),
      make("button", { type: "button", onclick: () => this.change(request, "rest") }, "From rest")),
    make("div", { class: "live-canvases" }, scene, motion),
    make("figcaption", {}, "The full system, impact by impact; a slider changes it while it runs. Each box is the structure at an absorber's place; a wall that is hit turns red. Dashed: the same place without absorbers."));
  new IntersectionObserver(([one]) => { shown = one.isIntersecting; }).observe(scene);

  /** Runs a case on from where the simulation is, or anew: at rest, or with absorbers that were pushed. */
  this.change = (wanted, from, unseen = 0) => {
    request = wanted;
    const answer = engine().ask({ ...wanted, from });
    if (answer.problems) return say(answer.problems);
    const same = answer.clearances.length === all() && answer.size === of.size;
    const before = of.clearances;
    of = { ...answer, unit: answer.unit || "units" };
    if (from !== "here" || !same) { points = []; clock = simulated = largest = 0; }
    // Gaps of before are over other clearances.
    else for (let k = 0; k < points.length; k += width()) for (let j = 0; j < all(); j += 1) points[k + 2 + 2 * j] *= before[j] / of.clearances[j];
    reach = 0;
    for (let left = unseen; left > 0; left -= 40) engine().goOn(40, 1, width());
    begin = simulated - unseen;
    impacts = [];
    if (paused) { clock += WINDOW; draw(); }
    if (last === null) last = requestAnimationFrame(frame);
  };
  this.state = () => ({ clock, impacts: impacts.length / 3, points: points.length / width(), reach });

  function ahead() {
    const periods = Math.min(40, Math.ceil(clock - simulated)), wide = width();
    if (periods > 0) {
      const news = engine().goOn(periods, SAMPLES, wide);
      for (let k = 0; k < news.points.length; k += wide) {
        points.push(begin + news.points[k]);
        for (let j = 0; j < all(); j += 1) {
          const x = news.points[k + 1 + 2 * j] / of.size;
          points.push(x, news.points[k + 2 + 2 * j]);
          if (j < DRAWN) largest = Math.max(largest, Math.abs(x));
        }
      }
      for (let k = 0; k < news.impacts.length; k += 3) impacts.push(begin + news.impacts[k], news.impacts[k + 1], news.impacts[k + 2]);
      simulated += periods;
      clock = Math.min(clock, simulated);
      let first = 0;
      while (first < points.length && points[first] < clock - WINDOW) first += wide;
      points.splice(0, first);
      while (impacts.length && impacts[0] < clock - WINDOW) impacts.splice(0, 3);
    }
    // The axis only grows, to a round number. What is far off it is said.
    const bare = Math.max(...of.bare.map((one) => Math.hypot(...one))), most = Math.max(largest, Math.min(bare, 4 * (largest + of.clearances[0])));
    if (most > reach) reach = round(1.05 * most);
  }
  const alone = (j, t) => of.bare[j][0] * Math.cos(2 * Math.PI * t) + of.bare[j][1] * Math.sin(2 * Math.PI * t);

  function frame(time) {
    const before = frame.time ? time - frame.time : 0;
    frame.time = time;
    if (!paused && shown) { clock += Math.min(before, 100) / 1000 * speed.value; draw(); }
    requestAnimationFrame(frame);
  }

  /** Room of a box with its words, and of a ball between its walls. */
  const ROW = 92, TRACK = 74;

  function draw() {
    ahead();
    const style = getComputedStyle(motion);
    const [ink, soft, line, blue, red] = ["--ink", "--soft", "--line", "--link", "--bad"].map((name) => style.getPropertyValue(name));
    boxes(sheet(scene, ROW * drawn() + 10), { ink, soft, line, blue, red });
    strip(sheet(motion, 136 + TRACK * drawn()), { ink, soft, line, blue, red });
  }

  /** The numbers of a point at the clock. */
  function now() {
    const wide = width();
    let k = points.length - 2 * wide;
    while (k > 0 && points[k] > clock) k -= wide;
    if (k < 0) return new Array(wide).fill(0);
    const share = Math.min(1, Math.max(0, (clock - points[k]) / (points[k + wide] - points[k] || 1)));
    return Array.from({ length: wide }, (_, i) => points[k + i] + share * (points[k + wide + i] - points[k + i]));
  }
  /** The largest displacement of the last ten periods at an absorber. */
  function lately(j) {
    let most = 0;
    for (let k = 0; k < points.length && points[k] <= clock; k += width()) most = Math.max(most, Math.abs(points[k + 1 + 2 * j]));
    return most;
  }

  function boxes({ g, width, height }, { ink, soft, line, blue, red }) {
    const here = now(), room = width - 70, widest = Math.max(...of.clearances), size = room / (2 * reach + 2.6 * widest), middle = 60 + room / 2;
    g.lineWidth = 3; g.strokeStyle = soft;
    g.beginPath(); g.moveTo(6, 8); g.lineTo(6, height - 8); g.stroke();
    g.setLineDash([2, 4]); g.lineWidth = 1; g.strokeStyle = line;
    g.beginPath(); g.moveTo(middle, 6); g.lineTo(middle, height - 6); g.stroke();
    g.setLineDash([]);
    for (let j = 0; j < drawn(); j += 1) {
      const [x, gap] = [here[1 + 2 * j], here[2 + 2 * j]], y = ROW * j + 58, half = 22;
      const ball = Math.max(6, Math.min(13, 0.3 * size * of.clearances[j])), cavity = Math.max(size * of.clearances[j], 14), wide = cavity + ball;
      const at = (x) => Math.max(wide + 40, Math.min(width - wide - 4, middle + x * size));
      const spring = (to) => {
        g.beginPath(); g.moveTo(6, y);
        for (let k = 0; k <= 12; k += 1) g.lineTo(14 + (to - 22) * k / 12, y + (k % 2 ? 5 : -5));
        g.lineTo(to, y); g.stroke();
      };
      g.setLineDash([6, 4]); g.strokeStyle = soft; g.lineWidth = 1.2;
      const ghost = at(alone(j, clock));
      g.strokeRect(ghost - wide, y - half - 4, 2 * wide, 2 * half + 8);
      g.setLineDash([]);
      g.lineWidth = 1.5;
      spring(at(x) - wide);
      g.lineWidth = 2; g.strokeStyle = ink;
      g.strokeRect(at(x) - wide, y - half, 2 * wide, 2 * half);
      for (const side of [-1, 1]) {
        let hit = false;
        for (let k = impacts.length - 3; k >= 0 && impacts[k] > clock - Math.min(FLASH * speed.value, 0.24); k -= 3) hit ||= impacts[k] <= clock && impacts[k + 1] === j && impacts[k + 2] === -side;
        if (!hit) continue;
        g.fillStyle = red;
        g.fillRect(at(x) + side * wide - 4, y - half, 8, 2 * half);
      }
      g.fillStyle = blue;
      g.beginPath(); g.arc(at(x) - gap * cavity, y + half - ball - 1, ball, 0, 7); g.fill();
      const peak = Math.hypot(...of.bare[j]), idle = clock > WINDOW && !impacts.some((value, k) => k % 3 === 1 && value === j);
      g.fillStyle = soft;
      const small = width < 560, far = peak > reach ? ", off this scale" : "";
      const acts = `±${number(lately(j))} ${of.unit}`, without = `±${number(peak)} ${of.unit}`;
      const words = small ? `${acts}${idle ? ", no impacts" : ""}; without ${without}${far}` : `${of.places[j]}: ${acts} ${idle ? "now: no impacts" : "in these ten periods"}; without absorbers ${without}${far}`;
      g.fillText(words, 16, ROW * j + 20);
    }
  }

  function strip({ g, width: wide, height }, { ink, soft, line, blue, red }) {
    const left = 74, right = wide - 6, from = clock - WINDOW, middle = 58, half = 48, step = width();
    const across = (t) => left + (t - from) / WINDOW * (right - left);
    const rule = (x1, y1, x2, y2) => { g.beginPath(); g.moveTo(x1, y1); g.lineTo(x2, y2); g.stroke(); };
    g.lineWidth = 1; g.strokeStyle = line;
    for (let t = Math.ceil(from); t <= clock; t += 1) rule(across(t), 6, across(t), height - 24);
    for (const share of [-1, 0, 1]) rule(left, middle - share * half, right, middle - share * half);
    g.fillStyle = soft; g.textAlign = "right";
    [[`+${number(reach)}`, -1], [of.unit, 0], [`−${number(reach)}`, 1]].forEach(([word, share]) => g.fillText(word, left - 6, middle + share * half + 4));
    g.fillText("time in periods", right, height - 6);
    g.save();
    g.beginPath(); g.rect(left, 0, right - left, height); g.clip();
    g.save();
    g.beginPath(); g.rect(left, middle - half, right - left, 2 * half); g.clip();
    g.setLineDash([5, 4]); g.strokeStyle = soft; g.lineWidth = 1.2; g.beginPath();
    for (let k = 0; k <= 480; k += 1) g.lineTo(across(from + k * WINDOW / 480), middle - alone(0, from + k * WINDOW / 480) / reach * half);
    g.stroke();
    g.restore();
    const curve = (index, middle, half) => {
      g.setLineDash([]); g.strokeStyle = blue; g.lineWidth = 1.6; g.beginPath();
      for (let k = 0, pen = false; k < points.length && points[k] <= clock; k += step) {
        if (points[k] < from) continue;
        const x = across(points[k]), y = middle - points[k + index] * half;
        pen ? g.lineTo(x, y) : g.moveTo(x, y);
        pen = true;
      }
      g.stroke();
    };
    curve(1, middle, half / reach);
    g.restore();
    for (let j = 0; j < drawn(); j += 1) {
      const row = 116 + TRACK * j + TRACK / 2 - 4, side = TRACK / 2 - 14;
      g.fillStyle = soft; g.textAlign = "right";
      [[`+${number(of.clearances[j])}`, -1], [`ball ${j + 1}`, 0], [`−${number(of.clearances[j])}`, 1]].forEach(([word, share]) => g.fillText(word, left - 6, row + share * side + 4));
      g.save();
      g.beginPath(); g.rect(left, 0, right - left, height); g.clip();
      curve(2 + 2 * j, row, side);
      g.strokeStyle = ink; g.lineWidth = 2;
      for (const way of [-side, side]) rule(left, row + way, right, row + way);
      g.fillStyle = red;
      for (let k = 0; k < impacts.length; k += 3) {
        if (impacts[k + 1] !== j || impacts[k] < from || impacts[k] > clock) continue;
        g.beginPath(); g.arc(across(impacts[k]), row - side * impacts[k + 2], 3, 0, 7); g.fill();
      }
      g.restore();
    }
    g.textAlign = "left";
  }
}
