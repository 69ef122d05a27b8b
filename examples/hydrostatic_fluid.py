#!/usr/bin/python3
"""A fluid by formula in the place of fluid_solver: hydrostatic pressure, and the added mass of a reservoir that a wall pushes
(Westergaard 1933), on what the solid has of faces towards the first [[fluid.region]].

    ./run.sh cases/elastic_gate --fluid examples/hydrostatic_fluid.py

    p = rho g d + m_a dv/dt,   m_a = 7/8 rho sqrt(H d)

at the depth d below the surface of water of the depth H, v the velocity of the face towards the water. The added mass is heavier
than most solids, and a load that answers the motion of the window before would throw them about. So the fluid tells an
impedance: in the default scheme the solid moves against it at once, and the water that goes with the face takes the impulse
when the next window starts. By the trapezoidal rule that water, at u, takes m_a (2 v - 2 u) in a window of the mean velocity v.
"""

import numpy as np

from toryu.participant import Fluid, Health, Load


class HydrostaticFluid(Fluid):
    state = ("u",)

    def __init__(self, case):
        super().__init__(case)
        fluid = case["fluid"]
        self.density, self.sound_speed, self.spacing = fluid["density"], fluid["sound_speed"], fluid["spacing"]
        self.reach = 2.5 * self.spacing
        self.time_step_limit = self.spacing / self.sound_speed
        self.g = -case["case"]["gravity"][1]
        self.low, self.high = (np.array(fluid["region"][0]["box"][end]) for end in ("min", "max"))

    def begin(self, interface):
        # A corner has two faces, of which one may be dry.
        before = interface.position[:, None] + interface.spacing * np.sign(interface.area_vector)[:, :, None] * np.eye(2)
        wet = ((before > self.low) & (before < self.high)).all(axis=2)
        area = np.where(wet, interface.area_vector, 0)
        self.A = np.linalg.norm(area, axis=1)
        self.n = area / np.where(self.A > 0, self.A, 1)[:, None]
        depth = np.maximum(self.high[1] - interface.position[:, 1], 0)
        self.m = self.A * 7 / 8 * self.density * np.sqrt((self.high[1] - self.low[1]) * depth)  # [kg/m]
        self.u = np.zeros(len(self.A))  # of the water that goes with the face, along n [m/s]

    def advance(self, window, motion):
        work = 0.0
        if motion.impulse is not None:  # what the solid felt beyond the force of the last window
            u = self.u - np.divide((motion.impulse * self.n).sum(axis=1), self.m, out=np.zeros_like(self.m), where=self.m > 0)
            work, self.u = self.kinetic_energy(u) - self.kinetic_energy(self.u), u
        v = (motion.velocity * self.n).sum(axis=1)
        depth = np.maximum(self.high[1] - motion.position[:, 1], 0)
        order = 1 if motion.impulse is None else 2  # the trapezoidal rule needs the impedance
        push = self.A * self.density * self.g * depth + order * self.m * (v - self.u) / window.dt  # [N/m]
        self.u = self.u + order * (v - self.u)
        pressure = np.divide(push, self.A, out=np.zeros_like(push), where=self.A > 0)
        load = Load(pressure, -push[:, None] * self.n, work_of_impulse=work)
        if motion.impulse is not None:
            load.impedance = (self.m / window.dt)[:, None] * self.n  # the coupler doubles it
        return load

    def kinetic_energy(self, u):
        return (self.m * u ** 2).sum() / 2

    def health(self):
        return Health(kinetic_energy=self.kinetic_energy(self.u), momentum=(self.m * self.u) @ self.n)


if __name__ == "__main__":
    HydrostaticFluid.main()
