"""What a recession cannot do with a case, said before the first flow is computed: of the case as it will run, with all
that the study and the command line set."""

from toryu.study import removed_depth
from toryu.study.recession_surface import OF_PRESSURE

NARROWER = 0.95  # share of 'gap' that the narrowest passage may have


def of(view, case):
    """The faults of a case, (key of [recession], words)."""
    return [fault for look in (nothing_off, worn, shapes, gap, rows, pressure, goals) if (fault := look(view, case))]


def boxes(things):
    """Those of the things that have one with sides."""
    return [thing for thing in things if "min" in thing.get("box", {}) and "max" in thing["box"]]


def pieces(case):
    return boxes(wall for wall in case.get("wall", []) if wall.get("work_piece"))


def nothing_off(_, case):
    if not case.get("fluid", {}).get("removal") or not any(wall.get("work_piece") for wall in case.get("wall", [])):
        return "", "nothing comes off: the case needs [fluid.removal] and a [[wall]] with 'work_piece = true'"
    return None


def worn(_, case):
    if any("worn" in wall for wall in case.get("wall", [])):
        return "", "the case has walls that are 'worn': the study says how far they are"
    return None


def shapes(_, case):
    for wall in case.get("wall", []):
        box = wall.get("box") or {}
        laid = any(wall.get(key) for key in ("rotate", "translate", "array")) or wall.get("mirror", "none") != "none" or (
            wall.get("scale", 1) != 1)
        if wall.get("work_piece") and ("min" not in box or box.get("round") or laid):
            return "", (f"the work piece '{wall.get('name', '')}' is no box as it stands: a recession wears the faces of boxes "
                        "that say where they are")
    return None


def gap(view, case):
    narrowest, between = narrowest_passage(case, view.along)
    if narrowest < NARROWER * view.gap:
        return "gap", (f"'gap' is the narrowest passage at the start: it is {view.gap:g} m here, and {narrowest:.4g} m are "
                       f"{between}")
    return None


def narrowest_passage(case, along):
    """The least distance [m] across the flow between a work piece and a wall that faces it, with fluid in between, and
    between what it lies; without such walls the fluid's own width."""
    across, found = 1 - along, []
    fluid = [region["box"] for region in boxes(case.get("fluid", {}).get("region", []))]
    for piece in pieces(case):
        for wall in boxes(case["wall"]):
            low, high = sorted((piece["box"], wall["box"]), key=lambda box: box["min"][across])
            begin, end = max(low["min"][along], high["min"][along]), min(low["max"][along], high["max"][along])
            middle = [0.0, 0.0]
            middle[along], middle[across] = (begin + end) / 2, (low["max"][across] + high["min"][across]) / 2
            width = high["min"][across] - low["max"][across]
            wet = any(all(box["min"][k] <= middle[k] <= box["max"][k] for k in (0, 1)) for box in fluid)
            if begin < end and width > 0 and wet:
                found.append((width, f"between '{piece['name']}' and '{wall['name']}'"))
    if fluid and not found:
        sides = 2 if case.get("case", {}).get("geometry") == "axisymmetric" else 1
        width = max(box["max"][across] for box in fluid) - min(box["min"][across] for box in fluid)
        found.append((sides * width, "the width of the fluid"))
    return min(found, default=(float("inf"), ""))


def rows(view, case):
    if removed_depth.rows_inside(case, view.window) < 1:
        return "shares", ("'shares' holds fewer than three rows of surface.h5: give the case a smaller 'series_interval', now "
                          f"{case['case']['series_interval']:g} s of {case['case']['end_time']:g} s")
    return None


def pressure(view, case):
    if not view.pressure:
        return None
    sides = [(piece["box"]["min"][view.along], piece["box"]["max"][view.along]) for piece in pieces(case)]
    for place, _ in view.pressure.rows:
        if sides and not any(low - view.gap <= place <= high + view.gap for low, high in sides):
            return "pressure", f"'pressure' has a row at {place:g} m, and no work piece lies there along {'xy'[view.along]}"
    law = removed_depth.law_in(case)
    if law and law not in OF_PRESSURE:
        return "pressure", f"'pressure' needs a law of pressure times speed, and {law} is none"
    return None


def goals(view, case):
    for goal in view.until:
        if goal.name == "gap" and goal.value <= view.gap:
            return "until", f"the gap grows: 'until' must name more than 'gap', {view.gap:g} m, found {goal.value:g}"
        if goal.name != "roughness":
            continue
        law = case.get("fluid", {}).get("removal", {}).get("roughness")
        if not law:
            return "until", "'until' names a roughness, and the case has no [fluid.removal.roughness]"
        if not law["final"] < goal.value < law["initial"]:
            return "until", (f"the roughness falls from {law['initial']:g} towards {law['final']:g} m: 'until' must name one "
                             f"in between, found {goal.value:g}")
    return None
