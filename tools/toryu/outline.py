"""Reads the outlines of a drawing, SVG or DXF, and prints them as rows of ring, x, y in metres: what the programs of
toryu read of a case that names such a file. Arcs and splines become chords, nowhere farther from them than the tolerance.

    python3 -I -X utf8 tools/toryu outline part.svg --id plate --unit mm --tolerance 1e-6

What is wrong with the drawing is printed as one line, the key of the case that it is about and the sentence, parted by a
tab; the program ends with 2 then.
"""

import argparse
import pathlib
import sys

from toryu import nearest, program
from toryu.installation import INSTALLER
from toryu.processes import BAD_INPUT, DONE, MACHINE

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254}
DEFAULT_TOLERANCE = 1e-4  # of the larger side
DEEPEST = 24  # halvings of a curve
ROUNDING = 1e-9  # of the larger side: what is nearer is one place


class BadDrawing(Exception):
    """What is wrong, and with which key of the case it can be mended."""

    def __init__(self, key, message):
        super().__init__(message)
        self.key = key


def flatten(curve, tolerance):
    """Points of `curve`, a function of 0 <= t <= 1, but for its first: chords that lie nearer to it than `tolerance` at
    their quarters."""
    points = []

    def halve(t_a, a, t_b, b, depth):
        within = all(distance_to_chord(curve(t_a + share * (t_b - t_a)), a, b) <= tolerance for share in (0.25, 0.5, 0.75))
        if within or depth == DEEPEST:
            points.append(b)
            return
        t = (t_a + t_b) / 2
        middle = curve(t)
        halve(t_a, a, t, middle, depth + 1)
        halve(t, middle, t_b, b, depth + 1)

    begin, middle, end = curve(0.0), curve(0.5), curve(1.0)
    halve(0.0, begin, 0.5, middle, 1)  # an arc may be closed, and then it has no chord
    halve(0.5, middle, 1.0, end, 1)
    return points


def distance_to_chord(p, a, b):
    x, y = b[0] - a[0], b[1] - a[1]
    length = x * x + y * y
    share = min(1.0, max(0.0, ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / length)) if length > 0 else 0.0
    return ((a[0] + share * x - p[0]) ** 2 + (a[1] + share * y - p[1]) ** 2) ** 0.5


def unit_of(stated, told, words):
    """Metres of a unit of the drawing: as the case states it or as the file tells it, never a guess."""
    if stated is None and told is None:
        raise BadDrawing("file", f"the file does not say its unit ({words}): give 'unit', one of "
                         f"{', '.join(map(repr, METRES))}")
    if stated is None:
        return told
    if told is not None and abs(told / METRES[stated] - 1) > 1e-6:
        raise BadDrawing("unit", f"the file says {words}, so its unit is {told:.6g} m: leave 'unit' out")
    return METRES[stated]


def larger_side(points):
    xs, ys = zip(*points)
    return max(max(xs) - min(xs), max(ys) - min(ys))


def near(a, b, distance):
    return abs(a[0] - b[0]) <= distance and abs(a[1] - b[1]) <= distance


def distinct(points, distance):
    """The points but for those that are as good as the one before."""
    kept = points[:1]
    kept += [point for before, point in zip(points, points[1:]) if not near(before, point, distance)]
    return kept


def joined(chains, tolerance, unit):
    """Rings of `chains` (lists of points), whose ends are joined where they are nearer than `tolerance`."""
    def is_ring(chain):
        return len(chain) > 2 and near(chain[0], chain[-1], tolerance)

    rings = [chain[:-1] for chain in chains if is_ring(chain)]
    chains = [chain for chain in chains if len(chain) > 1 and not is_ring(chain)]
    cells = {}
    for number, chain in enumerate(chains):
        for point in (chain[0], chain[-1]):
            cells.setdefault((round(point[0] / tolerance), round(point[1] / tolerance)), []).append((number, point))

    def others(number, point):
        column, row = round(point[0] / tolerance), round(point[1] / tolerance)
        return [n for i in (-1, 0, 1) for j in (-1, 0, 1) for n, end in cells.get((column + i, row + j), [])
                if n != number and near(end, point, tolerance)]

    left = dict.fromkeys(range(len(chains)))
    while left:
        first = number = next(iter(left))
        del left[first]
        ring = list(chains[first])
        while not near(ring[0], ring[-1], tolerance):
            found = others(number, ring[-1])
            if len(found) > 1:
                raise BadDrawing("file", f"{len(found) + 1} lines meet at {at(ring[-1], unit)}: an outline has two at "
                                 "each corner")
            if not found or found[0] not in left:
                raise BadDrawing("file", f"the outline is open at {at(ring[-1], unit)}")
            number = found[0]
            del left[number]
            chain = chains[number]
            ring += chain[1:] if near(chain[0], ring[-1], tolerance) else chain[-2::-1]
        rings.append(ring[:-1])
    return rings


