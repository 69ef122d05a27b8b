// Keeps the page of a running run up to date, until its end brings the final report.
const live = new EventSource(`events?from=${encodeURIComponent(JSON.stringify(content.live))}`);
const drawnColumns = new Map(charts.flatMap((chart) => chart.content.lines.filter((line) => line.column)
  .map((line) => [line.column, {chart, line}])));
const told = (kind, act) => live.addEventListener(kind, (event) => act(JSON.parse(event.data)));

// A quantity or a body that this page has no place for makes a new page.
function renew() {
  live.close();
  location.reload();
}

told("rows", ({name, columns, rows}) => {
  const clock = columns.indexOf("time[s]"), grown = new Set();
  if (clock < 0) return;
  for (const [k, column] of columns.entries()) {
    const place = drawnColumns.get(`${name}:${column}`);
    if (!place) {
      if (!["time[s]", "window[1]"].includes(column) && rows.some((row) => row[k] !== null)) return renew();
      continue;
    }
    const {chart, line} = place, factor = chart.content.factor;
    let last = line.points.length ? line.points.at(-1)[0] : -Infinity;
    for (const row of rows) {
      if (row[clock] === null || row[clock] <= last) continue;
      last = row[clock];
      const value = row[k] === null ? null : row[k] * factor;
      if (factor > 1 && Math.abs(value) >= 1000) return renew();  // a larger unit suits it better
      line.points.push([last, value]);
      grown.add(chart);
    }
  }
  const shown = span();
  for (const chart of grown.size ? charts : []) {
    chart.grow(shown);
    if (player) chart.moveTo(player.time);
  }
});

told("frame", ({bodies: newest, view}) => {
  if (!newest.length) return;
  if (newest.length !== bodies.length || newest.some((one, i) => one.name !== bodies[i].name || one.quantities.length !== bodies[i].quantities.length)) return renew();
  newest.forEach((one, i) => {
    Object.assign(bodies[i], one, {decoded: new Map()});
    bodies[i].choose(bodies[i].chosen);
  });
  const time = Math.max(...newest.flatMap((one) => one.times));
  player.times.splice(0, player.times.length, time);
  const [stage] = player.stages, before = stage.home;
  stage.home = before.map((edge, i) => (i < 2 ? Math.min : Math.max)(edge, view[i]));
  if (stage.home.some((edge, i) => edge !== before[i])) stage.fit();
  player.show(0);
});

told("progress", (text) => { byId("progress").textContent = text; });

told("warnings", (lines) => {
  const box = byId("warnings") || html("div", {class: "words stopped", id: "warnings"}, document.querySelector("header"));
  box.hidden = !lines.length;
  box.replaceChildren();
  for (const line of lines) html("p", {}, box, line);
});

told("end", renew);

// A server that is away is gone: what the page shows stays.
live.onerror = () => {
  if (live.readyState !== EventSource.CLOSED) byId("told").textContent = "No connection: this page shows what was last known.";
};
live.onopen = () => { byId("told").textContent = ""; };

byId("stop").addEventListener("click", async () => {
  byId("stop").disabled = true;
  byId("told").textContent = "Asked to write a last checkpoint and to end.";
  const answer = await fetch("stop", {method: "POST", headers: {"X-Toryu": "stop"}}).catch(() => null);
  if (answer?.ok) return;
  byId("stop").disabled = false;
  byId("told").textContent = "The run could not be asked to end.";
});
// There is one frame to show, and figures are taken at the end.
document.querySelector(".tiles").style.display = byId("motion").querySelector(".note").style.display = "none";
for (const id of ["play", "time", "video", "speed"]) (byId(id).closest("label") || byId(id)).hidden = true;
