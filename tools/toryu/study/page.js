// Sorting of the tables by their headings, and the runs that are picked out.
function valueOf(row, column) {
  const cell = row.cells[column], number = parseFloat(cell.dataset.value);
  return Number.isNaN(number) ? cell.textContent : number;
}

function compare(a, b) {
  if (typeof a === typeof b) return typeof a === "number" ? a - b : a.localeCompare(b);
  return typeof a === "number" ? -1 : 1;
}

function sortBy(table, heading) {
  const descending = heading.getAttribute("aria-sort") === "ascending";
  for (const other of heading.parentNode.cells) other.removeAttribute("aria-sort");
  heading.setAttribute("aria-sort", descending ? "descending" : "ascending");
  const body = table.tBodies[0], column = heading.cellIndex;
  const rows = [...body.rows].sort((a, b) => compare(valueOf(a, column), valueOf(b, column)) * (descending ? -1 : 1));
  body.append(...rows);
}

function pick(row) {
  const picked = row.classList.toggle("picked");
  for (const other of document.querySelectorAll(`[data-run="${row.dataset.run}"]`)) other.classList.toggle("picked", picked);
  for (const line of document.querySelectorAll(`[id="run-${row.dataset.run}"]`)) line.classList.toggle("picked", picked);
  for (const drawn of document.querySelectorAll("figure.drawn"))
    drawn.classList.toggle("picking", drawn.querySelector("[id^=run-].picked") !== null);
}

for (const table of document.querySelectorAll("table.sortable")) {
  for (const heading of table.tHead.rows[0].cells) heading.addEventListener("click", () => sortBy(table, heading));
  for (const row of table.tBodies[0].rows)
    row.addEventListener("click", (event) => { if (!event.target.closest("a")) pick(row); });
}
