"""A stand-in for paraview.simple that knows what frames.py asks for, by the names and with the values that ParaView 5.11.0
took from it, and refuses everything else as ParaView does. `session()` makes one; what was asked is in it."""

import json
import pathlib
import types

import h5py

PRESETS = {"Viridis (matplotlib)", "Inferno (matplotlib)", "Cool to Warm"}
REPRESENTATIONS = {"Point Gaussian", "Points", "Surface"}


class Proxy:
    """Takes the properties that there are, and no other."""

    allowed = ()

    def __init__(self, **values):
        self.__dict__.update(values)

    def __setattr__(self, name, value):
        if name not in self.allowed:
            raise AttributeError(f"{type(self).__name__} has no attribute {name}")
        self.__dict__[name] = value


class Source(Proxy):
    pass


class Display(Proxy):
    allowed = ("GaussianRadius", "ShaderPreset", "ColorArrayName", "AmbientColor", "DiffuseColor")

    def SetRepresentationType(self, name):
        assert name in REPRESENTATIONS, name
        self.__dict__["representation"] = name

    def SetScalarBarVisibility(self, view, shown):
        self.__dict__["bar_shown"] = shown


class Colours(Proxy):
    allowed = ("AutomaticRescaleRangeMode", "NanColor")

    def ApplyPreset(self, name, rescale):
        assert name in PRESETS, name
        self.__dict__["preset"] = name

    def RescaleTransferFunction(self, low, high):
        assert low < high
        self.__dict__["range"] = (low, high)


class Bar(Proxy):
    allowed = ("Title", "ComponentTitle")


class View(Proxy):
    allowed = ("ViewSize", "InteractionMode", "OrientationAxesVisibility", "CameraParallelProjection", "CameraFocalPoint",
               "CameraPosition", "CameraViewUp", "CameraParallelScale")


class Scene(Proxy):
    allowed = ("AnimationTime",)

    def UpdateAnimationUsingDataTimeSteps(self):
        self.__dict__["EndTime"] = max(time for source in self.session.sources for time in source.times)


class Session:
    def __init__(self):
        self.view = View(ViewSize=[844, 527])
        self.scene = Scene(session=self, AnimationTime=0.0)
        self.sources, self.saved, self.active, self.annotated = [], [], None, None

    def OpenDataFile(self, path):
        path = pathlib.Path(path)
        files = json.loads(path.read_text())["files"]
        self.sources.append(Source(path=path, times=[f["time"] for f in files], frame=path.parent / files[0]["name"]))
        return self.sources[-1]

    def RenameSource(self, name, source):
        source.__dict__["name"] = name

    def Show(self, source, view):
        assert view is self.view
        source.__dict__["display"] = Display(source=source, colours=None)
        return source.display

    def ColorBy(self, display, value, separate):
        association, field, *component = value
        with h5py.File(display.source.frame) as frame:
            shape = frame[f"VTKHDF/{ {'POINTS': 'PointData'}[association]}/{field}"].shape
        assert component == ([] if len(shape) == 1 else ["Magnitude"]), (value, shape)
        display.__dict__.update(field=field, colours=Colours(bar=Bar()))

    def GetColorTransferFunction(self, field, display, separate):
        assert (field, separate) == (display.field, True)
        return display.colours

    def GetScalarBar(self, colours, view):
        return colours.bar

    def AnnotateTimeFilter(self, source):
        self.annotated = source
        return Source()

    def GetActiveViewOrCreate(self, kind):
        assert kind == "RenderView"
        return self.view

    def GetAnimationScene(self):
        return self.scene

    def SetActiveSource(self, source):
        self.active = source

    def Render(self, view):
        """The first one moves the camera."""
        if "rendered" not in view.__dict__:
            view.__dict__.update(rendered=True, CameraFocalPoint=None, CameraParallelScale=None)

    def SaveScreenshot(self, path, view):
        self.saved.append((path, view.ViewSize, self.scene.AnimationTime))

    def modules(self):
        """For sys.modules."""
        package = types.ModuleType("paraview")
        package.simple = self
        return {"paraview": package, "paraview.simple": self}
