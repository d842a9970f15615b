  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  all(".scripted").forEach((part) => { part.hidden = false; });
  const number = ({ dataset: { order } }) => (order === undefined ? undefined : Number(order));
  const key = (cell, head) => (head.dataset.kind === "text" ? cell.textContent : number(cell));
  sortable(document.querySelector("#cases"), all("#cases th[data-kind]"), key);

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
