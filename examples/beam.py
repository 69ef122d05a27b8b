#!/usr/bin/python3
"""An Euler-Bernoulli beam of finite rotations in the place of solid_solver: the cantilever that the case's [[solid.region]]
is, held where the first [[solid.clamp]] begins.

    ./run.sh cases/elastic_gate --solid examples/beam.py

Links of the length l, turned by phi_i against the straight beam, with bending springs E'I/l between them and 2 E'I/l at the
clamp, half a link away; E' = E/(1 - nu^2), plane strain. With points of the plane as complex numbers, a particle at s along
the beam and xi across it lies at

    x = x_0 + t_0 sum_i C_i exp(i phi_i),   C_i = l of the links before its own, s - s_i + i xi of its own, 0 behind,

and Lagrange's equations with M = Re(conj(C exp(i phi))' m C exp(i phi)) are

    M phi'' = Re(conj(i C exp(i phi))' (f + m C phi'^2 exp(i phi))) - K phi,

advanced by the trapezoidal rule. Where the fluid tells its impedance z along the normals n, f has z n n.(v_s - v) beside the
force of the load, at the velocity of the beam itself. The error of small deflections is of second order in l.
"""

import numpy as np

from toryu.participant import Health, Interface, Motion, Solid

LINKS = 20


def filled(box, spacing):
    """Centres and sizes of the rectangles, nearly squares of the spacing, that fill a box; as complex numbers."""
    low, size = np.array(box["min"]), np.subtract(box["max"], box["min"])
    count = np.maximum(np.round(size / spacing), 1).astype(int)
    cell = size / count
    x, y = (low[k] + cell[k] * (np.arange(count[k]) + 0.5) for k in (0, 1))
    return (x[:, None] + 1j * y).ravel(), np.full(count.prod(), complex(*cell))


def vectors(z):
    return np.stack([z.real, z.imag], axis=1)


def numbers(v):
    return v[:, 0] + 1j * v[:, 1]


class Beam(Solid):
    state = ("phi", "rate")

    def __init__(self, case):
        super().__init__(case)
        solid = case["solid"]
        box, clamp = (np.array([b["min"], b["max"]]) for b in (solid["region"][0]["box"], solid["clamp"][0]["box"]))
        size, middle = box[1] - box[0], box.mean(axis=0)
        along = np.argmax(size)
        towards_tip = middle[along] > clamp.mean(axis=0)[along]
        root = middle.copy()
        root[along] = clamp.max(axis=0)[along] if towards_tip else clamp.min(axis=0)[along]
        direction = np.zeros(2)
        direction[along] = 1 if towards_tip else -1
        self.x_0, self.t_0 = complex(*root), complex(*direction)
        self.length = abs(box[int(towards_tip), along] - root[along])
        self.height = size[1 - along]
        self.spacing, self.density = solid["spacing"], solid["density"]
        self.x, cell = map(np.concatenate, zip(*(filled(region["box"], self.spacing) for region in solid["region"])))
        self.gravity = complex(*case["case"]["gravity"])
        self.phi, self.rate = np.zeros(LINKS), np.zeros(LINKS)

        bending = solid["youngs_modulus"] / (1 - solid["poissons_ratio"] ** 2) * self.height ** 3 / 12  # [N m]
        self.l = self.length / LINKS
        between = np.diff(np.eye(LINKS), axis=0)
        self.K = bending / self.l * (between.T @ between)
        self.K[0, 0] += 2 * bending / self.l
        self.arrange(cell / self.t_0)
        self.highest_frequency = np.sqrt(np.linalg.eigvals(np.linalg.solve(self.inertia(), self.K)).real.max())  # [1/s]

    def arrange(self, cell):
        """What follows from the particles, of the size `cell` along and across the beam: C, and the products that the equations need."""
        place = (self.x - self.x_0) / self.t_0
        s = place.real[:, None] - self.l * np.arange(LINKS)
        own = np.clip(np.floor(place.real / self.l), 0, LINKS - 1)[:, None] == np.arange(LINKS)
        self.C = np.where(own, s + 1j * place.imag[:, None], np.where(s > 0, self.l, 0))
        self.C[place.real < 0] = 0  # held
        self.held = np.where(place.real < 0, self.x, self.x_0)
        self.volume = abs(cell.real * cell.imag)
        self.mass = self.density * self.volume
        self.G = self.C.conj().T @ (self.mass[:, None] * self.C)
        side = np.sign(place.imag) * (abs(place.imag) > self.height / 2 - 0.75 * self.spacing)
        end = place.real > self.length - 0.75 * self.spacing
        self.area = self.t_0 * (abs(cell.imag) * end + 1j * abs(cell.real) * side)

    def begin(self, reach):
        return Interface(vectors(self.x), self.volume, vectors(self.area), self.mass, self.spacing)

    def advance(self, window, load):
        """In equal steps that resolve all modes: the velocity of one that is not changes its sign from step to step."""
        force = load.force if load.friction_force is None else load.force + load.friction_force
        n = numbers(force if load.impedance is None else load.impedance)
        z = abs(n) if load.impedance is not None else np.zeros(len(n))
        n = n / np.where(z > 0, z, 1)
        v_n = np.zeros(len(n)) if load.velocity is None else np.real(n.conj() * numbers(load.velocity))

        steps = int(np.ceil(window.dt * self.highest_frequency))
        impulse, work = np.zeros(len(n)), 0.0
        for _ in range(steps):
            x = self.position()
            self.step(window.dt / steps, numbers(force) + self.mass * self.gravity, n, z, v_n)
            moved = np.real(n.conj() * (self.position() - x))
            taken = z * (v_n * window.dt / steps - moved)
            impulse, work = impulse + taken, work + taken @ moved * steps / window.dt
            self.count_step()
        velocity = self.t_0 * (self.C @ (1j * self.rate * np.exp(1j * self.phi)))
        return Motion(vectors(self.position()), vectors(velocity), vectors(impulse * n), work)

    def step(self, dt, f, n, z, v_n):
        e = np.exp(1j * self.phi)
        B = np.real(n.conj()[:, None] * 1j * self.t_0 * self.C * e)  # normal velocities are B phi'
        Q = np.real(np.conj(1j * e) * (self.C.conj().T @ (f / self.t_0) + self.G @ (self.rate ** 2 * e)))
        Q += B.T @ (z * (v_n - B @ self.rate)) - self.K @ (self.phi + dt / 2 * self.rate)
        change = np.linalg.solve(self.inertia() + dt / 2 * B.T @ (z[:, None] * B) + dt ** 2 / 4 * self.K, dt * Q)
        self.phi = self.phi + dt * (self.rate + change / 2)
        self.rate = self.rate + change

    def position(self):
        return self.held + self.t_0 * (self.C @ np.exp(1j * self.phi))

    def inertia(self):
        e = np.exp(1j * self.phi)
        return np.real(np.conj(e)[:, None] * self.G * e)

    def health(self):
        return Health(kinetic_energy=self.rate @ self.inertia() @ self.rate / 2,
                      potential_energy=self.phi @ self.K @ self.phi / 2)

    def observe(self):
        tip = self.t_0 * self.l * (np.exp(1j * self.phi) - 1).sum()
        return {"tip_displacement_x[m]": tip.real, "tip_displacement_y[m]": tip.imag}


if __name__ == "__main__":
    Beam.main()