def at(point, unit):
    """A place in metres."""
    return f"({point[0] * unit:.6g}, {point[1] * unit:.6g}) m"


def read_svg(path, options):
    """Rings of an SVG file in metres. y points up, from the lower edge of the page if it has one."""
    import io
    import xml.etree.ElementTree as xml

    import svgelements

    tree = xml.parse(path)
    root = tree.getroot()
    page = [float(x) for x in root.get("viewBox", "").replace(",", " ").split()]
    unit = unit_of(options.unit, svg_unit(root, page), f"width=\"{root.get('width', '')}\"")
    for name in ("width", "height", "viewBox", "preserveAspectRatio"):
        root.attrib.pop(name, None)  # coordinates as they are written
    drawing = svgelements.SVG.parse(io.StringIO(xml.tostring(root, encoding="unicode")))
    shapes = list(svg_shapes(svgelements, drawing, options.id))
    top = page[1] + page[3] if len(page) == 4 else 0.0
    left = page[0] if len(page) == 4 else 0.0

    def place(point):
        return point.x - left, top - point.y

    side = larger_side([place(p) for shape in shapes for segment in shape if segment.end is not None
                        for p in (segment.start or segment.end, segment.end)]) or 1.0
    tolerance = options.tolerance / unit if options.tolerance else DEFAULT_TOLERANCE * side
    rings = []
    for shape in shapes:
        for part in shape.as_subpaths():
            points = distinct(svg_points(svgelements, part, place, tolerance), ROUNDING * side)
            if len(points) < 2:
                continue
            if not near(points[0], points[-1], ROUNDING * side):
                raise BadDrawing("file", f"the outline of {named(shape)} is open: it begins at {at(points[0], unit)} and "
                                 f"ends at {at(points[-1], unit)}")
            rings.append(points[:-1])
    return rings, unit


def svg_points(svgelements, part, place, tolerance):
    points = []
    for segment in svgelements.Path(part):
        if isinstance(segment, svgelements.Move):
            points = [place(segment.end)]
        elif isinstance(segment, (svgelements.Line, svgelements.Close)):
            if segment.end is not None and place(segment.end) != points[-1]:
                points.append(place(segment.end))
        else:
            points += flatten(lambda t, of=segment: place(of.point(t)), tolerance)
    return points


def svg_unit(root, page):
    """Metres of a unit of the page, if width and height say it in a physical unit."""
    def length(name):
        text = root.get(name, "").strip()
        for unit, metres in METRES.items():
            if text.endswith(unit) and text[:-len(unit)].strip().replace(".", "", 1).isdigit():
                return float(text[:-len(unit)]) * metres
        return None

    width, height = length("width"), length("height")
    if len(page) != 4 or width is None or height is None:
        return None
    along, across = width / page[2], height / page[3]
    if abs(along / across - 1) > 1e-3:
        raise BadDrawing("file", f"the page is {width:g} m by {height:g} m for {page[2]:g} by {page[3]:g} units: the two "
                         "directions have different scales")
    return along


def svg_shapes(svgelements, drawing, name):
    """Paths of the element `name`, of all it holds if it is a group; without a name of the whole drawing."""
    element = drawing
    if name is not None:
        element = drawing.get_element_by_id(name)
        if element is None:
            names = sorted({e.id for e in drawing.elements() if getattr(e, "id", None)})
            raise BadDrawing("id", f"no element '{name}' in the file{nearest(name, names)}")
    inner = element.select() if isinstance(element, svgelements.Group) else [element]
    found = False
    for shape in inner:
        if isinstance(shape, svgelements.Shape):
            path = abs(svgelements.Path(shape))
            path.id = shape.id
            found = True
            yield path
    if not found:
        raise BadDrawing("id" if name else "file", f"{f'the element {name!r}' if name else 'the file'} holds no outline")


