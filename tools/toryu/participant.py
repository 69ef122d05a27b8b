"""A fluid or a solid of a coupled run that is written in Python, in the place of fluid_solver or solid_solver:

    class MySolid(Solid):
        state = ("x", "v")                                # what a window changes

        def begin(self, reach):
            ...
            return Interface(position, volume, area_vector, mass, spacing)

        def advance(self, window, load):
            ...
            return Motion(position, velocity)

    if __name__ == "__main__":
        MySolid.main()

    ./run.sh CASE --solid my_solid.py

Arrays have a row a particle of the interface, and two columns where they are vectors. What is answered is checked: another
shape is an error (exit code 1), what is not finite a failure of physics (3). common/link/participant.hpp is the same
interface in C++.
"""

import dataclasses
import functools
import io
import json
import os
import pathlib
import re
import sys
import threading
from dataclasses import dataclass

import numpy as np

from toryu import PROGRAMS
from toryu.own_code import give_up_threads, mistake_of, sources
from toryu.processes import BAD_INPUT, BUG, PHYSICS_FAILED

COLUMN = re.compile(r'([^,"\[\]]+)\[([^,"\[\]]*)\]')  # as CSV has it without quotes
NUMBERS = (bool, int, float, complex)  # of Python, whose arithmetic is that of numpy's
LARGEST_ID = 2**32 - 1


class PhysicsFailure(Exception):
    """To be raised where a value left physics: the run ends with 3."""


class BadInput(Exception):
    """To be raised where the case is wrong: the run ends with 2."""


class WrongAnswer(Exception):
    """What the code of a participant answered is no answer."""


@dataclass
class Interface:
    """The solid's particles that the fluid may touch, in the reference configuration."""

    position: np.ndarray  # n x 2 [m]
    volume: np.ndarray  # n [m2 per metre depth]
    area_vector: np.ndarray  # n x 2, outward [m per metre depth]; zero inside
    mass: np.ndarray  # n [kg per metre depth]
    spacing: float  # [m]
    id: np.ndarray | None = None  # n, the solid's numbers of the particles; None: 0, 1, 2, ...
    velocity: np.ndarray | None = None  # from a solid: at the start, n x 2 [m/s]; None: at rest


@dataclass
class Motion:
    """Kinematics of the interface at the end of a window."""

    position: np.ndarray  # n x 2 [m]
    velocity: np.ndarray  # n x 2 [m/s]
    # From a solid, what it took beyond the force of the load, by the load's impedance; to a fluid, what it is to give to
    # the interface when the window starts: n x 2 [N s per metre depth], or None.
    impulse: np.ndarray | None = None
    work_of_impulse: float = 0.0  # from a solid: what that impulse did to it [J per metre]
    # From a solid, the sum of load times sub-step as it applied it, impulse included [N s per metre]; None: all of it.
    impulse_taken: np.ndarray | None = None


@dataclass
class Load:
    """What the fluid does to the interface, averaged over a window."""

    pressure: np.ndarray  # n [Pa]
    force: np.ndarray  # n x 2, pressure and viscous force [N per metre depth]
    friction_force: np.ndarray | None = None  # n x 2 [N per metre depth]
    # How the fluid answers the normal velocity of the interface, along the outward normal, n x 2 [kg/(s.m)]. A particle at
    # v feels force + n z n.(velocity - v), z the length of the impedance.
    impedance: np.ndarray | None = None
    velocity: np.ndarray | None = None  # to a solid: of the fluid's copy of the interface, n x 2 [m/s]
    # From a fluid, what it received from the interface [N s per metre]; None: what it gave, with the other sign.
    impulse_on_fluid: np.ndarray | None = None
    work_of_impulse: float = 0.0  # from a fluid: what the impulse of the motion did to it [J per metre]


@dataclass
class Window:
    """A stretch of time in which the load is constant."""

    number: int
    iteration: int  # above 0 it is computed again, from the state at its start
    time: float  # start [s]
    dt: float  # length [s]


@dataclass
class Health:
    """What a participant says of itself for coupler.csv and the report."""

    kinetic_energy: float = 0.0  # [J per metre]
    potential_energy: float = 0.0  # [J per metre]
    momentum: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(2))  # [N s per metre]


class Participant:
    """What fluids and solids have in common."""

    state = None  # names of the attributes that a window changes, arrays or numbers, () if there are none: they are kept
    # for windows that are repeated and in checkpoints. None: this participant can do neither.

    def __init__(self, case):
        """`case` holds what the case says, base and --set included: case["fluid"]["density"]."""
        self.case = case

    def observe(self):
        """Numbers for fluid.csv or solid.csv: {"tip_displacement_x[m]": 0.01}, the same columns at each call."""
        return {}

    def health(self):
        return Health()

    def count_step(self):
        """To be called now and then in a window that takes long, by the thread that calls `advance`: who neither steps nor
        answers within the time limit of the coupling counts as hung. Ends the window where the run has ended."""

    @classmethod
    def main(cls):
        """Runs the participant as a program with the options of the solvers, named as its file, and ends Python with its
        exit code."""
        name = pathlib.Path(sys.argv[0]).stem
        module = compiled()
        code = module.run(name, cls.side, cls.state is not None, sources(), functools.partial(Checked, cls), sys.argv)
        threading.Thread(target=give_up_threads, args=[name, code], daemon=True).start()
        sys.exit(code)


