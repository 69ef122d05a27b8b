"""Writes coupon.csv: depths of the coupon as they would be measured, by the exact solution of the slit and a stated scatter.

    python3 cases/abrasive_coupon/synthetic.py

A Newtonian medium that slides by u_s = b tau_w between two plates: U = G (b w/2 + w^2/(12 mu)), u_s = b G w/2. In a symmetric
cycle the pressure at any place that the medium never leaves is on the mean the one at which it is held, weighted by its way:
the depth a cycle is k p (u_s/U) times the way of the medium.
"""

import pathlib
import random

MU, B, K = 1000.0, 3e-7, 2.5e-12  # Pa s, m/(Pa s), 1/Pa
U, W, P, WAY, CYCLES = 0.05, 2e-3, 3.0e6, 4.2e-3, 2000  # m/s, m, Pa, m a cycle
BETWEEN = 6e-3  # m, of the observers
PRESSURE_SCATTER, DEPTH_SCATTER = 0.02, 0.05  # shares of the exact values
SEED = 13


def pressure_gradient(width=W):
    return U / (B * width / 2 + width**2 / (12 * MU))


def slip_share(width=W):
    """u_s/U."""
    return B * pressure_gradient(width) * width / 2 / U


def depth_a_cycle(width=W):
    return K * P * slip_share(width) * WAY


if __name__ == "__main__":
    noise = random.Random(SEED)
    drop = pressure_gradient() * BETWEEN
    print(f"pressure drop: value = {drop * (1 + PRESSURE_SCATTER * noise.gauss(0, 1)):.4g}, scatter = "
          f"{PRESSURE_SCATTER * drop:.2g}")
    depth = CYCLES * depth_a_cycle()
    rows = [f"{x * 1e-3:g},{depth * (1 + DEPTH_SCATTER * noise.gauss(0, 1)):.4g},{DEPTH_SCATTER * depth:.2g}"
            for x in (5.5, 6, 7, 8, 9, 10, 11, 12, 12.5)]
    text = "# synthetic, by synthetic.py\nplace[m],depth[m],scatter[m]\n" + "\n".join(rows) + "\n"
    pathlib.Path(__file__).with_name("coupon.csv").write_text(text, encoding="utf-8")
