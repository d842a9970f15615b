/** The page of a case of one mode with one absorber: the map and its star, the study, criteria, and the search for the best clearance. */
function One(page) {
  let judges = false, judge = null, stop = null, skipped = false, chart = null;
  const { figures, sliders, decision, advice, wanted, shown } = page;
  this.best = button("Best clearance", search);
  this.open = (answer) => { ({ judges } = answer); };
  this.moved = mark;

  this.follow = (keys, study) => {
    // The areas do not depend on the case's own frequency and clearance. While it moves over them the map itself stays true; what its
    // caption says of the case does not.
    const keepMap = keys.length > 0 && keys.every((key) => key === "frequency" || key === "clearance");
    for (const [name, one] of figures) if (name !== "sim" && !(name === "map" && keepMap)) old(one);
    skipped = wanted("map") && keepMap && figures.has("map") && page.moving();
    if (skipped) old(figures.get("map").lastChild);
    else if (wanted("map")) drawMap();
    if (!shown || shown.some((name) => !["map", "sim", "running"].includes(name))) page.ask(page.desks()[1], "study", (answer) => { study(answer); if (!answer.problems) showStudy(answer); });
  };
  /** What waited for the end of a movement. */
  this.rest = () => { if (skipped) drawMap(); };
  function drawMap() {
    skipped = false;
    page.ask(page.desks()[0], "map", showMap);
  }

  function showStudy(answer) {
    track(answer);
    if (wanted("decision")) decide();
    const names = new Set(answer.figures.map(({ name }) => name)).add("map").add("sim");
    for (const [name, figure] of figures) if (!names.has(name)) { figure.remove(); figures.delete(name); }
    answer.figures.forEach(page.draw);
  }

  /** Criteria over the case's band, in a worker of their own: that may take seconds. */
  function decide() {
    if (!judges) return decided([]);
    judge ??= page.desk();
    old(decision);
    page.ask(judge, "judge", ({ markdown }) => decided(markdown ? blocks(markdown) : []));
  }
  function decided(parts) {
    fresh(decision);
    decision.replaceChildren(...parts);
  }

  /** The clearance that the program would choose, in a worker of its own: it takes seconds, and the button ends it. */
  async function search({ currentTarget: best }) {
    if (stop) return stop();
    const seeker = page.desk(), ended = new Promise((done) => { stop = done; }), { text } = page.request();
    const isSame = () => page.request().text === text;
    let seconds = 0;
    const looking = () => { best.textContent = `Stop looking (${seconds} s)`; seconds += 1; };
    looking();
    const clock = setInterval(looking, 1000);
    const few = await Promise.race([seeker.ask({ ask: "optimize_few", text }), ended]);
    if (few?.said && isSame()) advice.textContent = few.said;
    const answer = few && await Promise.race([seeker.ask({ ask: "optimize", text }), ended]);
    clearInterval(clock);
    seeker.end();
    [stop, best.textContent] = [null, "Best clearance"];
    if (!isSame()) return;
    if (answer?.problems) return page.complain(answer.problems);
    if (answer?.text) page.adopt(answer.text);
    advice.textContent = answer ? answer.said : "Stopped: the clearance is as it was.";
  }

  this.end = () => stop?.();

  /** Where on its track the clearance has a stable 1:1 motion. */
  function track({ document: { theory } }) {
    const of = page.controls().find((one) => one.key === "clearance"), { good } = sliders.get("clearance") ?? {};
    if (!good) return;
    const ends = (theory?.stretches ?? []).map((stretch) => stretch.map((end) => Math.min(1, Math.max(0, share(of, end?.at?.value ?? end?.value ?? NaN)))));
    const [first, last] = ends.sort((a, b) => (b[1] - b[0]) - (a[1] - a[0]))[0] ?? [];
    good.hidden = !(last > first);
    if (good.hidden) return;
    good.firstChild.style.marginLeft = `${100 * first}%`;
    good.firstChild.style.width = `${100 * (last - first)}%`;
    const end = (part) => Number((along(of, part) / of.unit.size).toPrecision(3));
    good.lastChild.textContent = `two symmetric impacts per period: ${end(first)} to ${end(last)} ${of.unit.symbol}`;
  }

  /** A level in per cent, and what other brackets mean. */
  const inPercent = (words) => words.replace(/\(([+−])([\d.]+)\sdB\)/, (_, sign, level) => {
    const share = 100 * (10 ** ((sign === "−" ? -level : +level) / 20) - 1);
    return `(${share < 0 ? "−" : "+"}${Math.abs(share) < 9.5 ? Math.abs(share).toPrecision(1) : Math.abs(share).toFixed(0)} %)`;
  });

  /** The verdict's first words, the rest of it and the first numbers, from the Markdown of the report. */
  this.said = ({ first_screen, balance, document: { verdict: { tone } } }) => {
    const lines = first_screen.split("\n");
    const quoted = (begin) => lines.filter((line) => line.startsWith(begin)).map((line) => line.slice(2));
    const [first = "", ...others] = quoted("> ");
    // "Works. 1.6 mm instead of 4 mm; ...", and why it is mixed.
    const why = /, not the steady [^;]*/.exec(first)?.[0].replace(/\.$/, "") ?? "", [amounts, ...parts] = first.split("; ");
    const rests = parts.findIndex((part) => part.includes("stays inactive")), idle = rests < 0 ? "" : `; ${parts.splice(rests, 1)[0].replace(/\.$/, "")}`;
    const [begin, rest] = [inPercent(amounts) + why + idle, parts.join("; ").replace(why, "")];
    const said = [rest && rest[0].toUpperCase() + rest.slice(1).replace(/([^.])$/, "$1."), ...others].filter(Boolean).map(sentence);
    const [names = [], , numbers = [], layers = []] = lines.filter((line) => line.startsWith("|")).map(cells);
    const known = sentence(begin), brackets = /±|\(\+[\d.]+\s[^%d]/.test(known.textContent);
    return {
      tone, first: [...known.childNodes, ...(brackets ? [make("small", {}, " ± and brackets: how far it may be off")] : [])],
      rest: [...(balance ? [make("p", {}, balance)] : []),
        make("section", { class: `verdict ${tone ?? ""}`, hidden: !said.length }, ...said), ...quoted("- ").map((line) => sentence(line.replace(/Line \d+ of the case: /, ""))),
        make("dl", { class: "live-numbers" }, ...names.map((name, k) => make("div", {}, make("dt", {}, name), make("dd", {}, numbers[k], make("small", {}, layers[k]))))),
        make("p", { class: "live-note" }, "A tuned mass damper is tuned to the structure and needs its stroke as room; the ball is not tuned and needs its cavity.")],
    };
  };

  // The map's mark: an axis value is `at`, and one in SI `values`.
  const star = button("★", () => {}, { class: "live-mark", "aria-label": "This case on the map; arrow keys change frequency and clearance" });
  function showMap(answer) {
    if (answer.problems) { figures.get("map")?.remove(); figures.delete("map"); return; }
    const focused = document.activeElement === star, drawing = page.draw(answer).firstChild;
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
    sheet.onpointerup = sheet.onpointercancel = () => { sheet.onpointermove = null; page.settle(); };
    star.onkeydown = (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!way) return;
      event.preventDefault();
      const shares = places().map((share, k) => share + 0.01 * way[k]);
      put(shares);
      page.pause();
    };
    mark();
  }
  const now = () => ["frequency", "clearance"].map((key) => page.controls().find((one) => one.key === key));
  /** Where the case is: shares of the axes. */
  function places() {
    return now().map((of, k) => { const [first, last, log] = chart.axes[k]; return share({ range: [first, last], log }, of.value / chart.factor[k]); });
  }
  function put(shares) {
    now().forEach((of, k) => {
      const [first, last, log] = chart.axes[k];
      page.move(of, along({ range: [first, last], log }, Math.min(1, Math.max(0.002, shares[k]))) * chart.factor[k]);
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