class Fluid(Participant):
    """A fluid: `begin(interface)` once, then `advance(window, motion)`, which answers a Load, in each window."""

    side = "fluid"
    reach = 0.0  # how deep its kernel sees into the solid [m]
    time_step_limit = 0.0  # bounds the next window [s]
    density = 0.0  # at rest [kg/m3]
    sound_speed = 0.0  # [m/s]
    spacing = 0.0  # [m]


class Solid(Participant):
    """A solid: `begin(reach)`, which answers the Interface that a fluid can touch that sees `reach` [m] deep, then
    `advance(window, load)`, which answers a Motion, in each window."""

    side = "solid"


def compiled():
    """The compiled part, which a build leaves beside the programs."""
    sys.path.append(str(PROGRAMS))
    try:
        import toryu_participant
    except ImportError as error:
        print(f"error: the module toryu_participant cannot be loaded: {error}; 'tools/install.sh python && tools/build.sh "
              "release -DTORYU_PYTHON=ON toryu_participant' builds it", file=sys.stderr)
        sys.exit(BAD_INPUT)
    return toryu_participant


class Checked:
    """A participant as the compiled part calls it: plain values in, checked ones out."""

    def __init__(self, kind, case_as_json):
        self.name = kind.__name__
        if isinstance(kind.state, str):
            raise WrongAnswer(f"{self.name}: 'state' is the text '{kind.state}', not a tuple of names: ('{kind.state}',)")
        self.participant = called(kind, json.loads(case_as_json)["content"])
        self.count = 0  # of the interface's particles
        self.columns = None  # that the first row has
        self.kept = {}  # the state at the start of the window
        self.misuse = None  # of a method that is there to be called

    def count_steps_by(self, count):
        caller = threading.get_ident()

        def count_step():
            if threading.get_ident() != caller:  # the link is one thread's, and would not tell when `advance` hangs
                self.misuse = WrongAnswer(f"{self.name}.count_step is called by the thread "
                                          f"'{threading.current_thread().name}', not by that which calls 'advance'")
                sys.exit()  # the thread
            count()

        self.participant.count_step = count_step

    # What it answers
    def ask(self, method, *arguments):
        if not hasattr(self.participant, method):
            raise WrongAnswer(f"{self.name} has no method '{method}'")
        try:
            return called(getattr(self.participant, method), *arguments)
        finally:
            if self.misuse:
                raise self.misuse

    def answer(self, kind, method, *arguments):
        """What a method of the participant answers, which must be of that kind."""
        found = self.ask(method, *arguments)
        if not isinstance(found, kind):
            raise WrongAnswer(f"{self.name}.{method} answered {'nothing' if found is None else type(found).__name__}, not "
                              f"{kind.__name__}")
        return found

    def numbers(self, name, value, *shape):
        """`value` as an array of that shape, of finite numbers."""
        try:
            found = np.asarray(value)
        except ValueError as error:  # rows of several lengths
            raise WrongAnswer(f"{self.name}: {name} is no array: {error}") from None
        if found.dtype.kind not in "fiub":
            raise WrongAnswer(f"{self.name}: {name} is of the type {found.dtype}, not of real numbers")
        if found.shape != shape:
            raise WrongAnswer(f"{self.name}: {name} has the shape {found.shape}, not {shape}")
        if not np.isfinite(found).all():
            place = tuple(np.argwhere(~np.isfinite(found))[0])
            of = f" of interface particle {place[0]}" if shape and shape[0] == self.count else ""
            raise PhysicsFailure(f"{self.name}: {name}{of} is {found[place]}")
        return np.ascontiguousarray(found, dtype=float)

    def fields(self, found, shapes):
        """The fields of an answer by their names; those that may be left out are None then."""
        optional = {field.name for field in dataclasses.fields(found) if field.default is None}
        values = {name: getattr(found, name) for name in shapes}
        return {name: None if value is None and name in optional else self.numbers(name, value, *shapes[name])
                for name, value in values.items()}

    # The run

    def traits(self):
        return {name: self.numbers(name, getattr(self.participant, name))
                for name in ("reach", "time_step_limit", "density", "sound_speed", "spacing")}

    def begin(self, given):
        if isinstance(self.participant, Fluid):
            self.count = len(given["id"])
            self.ask("begin", Interface(**given))
            self.look_at_state()
            return None
        found = self.answer(Interface, "begin", given)
        self.count = n = np.size(found.volume)
        if found.id is None:
            found.id = np.arange(n)
        if found.velocity is None:
            found.velocity = np.zeros((n, 2))
        told = self.fields(found, {"id": (n,), "position": (n, 2), "volume": (n,), "area_vector": (n, 2), "mass": (n,),
                                   "spacing": (), "velocity": (n, 2)})
        self.check_above_zero(told, "volume", "mass", "spacing")
        self.look_at_state()
        return told | {"id": self.numbers_of_particles(told["id"])}

    def check_above_zero(self, told, *names):
        for name, k in ((name, k) for name in names for k in np.flatnonzero(told[name] <= 0)):
            of = "" if name == "spacing" else f" of interface particle {k}"
            raise WrongAnswer(f"{self.name}: {name}{of} is {told[name][k]:g}, not above 0")

    def numbers_of_particles(self, found):
        wrong = np.flatnonzero((found < 0) | (found > LARGEST_ID) | (found != np.floor(found)))
        if len(wrong) or len(np.unique(found)) < len(found):
            why = f"holds {found[wrong[0]]:g}" if len(wrong) else "holds a number twice"
            raise WrongAnswer(f"{self.name}: id {why}; particles have integers from 0 to {LARGEST_ID}, each its own")
        return found.astype(int).tolist()

    def advance(self, number, iteration, time, dt, given):
        window, n = Window(number, iteration, time, dt), self.count
        if isinstance(self.participant, Fluid):
            found = self.answer(Load, "advance", window, Motion(**given))
            told = self.fields(found, {"pressure": (n,), "force": (n, 2), "friction_force": (n, 2), "impedance": (n, 2),
                                       "impulse_on_fluid": (2,), "work_of_impulse": ()})
            if told["impulse_on_fluid"] is None:
                told["impulse_on_fluid"] = -total(dt, told, given["impulse"])
            return told
        found = self.answer(Motion, "advance", window, Load(**given))
        told = self.fields(found, {"position": (n, 2), "velocity": (n, 2), "impulse": (n, 2), "impulse_taken": (2,),
                                   "work_of_impulse": ()})
        if told["impulse_taken"] is None:
            told["impulse_taken"] = total(dt, given, told["impulse"])
        return told

    def health(self):
        return self.fields(self.answer(Health, "health"), {"kinetic_energy": (), "potential_energy": (), "momentum": (2,)})

    def observe(self):
        row = []
        for column, value in self.answer(dict, "observe").items():
            parts = COLUMN.fullmatch(str(column))
            if not parts or not str(column).isprintable() or column == "time[s]":
                raise WrongAnswer(f"{self.name}.observe names a column {str(column)!r}, not as 'name[unit]'"
                                  + " other than the time's, without commas and quotes")
            row.append((*parts.groups(), float(self.numbers(column, value))))
        columns = [name for name, _, _ in row]
        if self.columns not in (None, columns):
            raise WrongAnswer(f"{self.name}.observe answers the columns {', '.join(columns)}, and before "
                              f"{', '.join(self.columns)}: they must stay the same")
        self.columns = columns
        return row

    # The state

    def look_at_state(self):
        """From the first window on it must be there."""
        if self.participant.state is not None:
            self.copied_state()

    def copied_state(self):
        return {name: np.array(self.numbers_of_state(name)) for name in self.participant.state}

    def numbers_of_state(self, name):
        if not hasattr(self.participant, name):
            raise WrongAnswer(f"{self.name}: {name}, which 'state' names, is not there when 'begin' has ended")
        value = getattr(self.participant, name)
        if isinstance(value, (list, tuple)):  # would come back as an array
            raise WrongAnswer(f"{self.name}: {name}, which 'state' names, is a {type(value).__name__}, not a number or an "
                              "array")
        value = np.asarray(value)
        if value.dtype.kind not in "fiubc":
            raise WrongAnswer(f"{self.name}: {name}, which 'state' names, is of the type {value.dtype}, not of numbers")
        return value

    def put(self, state):
        for name, value in state.items():
            setattr(self.participant, name, value.copy() if value.ndim or value.dtype not in NUMBERS else value.item())

    def save(self):
        self.kept = self.copied_state()

    def restore(self):
        self.put(self.kept)

    def state_as_bytes(self):
        stream = io.BytesIO()
        np.savez(stream, **self.copied_state())
        return stream.getvalue()

    def take_state(self, content):
        with np.load(io.BytesIO(content)) as found:
            state = dict(found)
        if set(state) != set(self.participant.state):
            raise BadInput(f"{self.name}: the checkpoint holds the state {sorted(state)}, not "
                           f"{sorted(self.participant.state)}")
        self.put(state)


def called(function, *arguments):
    """What a function of the participant answers, which must take that many arguments."""
    try:
        return function(*arguments)
    except TypeError as error:
        if error.__traceback__.tb_next is None:  # its body was not reached
            raise WrongAnswer(str(error)) from None
        raise


def total(dt, load, impulse):
    """The impulse of a window [N s per metre]: of the forces of a load, and what comes beyond them."""
    parts = [dt * load["force"], load["friction_force"], impulse]
    if parts[1] is not None:
        parts[1] = dt * parts[1]
    return sum(part.sum(axis=0) for part in parts if part is not None)


def ending_of(error):
    """Exit code and reason of the end that an exception brings."""
    if isinstance(error, PhysicsFailure):
        return PHYSICS_FAILED, str(error)
    if isinstance(error, BadInput):
        return BAD_INPUT, str(error)
    if isinstance(error, WrongAnswer):
        return BUG, str(error)
    return BUG, mistake_of(error, __file__)
