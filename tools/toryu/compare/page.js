// Two runs in one picture: the first one in its colours and the second one as an outline, or either alone.
class BodyOfRun extends Body {
  // Frames of two runs lie at times of their own.
  indexAt(time) { return nearestTo(time, this.times); }
}

class Pair {
  constructor(runs) {
    this.runs = runs.map((run) => ({...run, bodies: run.bodies.map((body) => new BodyOfRun(body))}));
    this.bodies = this.runs.flatMap((run) => run.bodies);
    this.stage = new Stage(byId("particles"), content.view, runs[0].walls, this.bodies);
    const wallsDiffer = JSON.stringify(runs[0].walls) !== JSON.stringify(runs[1].walls);
    this.stage.over.push((stage, time) => this.both && wallsDiffer && stage.outlineWalls(runs[1].walls, time));
    this.show("both");
  }

  // `which`: "both", or the number of a run.
  show(which) {
    this.both = which === "both";
    this.styles = this.both ? ["coloured", "outlined"] : [0, 1].map((k) => k === +which ? "coloured" : "hidden");
    this.runs.forEach(({bodies}, k) => { for (const body of bodies) body.style = this.styles[k]; });
    this.stage.walls = this.runs[this.both ? 0 : +which].walls;
  }

  // Which run is drawn how, and of which time.
  moveTo(time) {
    const place = byId("drawn");
    place.replaceChildren();
    this.runs.forEach(({name, bodies}, k) => {
      if (this.styles[k] === "hidden") return;
      const [body] = bodies, at = body.times[body.indexAt(time)].toFixed(4);
      html("span", {class: this.styles[k]}, place, `${name}, ${this.styles[k]}, at ${at} s`);
    });
  }
}

if (content.runs) {
  const pair = new Pair(content.runs), player = new Player([pair.stage], content.times, [pair]);
  new Saver(player);
  for (const name of new Set(pair.bodies.map((body) => body.name))) {
    const bodies = pair.bodies.filter((body) => body.name === name);
    if (bodies[0].quantities.length) player.bars.push(colourChoice(byId("colours"), bodies, () => player.redraw()));
  }
  byId("shown").addEventListener("change", () => {
    pair.show(byId("shown").value);
    player.show(player.wanted);
  });
}
