"""The frames of two runs for one player: at the times that both reached, of the quantities that both have, over one range."""

from toryu.report import frames, player, scene


def collect(runs, names):
    """What the player needs, {} if a run has no frames; and what to say of it. `runs`: folder and case of each, its faults."""
    found = [frames.read_bodies(out, faults) for out, _, faults in runs]
    without = [name for name, bodies in zip(names, found) if not bodies]
    if without:
        return {}, f"Nothing is drawn: {' and '.join(without)} left no frames."
    keep_common_times(found)
    keep_common_quantities(*found)
    step = frames.chosen_frames([body for bodies in found for body in bodies])
    boxes = [[frames.measure(body, frames.domain_of(used.content)) for body in bodies]
             for bodies, (_, used, _) in zip(found, runs)]
    share_ranges(*found)
    content = {"view": scene.view_of([box for of_run in boxes for box in of_run]), "runs": [
        {"name": name, "walls": scene.walls_of(used.content, used.outlines, used.motions),
         "bodies": [frames.content_of(body, box, used.content) for body, box in zip(bodies, of_run)]}
        for name, bodies, of_run, (_, used, _) in zip(names, found, boxes, runs)]}
    return content | {"times": times_of(found[0])}, player.left_out(step)


def times_of(bodies):
    return sorted({time for body in bodies for time, _ in body.files})


def keep_common_times(found):
    """Leaves out frames that not all bodies of both runs reached: a last frame stands for half an interval more."""
    bodies = [body for of_run in found for body in of_run]
    end = min(times[-1] + (times[-1] - times[-2]) / 2 if len(times) > 1 else times[-1]
              for times in (times_of([body]) for body in bodies))
    for body in bodies:
        body.files = [file for file in body.files if file[0] <= end] or body.files[:1]


def pairs(first, second):
    """Bodies of both runs by one name."""
    others = {body.name: body for body in second}
    return [(body, others[body.name]) for body in first if body.name in others]


def keep_common_quantities(first, second):
    """In one order, so that a choice of colour is one for both."""
    for body, other in pairs(first, second):
        there = {(q.label, q.unit): q for q in other.quantities}
        body.quantities = [q for q in body.quantities if (q.label, q.unit) in there]
        other.quantities = [there[q.label, q.unit] for q in body.quantities]


def share_ranges(first, second):
    for body, other in pairs(first, second):
        for q, r in zip(body.quantities, other.quantities):
            q.low, q.high = r.low, r.high = min(q.low, r.low), max(q.high, r.high)
