#!/usr/bin/env python3
"""Prints the coefficients of shaders/lib/psi.glsl and psi_short.glsl.

Each is a minimax fit of the relative error, found as a linear programme over Chebyshev nodes.
Needs numpy and scipy; nothing of the build does.
"""
import numpy as np
from scipy.optimize import linprog
from scipy.special import dawsn, erfcx

NODES, WEIGHTS = (v / 2 for v in np.polynomial.legendre.leggauss(40))


def chebyshev(low, high, count):
    return low + (high - low) * (1 + np.cos(np.linspace(0, np.pi, count))) / 2


def minimax(columns, values, weights):
    """x with the least max |weights (columns x - values)|, and that maximum."""
    matrix = columns * weights[:, None]
    wanted = values * weights
    scale = np.abs(matrix).max(0)
    ones = np.ones((len(values), 1))
    matrix = matrix / scale
    result = linprog(np.r_[np.zeros(matrix.shape[1]), 1],
                     A_ub=np.block([[matrix, -ones], [-matrix, -ones]]),
                     b_ub=np.r_[wanted, -wanted] * 1e7,  # HiGHS stops at errors of 1e-7
                     bounds=[(None, None)] * (matrix.shape[1] + 1), method='highs')
    x = result.x[:-1] / scale * 1e-7
    return x, np.abs(columns @ x - values).__mul__(weights).max()


def polynomial(t, values, degree):
    return minimax(t[:, None] ** np.arange(degree + 1), values, 1 / values)


def rational(t, values, up, down, rounds=8):
    below, best = np.ones_like(t), (None, 1)
    for _ in range(rounds):
        columns = np.hstack([t[:, None] ** np.arange(up + 1),
                             -values[:, None] * t[:, None] ** np.arange(1, down + 1)])
        x, _ = minimax(columns, values, 1 / np.abs(values * below))
        below = np.polyval(np.r_[1, x[up + 1:]][::-1], t)
        error = np.abs(np.polyval(x[up::-1], t) / below / values - 1).max()
        if error < best[1]:
            best = (x, error)
    return best


def asymmetry(m, e):
    """N of psi.glsl: int y (m + 2 e y) exp(-m y - e (y y - 1/4)) dy over [-1/2, 1/2]."""
    m, e = np.asarray(m)[:, None], np.asarray(e)[:, None]
    return (WEIGHTS * NODES * (m + 2 * e * NODES) *
            np.exp(-m * NODES - e * (NODES * NODES - 0.25))).sum(-1)


def triangle(limit, slope):
    """Points (m, r) with m <= limit and |r| <= slope(m)."""
    return np.array([(max(m, 1e-6), t * slope(max(m, 1e-6)))
                     for m in chebyshev(0, limit, 41) for t in chebyshev(-1, 1, 31)]).T


def show(name, coefficients, error):
    print(f'{name}: {error:.1e}:', ' '.join(f'{np.float32(c):.9g}' for c in coefficients))


def thin():
    m, r = triangle(2, lambda m: 1)
    e = m * r
    terms = [(0, j) for j in range(1, 7)] + [(2, j) for j in range(6)] + \
            [(4, j) for j in range(4)] + [(6, 0), (6, 1), (8, 0)]
    terms.append((6, 2))
    values = asymmetry(m, e)
    weights = 1 / (np.sinh(m / 2) + values) / np.minimum(1, 0.1 + 0.45 * m)  # exact when thin
    fit = minimax(np.stack([m ** i * e ** j for i, j in terms], 1),
                  values - np.float64(np.float32(1 / 6)) * e, weights)
    show(f'N, m^i e^j {terms}', *fit)
    x = chebyshev(1e-4, 1, 200)
    value = -np.expm1(-x)
    show('(x - (1 - exp(-x)))/x^2, x <= 1',
         *minimax(x[:, None] ** np.arange(6), (x - value) / x ** 2, x ** 2 / value))


def thick():
    t = chebyshev(1e-4, 1, 400)
    x = 2 * (1 / t - 1)
    value = np.sqrt(np.pi) / 2 * erfcx(x) / t
    show('erfcx(x) sqrt(pi)/2 (1 + x/2) in (1 - x/2)/(1 + x/2)',
         *polynomial(2 * t - 1, value, 10))
    u = chebyshev(1e-9, 9, 300)
    show('dawson(x)/x in x^2, x < 3 (up, down)',
         *rational(u, dawsn(np.sqrt(u)) / np.sqrt(u), 5, 5))
    x = 1 / np.sqrt(chebyshev(1e-7, 1 / 9, 300))
    show('2 x dawson(x) in 1/(4 x^2), x >= 3', *polynomial(0.25 / x ** 2, 2 * x * dawsn(x), 9))


def short():
    m, r = triangle(0.5, lambda m: min(1, 0.5 / m - 1))
    sinh = 2 * np.sinh(m / 2) / m
    values = asymmetry(m, m * r) / (m * sinh)
    terms = [(0, 1), (2, 1), (2, 3), (1, 0), (1, 2), (3, 0), (3, 2), (3, 4)]
    show(f'h - 1/2, m^i r^j {terms}',
         *minimax(np.stack([m ** i * r ** j for i, j in terms], 1), values, 1 / (0.5 + values)))
    x = chebyshev(1e-9, 0.5, 200)
    show('(1 - exp(-x))/x, x <= 1/2', *polynomial(x, -np.expm1(-x) / x, 4))


if __name__ == '__main__':
    thin()
    thick()
    short()
