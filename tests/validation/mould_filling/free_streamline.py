"""A plane jet that a circular cylinder splits, by free-streamline theory: free_streamline.py HALF_WIDTH

Prints, for a jet of that half width over the cylinder's radius, the angle by which either half is turned, the
force on the cylinder over rho U^2 times the jet's width, 1 - cos(angle), and how far round the cylinder the liquid
leaves it. T. Levi-Civita, Rend. Circ. Mat. Palermo 23, 1907; G. Birkhoff, E. Zarantonello, Jets, Wakes, and
Cavities, 1957. A wide jet (500) leaves the cylinder at 55 degrees, as S. Brodetsky, Proc. R. Soc. A 102, 1923.

The upper half, a strip 0 < psi < q of the potential w, is the upper half-plane of zeta = exp(pi w/q) with the axis
on (0, 1), the wetted cylinder on (1, b) and free surfaces elsewhere. On zeta = b/2 (1 - cos sigma)

    ln(U/|v|) + i theta = -sum a_n sin(n sigma) + i sum a_n cos(n sigma),

theta being the direction of the flow: 0 on the axis, pi/2 - s on the cylinder at the arc length s from the
stagnation point, which moves with ds = q/pi d(zeta)/zeta U/|v|. Far away theta = a_0. The jump at the stagnation
point, sigma_1, is summed in closed form. The liquid leaves where the free surface has the cylinder's curvature
(H. Villat), that is d ln(U/|v|)/d sigma = 0 at sigma = pi: elsewhere it would cut into the cylinder or
have tension upstream.
"""
import sys

import numpy as np

POINTS, MODES, ITERATIONS = 400, 200, 100


def wetted(half_width, b):
    """For a given b: angle far away, wetted arc over the radius, and d ln(U/|v|)/d sigma at its end."""
    first = np.arccos(1 - 2 / b)
    v = (np.arange(POINTS) + 0.5) / POINTS  # sigma = first + (pi - first) v^2: U/|v| is singular at the start
    sigma, weight = first + (np.pi - first) * v**2, 2 * (np.pi - first) * v / POINTS
    n = np.arange(1, MODES + 1)
    cosines, sines = np.cos(np.outer(n, sigma)), np.sin(np.outer(n, sigma))
    jump = 0.5 * np.log(np.sin((sigma + first) / 2) / np.sin((sigma - first) / 2))
    arc = np.zeros(POINTS)
    for _ in range(ITERATIONS):
        a = -2 / np.pi * (cosines @ (arc * weight))
        slowness = np.exp(jump - a @ sines)
        ds = half_width / np.pi / np.tan(sigma / 2) * slowness * weight
        arc = 0.5 * arc + 0.5 * (np.cumsum(ds) - 0.5 * ds)
    # sum n a_n (-1)^n converges slowly; by parts it is an integral of ds/d sigma.
    kink = np.sum(ds * np.tan(sigma / 2)) / np.pi
    turned = (np.pi - first) / 2 - np.sum(arc * weight) / np.pi
    return turned, np.sum(ds), kink - 0.5 * np.tan(first / 2)


def split(half_width):
    low, high = 1 + 1e-6, 1e4
    while high / low > 1 + 1e-8:
        b = np.sqrt(low * high)
        low, high = (b, high) if wetted(half_width, b)[2] < 0 else (low, b)
    return wetted(half_width, b)[:2]


if __name__ == "__main__":
    angle, arc = split(float(sys.argv[1]))
    print(f"turned by {np.degrees(angle):.2f} degrees, force {1 - np.cos(angle):.4f} rho U^2 b, "
          f"leaves at {np.degrees(arc):.2f} degrees")