def named(shape):
    return f"'{shape.id}'" if shape.id else "an element without id"


def read_dxf(path, options):
    """Rings of a DXF file in metres."""
    import ezdxf
    from ezdxf import units
    from ezdxf.disassemble import recursive_decompose

    drawing = ezdxf.readfile(path)
    code = drawing.header.get("$INSUNITS", 0)
    told = units.conversion_factor(units.InsertUnits(code), units.M) if code in DXF_UNITS else None
    unit = unit_of(options.unit, told, f"$INSUNITS = {code}")
    entities = list(recursive_decompose(drawing.modelspace()))
    layers = sorted({entity.dxf.layer for entity in entities})
    if options.layer is not None and options.layer not in layers:
        raise BadDrawing("layer", f"no layer '{options.layer}' with lines in the file{nearest(options.layer, layers)}")
    chosen = [e for e in entities if options.layer in (None, e.dxf.layer)]
    coarse = [chain for e in chosen for chain in dxf_chains(e, None)]
    if not coarse:
        raise BadDrawing("file", "the file holds no outline")
    side = larger_side([point for chain in coarse for point in chain]) or 1.0
    tolerance = options.tolerance / unit if options.tolerance else DEFAULT_TOLERANCE * side
    chains = [chain for e in chosen for chain in dxf_chains(e, tolerance)]
    return joined(chains, min(tolerance, 1e-6 * side), unit), unit


DXF_UNITS = {1, 2, 4, 5, 6, 13, 14}  # that have a length: in, ft, mm, cm, m, um, dm


def dxf_chains(entity, tolerance):
    """The lines of an entity as lists of points; with no tolerance coarse ones."""
    kind = entity.dxftype()

    def flat(points):
        return [[(p[0], p[1]) for p in points]]

    if kind == "LINE":
        return flat([entity.dxf.start, entity.dxf.end])
    if kind in ("LWPOLYLINE", "POLYLINE"):
        return [chain for part in entity.virtual_entities() for chain in dxf_chains(part, tolerance)]
    if kind in ("ARC", "CIRCLE"):
        points = list(entity.flattening(min(tolerance or entity.dxf.radius / 8, entity.dxf.radius / 2)))
        return flat(points if kind == "ARC" else points[:-1] + points[:1])
    if kind in ("ELLIPSE", "SPLINE"):
        return flat(entity.flattening(tolerance or 1e300, segments=4))
    return []  # dimensions, texts, hatches


def rings_of(path, options):
    read = {".svg": read_svg, ".dxf": read_dxf}[path.suffix.lower()]
    try:
        rings, unit = read(path, options)
    except (BadDrawing, ImportError, MemoryError):
        raise
    except Exception as error:  # the libraries have no exception of their own for all that a file can hold
        words = " ".join(str(error).split())[:200]
        raise BadDrawing("file", f"cannot be read as {path.suffix[1:].upper()}: {words}") from error
    if not rings:
        raise BadDrawing("file", "the file holds no outline")
    return [[(x * unit, y * unit) for x, y in ring] for ring in rings]


def main(arguments):
    parser = argparse.ArgumentParser(prog="outline", description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--id")
    parser.add_argument("--layer")
    parser.add_argument("--unit", choices=METRES)
    parser.add_argument("--tolerance", type=float, default=0.0, metavar="METRES")
    options = parser.parse_args(arguments)
    try:
        rings = rings_of(options.file, options)
    except BadDrawing as error:
        print(f"{error.key}\t{error}")
        return BAD_INPUT
    except ImportError as error:
        print(f"file\tneeds the package '{error.name}' of Python to be read: {INSTALLER} import")
        return MACHINE
    print("ring,x[m],y[m]")
    for number, ring in enumerate(rings):
        for x, y in ring:
            print(f"{number},{x!r},{y!r}")
    program.must_be_printed()
    return DONE


if __name__ == "__main__":
    program.run(main)
