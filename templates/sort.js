  // Heads of a table that sort its rows. The key of a cell is a number, a text, or undefined, which comes last in either
  // direction.
  const sortable = (table, heads, key) => {
    const body = table.tBodies[0];
    const rows = [...body.rows];
    const first = new Map(rows.map((row, place) => [row, place]));
    const sort = (head) => {
      const down = head.getAttribute("aria-sort") === "ascending";
      table.querySelectorAll("th[aria-sort]").forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const keys = new Map(rows.map((row) => [row, key(row.cells[head.cellIndex], head)]));
      rows.sort((a, b) => {
        const [left, right] = [keys.get(a), keys.get(b)];
        const missing = (left === undefined) - (right === undefined);
        const order = left === right ? 0 : (left < right ? -1 : 1) * (down ? -1 : 1);
        return missing || order || first.get(a) - first.get(b);
      });
      body.append(...rows);
    };
    heads.forEach((head) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      button.addEventListener("click", () => sort(head));
      head.append(button);
    });
  };
