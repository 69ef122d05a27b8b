"""The frames of this run in ParaView, coloured, over their times:

    paraview --script=frames.py              # or --state=frames.py, or File > Load State
    pvpython frames.py PICTURE.png [TIME]    # a picture of TIME [s], else of the end
"""

import os
import sys

from paraview import simple

# What the report fills in: where the results are, x min, y min, x max and y max of what happens [m], and of each body its
# series and spacing [m], the field that colours it, and the range of that over all frames.
FOLDER = ...
VIEW = ...
BODIES = ...
GREY = [0.66, 0.69, 0.72]  # of what has no field
NOT_FINITE = [1, 0, 1]
BARS = 0.14  # of the width, for the bars of the colours
PICTURE = [1600, 900]  # [pixels]


def folder():
    """Where this run is: the window of ParaView does not tell a script where it stands, and results may have been moved."""
    if "__file__" in globals():
        return os.path.dirname(os.path.abspath(__file__))
    for place in (os.getcwd(), FOLDER):
        script = os.path.join(place, "frames.py")
        if os.path.isfile(script):
            with open(script, encoding="utf-8") as file:
                if f"\nBODIES = {BODIES!r}\n" in file.read():
                    return place
    raise RuntimeError("frames.py: the results are no more in " + FOLDER + "; change into their folder and start "
                       "paraview --script=frames.py there")


def show(body, view):
    """Particles as discs of their spacing."""
    source = simple.OpenDataFile(os.path.join(folder(), body["series"]))
    simple.RenameSource(body["name"], source)
    display = simple.Show(source, view)
    display.SetRepresentationType("Point Gaussian")
    display.GaussianRadius = body["spacing"] / 2
    display.ShaderPreset = "Plain circle"
    if body["field"]:
        colour(body, display, view)
    else:
        display.ColorArrayName = [None, ""]
        display.AmbientColor = display.DiffuseColor = GREY
    return source


def colour(body, display, view):
    """By a field, over the range of all frames; a map of its own, for two bodies may have fields of one name."""
    simple.ColorBy(display, ("POINTS", body["field"], body["component"]) if body["component"] else ("POINTS", body["field"]),
                   separate=True)
    colours = simple.GetColorTransferFunction(body["field"], display, separate=True)
    colours.ApplyPreset(body["colours"], True)
    colours.RescaleTransferFunction(body["low"], body["high"])
    colours.AutomaticRescaleRangeMode = "Never"
    colours.NanColor = NOT_FINITE
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = body["title"], ""
    display.SetScalarBarVisibility(view, True)


def look_at(view, box):
    """Straight at the plane of the flow, as large as the window bears, beside the bars of the colours."""
    x0, y0, x1, y1 = box
    x1 += BARS / (1 - BARS) * (x1 - x0)
    width, height = view.ViewSize
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [(x0 + x1) / 2, (y0 + y1) / 2, 0]
    view.CameraPosition = [(x0 + x1) / 2, (y0 + y1) / 2, max(x1 - x0, y1 - y0)]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = max(y1 - y0, (x1 - x0) * height / width) / 2


def draw(picture, time):
    view = simple.GetActiveViewOrCreate("RenderView")
    sources = [show(body, view) for body in BODIES]
    simple.Show(simple.AnnotateTimeFilter(sources[0]), view)
    simple.SetActiveSource(sources[0])
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    if picture:
        view.ViewSize = PICTURE
        scene.AnimationTime = scene.EndTime if time is None else time
    simple.Render(view)  # the first one moves the camera
    look_at(view, VIEW)
    simple.Render(view)
    if picture:
        simple.SaveScreenshot(picture, view)


def arguments():
    """Picture and time of pvpython's command line; a window has none."""
    picture, time = (*sys.argv[1:3], None, None)[:2]
    if not sys.argv[0].endswith("frames.py"):
        return None, None
    try:
        return picture, time and float(time)
    except ValueError:
        sys.exit(f"frames.py: error: TIME is a number of seconds, found '{time}'")


draw(*arguments())
