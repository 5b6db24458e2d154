"use strict";
// Puts a button into every head of a sortable table: a first press sorts by its column, a second
// turns the order round, a third restores the order of the page. A cell sorts by its data-value, a
// number, or by its text; cells without a value stay last. A page prints as it was written.
(() => {
  const next = { none: "ascending", ascending: "descending", descending: "none" };

  const value = (row, column) => {
    const cell = row.cells[column];
    const given = cell.dataset.value;
    if (given === undefined) return cell.textContent.trim();
    const number = Number(given.replace("inf", "Infinity"));
    return given === "" || Number.isNaN(number) ? null : number;
  };

  const compare = (a, b) =>
    typeof a === "number" && typeof b === "number"
      ? a - b
      : String(a).localeCompare(String(b), "en", { numeric: true });

  const arranged = (rows, column, order) => {
    if (order === "none") return rows;
    const sign = order === "ascending" ? 1 : -1;
    const keyed = rows.map((row) => [value(row, column), row]);
    const known = keyed.filter(([key]) => key !== null);
    const unknown = keyed.filter(([key]) => key === null);
    known.sort(([a], [b]) => sign * compare(a, b));
    return [...known, ...unknown].map(([, row]) => row);
  };

  for (const table of document.querySelectorAll("table.sortable")) {
    const body = table.tBodies[0];
    const written = [...body.rows];
    const heads = [...table.tHead.rows[0].cells];
    let shown = { column: 0, order: "none" };

    const sort = (column, order) => {
      body.replaceChildren(...arranged(written, column, order));
      heads.forEach((head, index) => {
        if (index === column && order !== "none") head.setAttribute("aria-sort", order);
        else head.removeAttribute("aria-sort");
      });
    };

    heads.forEach((head, column) => {
      if (head.dataset.sort === "no") return;
      const button = document.createElement("button");
      button.type = "button";
      button.title = "Sort by this column";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const now = shown.column === column ? shown.order : "none";
        shown = { column, order: next[now] };
        sort(column, shown.order);
      });
    });
    addEventListener("beforeprint", () => sort(shown.column, "none"));
    addEventListener("afterprint", () => sort(shown.column, shown.order));
  }
})();
