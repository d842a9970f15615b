"use strict";
(() => {
  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  const body = document.querySelector("#cases tbody");
  const rows = [...body.rows];
  const byName = new Map(rows.map((row, place) => [row, place]));
  all(".scripted").forEach((part) => { part.hidden = false; });

  // What a cell is sorted by; undefined, which comes last in either direction, for nothing.
  const key = (row, column, kind) => {
    const cell = row.cells[column];
    if (kind === "text") return cell.textContent;
    return cell.dataset.order === undefined ? undefined : Number(cell.dataset.order);
  };
  const sort = (head) => {
    const down = head.getAttribute("aria-sort") === "ascending";
    all("#cases th[aria-sort]").forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const { cellIndex: column, dataset: { kind } } = head;
    rows.sort((a, b) => {
      const [left, right] = [key(a, column, kind), key(b, column, kind)];
      const missing = (left === undefined) - (right === undefined);
      const order = left === right ? 0 : (left < right ? -1 : 1) * (down ? -1 : 1);
      return missing || order || byName.get(a) - byName.get(b);
    });
    body.append(...rows);
  };
  all("#cases th[data-kind]").forEach((head) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    button.addEventListener("click", () => sort(head));
    head.replaceChildren(button);
  });

  const boxes = all("#cases input[type=checkbox]");
  const numbers = document.querySelector("#numbers");
  const compare = () => {
    const chosen = new Set(boxes.filter((box) => box.checked).map((box) => box.dataset.case));
    const enough = chosen.size > 1;
    all("#comparison [data-case]").forEach((part) => { part.hidden = !chosen.has(part.dataset.case); });
    all("tbody tr", numbers).forEach((row) => {
      const shown = all("td", row).filter((cell) => !cell.hidden);
      const texts = new Set(shown.map((cell) => cell.textContent.trim()));
      row.classList.toggle("differs", texts.size > 1);
      // No chosen case has this quantity.
      row.hidden = texts.size === 1 && texts.has("\u2013");
    });
    [numbers.parentElement, document.querySelector("#figures")].forEach((part) => { part.hidden = !enough; });
    document.querySelector("#clear").hidden = chosen.size === 0;
    document.querySelector("#chosen").textContent = enough
      ? `${chosen.size} cases; ≠ marks what differs.`
      : ["Check two or more cases in the table above.", "Check another case to compare with."][chosen.size];
  };
  boxes.forEach((box) => box.addEventListener("change", compare));
  document.querySelector("#clear").addEventListener("click", () => {
    boxes.forEach((box) => { box.checked = false; });
    compare();
    boxes[0].focus();
  });
  // A browser may keep the boxes of an earlier visit.
  compare();
})();
