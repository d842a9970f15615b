  // Tables of some length sort by a column: by its numbers, in whatever prefix of the unit each is, or else by its words.
  const PREFIX = { p: 1e-12, n: 1e-9, "\u00b5": 1e-6, m: 1e-3, k: 1e3, M: 1e6 };
  const NUMBER = /^\+?([\u2212-]?\d[\d.]*(?:e[+-]?\d+)?)(?:\s*\u00d7\s*10([\u2212-]?\d+))?\s*([pn\u00b5mkM](?=[msgNJWH]))?(\S*)/;
  const number = (text) => {
    const [, digits, power = "0", prefix, unit] = NUMBER.exec(text) ?? [];
    if (digits === undefined) return undefined;
    const [factor, tens] = [digits, power].map((part) => Number(part.replace("\u2212", "-")));
    return { value: factor * 10 ** tens * (PREFIX[prefix] ?? 1), unit };
  };
  const text = (cell) => cell.textContent.trim();
  document.querySelectorAll(".table:not(.tiles) table").forEach((table) => {
    const rows = [...(table.tBodies[0]?.rows ?? [])];
    if (rows.length < 4) return;
    const heads = [...table.tHead.rows[0].cells].filter(text);
    const columns = new Map(heads.map((head) => {
      const there = rows.map((row) => text(row.cells[head.cellIndex])).filter((one) => !["", "\u2013"].includes(one));
      const numbers = there.map(number);
      const units = new Set(numbers.filter((one) => one).map(({ unit }) => unit));
      return [head, { words: numbers.includes(undefined), units: units.size }];
    }));
    // One that lists different quantities has no order.
    if ([...columns.values()].some(({ units }) => units > 1)) return;
    const key = (cell, head) => (columns.get(head).words ? text(cell) || undefined : number(text(cell))?.value);
    sortable(table, heads, key);
  });

  // Numbers of a marked point: the browser shows them at a pointer; here under a finger, and by the arrow keys.
  const FINGER = 30;
  document.querySelectorAll(".drawing").forEach((drawing) => {
    // Of the usual drawing and the narrow one that which is seen.
    const seen = () => [...drawing.querySelectorAll("svg")].find((one) => one.checkVisibility());
    const marked = (svg) => [...(svg?.querySelectorAll("svg * > title") ?? [])];
    if (marked(drawing).length === 0) return;
    const told = document.createElement("p");
    told.className = "told";
    told.setAttribute("role", "status");
    drawing.after(told);
    drawing.setAttribute("aria-description", "The arrow keys tell the marked points one by one.");
    const ring = document.createElementNS("http://www.w3.org/2000/svg", "circle");
    const middle = (title) => {
      const box = title.parentNode.getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    let chosen = -1;
    const choose = (titles, place) => {
      chosen = place;
      const svg = seen();
      const [x, y] = middle(titles[place]);
      const back = svg.getScreenCTM().inverse();
      const at = new DOMPoint(x, y).matrixTransform(back);
      ring.setAttribute("cx", at.x);
      ring.setAttribute("cy", at.y);
      ring.setAttribute("r", 9 * back.a);
      ring.setAttribute("stroke-width", 2 * back.a);
      ring.setAttribute("stroke", "#000000");
      svg.append(ring);
      told.textContent = titles[place].textContent;
      const figure = drawing.parentNode.getBoundingClientRect();
      const left = Math.min(x - figure.x + 14, figure.width - told.offsetWidth - 4);
      told.style.left = `${Math.max(left, 4)}px`;
      told.style.top = `${y - figure.y + 14}px`;
    };
    const leave = () => {
      chosen = -1;
      ring.remove();
      told.textContent = "";
    };
    drawing.addEventListener("pointerup", (event) => {
      const far = (title) => {
        const [x, y] = middle(title);
        return Math.hypot(x - event.clientX, y - event.clientY);
      };
      const titles = marked(seen());
      const nearest = titles.reduce((a, b) => (far(b) < far(a) ? b : a));
      if (far(nearest) < FINGER) choose(titles, titles.indexOf(nearest)); else leave();
    });
    drawing.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (event.key === "Escape") leave();
      if (!step) return;
      event.preventDefault();
      const titles = marked(seen());
      choose(titles, (chosen + step + titles.length + (chosen < 0 && step < 0)) % titles.length);
    });
    drawing.addEventListener("blur", leave);
  });

  // Sections fold. On a phone those begin folded that are the evidence for what stands above them.
  const EVIDENCE = ["band", "which-layer-answered", "motions", "margins", "theory-and-exact-orbits", "validation", "figures", "inputs"];
  const APPENDIX = "p:has(> a[id^='page-'])";
  const narrow = matchMedia("(max-width: 40rem)").matches;
  const unfold = new Map();
  document.querySelectorAll("main > h2").forEach((heading) => {
    const body = document.createElement("div");
    const ends = (one) => !one || one.matches(`h1, h2, footer, ${APPENDIX}`);
    while (!ends(heading.nextElementSibling)) body.append(heading.nextElementSibling);
    heading.after(body);
    const button = document.createElement("button");
    button.append(...heading.childNodes);
    heading.append(button);
    const fold = (folded) => {
      button.setAttribute("aria-expanded", String(!folded));
      // Where a browser can, a search in the page finds what is folded.
      body.hidden = folded ? "until-found" : false;
    };
    button.addEventListener("click", () => fold(!body.hidden));
    body.addEventListener("beforematch", () => fold(false));
    unfold.set(heading, () => fold(false)).set(body, () => fold(false));
    fold(narrow && (EVIDENCE.includes(heading.id) || heading.matches(`${APPENDIX} ~ h2`)));
  });
  const arrive = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const section = [...unfold.keys()].find((one) => target && one.contains(target));
    if (!section) return;
    unfold.get(section)();
    target.scrollIntoView();
  };
  addEventListener("hashchange", arrive);
  arrive();
