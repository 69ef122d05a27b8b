// Joins the page: player, exaggeration, charts.
function makeCharts(times) {
  const charts = [];
  const add = (parent, list) => { for (const one of list) charts.push(new Chart(parent, one, times)); };
  byId("compared").hidden = !content.compared.length;
  add(byId("compared").querySelector(".charts"), content.compared);
  for (const [name, list] of Object.entries(content.others)) {
    // What the coupler tells is of the exchange and of the machine: for who looks for it.
    const folded = name === "coupler" && html("details", {}, byId("audits").querySelector("details"));
    if (folded) html("summary", {}, folded, "Series of the coupler");
    else html("h3", {}, byId("others"), name);
    add(html("div", {class: "charts"}, folded || byId("others")), list);
  }
  byId("others").hidden = !Object.keys(content.others).some((name) => name !== "coupler");
  return charts;
}

// From 0 to the end of the run, of which the references may go on.
function span() {
  const all = [...content.compared, ...Object.values(content.others).flat()].flatMap((chart) => chart.lines);
  const ends = all.filter((line) => line.kind === "line" && line.points.length).map((line) => line.points.at(-1)[0]);
  const starts = all.filter((line) => line.kind === "line" && line.points.length).map((line) => line.points[0][0]);
  return ends.length ? [Math.min(...starts), Math.max(...ends)] : [0, 1];
}

// What stands beside the picture: what moves by prescription, and what happened along the surface.
const BESIDE = {...WIDE, width: 600, height: 168};

function makeBeside() {
  const followers = content.motions.map((chart) => new Chart(byId("beside"), chart, [0, content.end], BESIDE));
  if (!content.along.quantities) return {followers};
  const along = new Along(byId("beside"), content.along, BESIDE);
  return {followers: [...followers, along], along};
}

function makeStages(bodies) {
  const [x0, y0, x1, y1] = content.view;
  const tall = (content.motions.length > 0 || content.near !== null) && y1 - y0 > 1.4 * (x1 - x0);
  byId("scene").classList.toggle("tall", tall);
  byId("near").hidden = !content.near;
  byId("beside").hidden = !byId("beside").children.length;
  const whole = new Stage(byId("particles"), content.view, content.walls, bodies, {tall});
  if (!content.near) return [whole];
  const near = new Stage(byId("enlarged"), content.near, content.walls, bodies, {tall, disc: 0.43});
  whole.over.push(() => whole.outline(near));
  return [whole, near];
}

// The displacement of a solid that moves less than the eye sees can be exaggerated.
function offerExaggeration(near, bodies, changed) {
  const solid = bodies.find((body) => body.displacement);
  if (!near || !solid) return;
  const {low, high, typical} = solid.displacement;
  if (!(typical > 0) || typical > 0.3 * solid.spacing) return;
  const wished = solid.spacing / typical, power = 10 ** Math.floor(Math.log10(wished));
  const most = [5, 2, 1].find((s) => s * power <= wished) * power;
  byId("exaggeration").hidden = false;
  for (const factor of [1, most / 10, most].filter((f) => f >= 1))
    html("option", {value: factor}, byId("factor"), factor === 1 ? "as it is" : `× ${rounded(factor)}`);
  byId("factor").value = near.factor = most;
  byId("factor").addEventListener("change", () => { near.factor = +byId("factor").value; changed(); });
}

// What is drawn otherwise than it is, for people.
function tellDrawn(near, along) {
  const solid = near.factor > 1 ? `Displacement of the solid: drawn ${rounded(near.factor)} times as large.` : "";
  byId("drawn").textContent = `${along?.quantity ? along.bandText(near) : ""} ${solid}`;
}

const {followers, along} = makeBeside();
const charts = makeCharts(span());
const bodies = content.bodies.map((body) => new Body(body));
const times = [...new Set(bodies.flatMap((body) => body.times))].sort((a, b) => a - b);
byId("motion").hidden = !times.length;
let player = null;
if (times.length) {
  const stages = makeStages(bodies), near = stages[1];
  if (content.telling.mark) for (const stage of stages) stage.over.push((_, time) => stage.mark(content.telling.mark, time));
  player = new Player(stages, times, [...followers, ...charts]);
  new Saver(player);
  for (const body of bodies)
    if (body.quantities.length) player.bars.push(colourChoice(byId("colours"), [body], () => player.redraw()));
  const redraw = () => {
    if (near) tellDrawn(near, along);
    player.redraw();
  };
  offerExaggeration(near, bodies, redraw);
  if (near) tellDrawn(near, along);
  if (along) {
    const choose = async () => {
      await along.choose(+along.select.value);
      along.moveTo(player.time);
      redraw();
    };
    along.select.addEventListener("change", choose);
    if (near) near.over.push((stage) => along.draw(stage));
    choose();
  }
}
