# SPDX-License-Identifier: BSD-3-Clause
"""Logistic regression with signs that are known beforehand."""
import numpy as np
from scipy.optimize import minimize
from scipy.special import expit


def fitted(features, right, weights, signs, ridge=1e-3):
    """Intercept and coefficients, of which none has the other sign than told (0: any).

    The ridge is on coefficients of standardised features."""
    mean = np.average(features, axis=0, weights=weights)
    spread = np.sqrt(np.average((features - mean) ** 2, axis=0, weights=weights)) + 1e-12
    standard = np.c_[np.ones(len(features)), (features - mean) / spread]
    weights = weights / weights.sum()
    side = np.where(right, 1., -1.)

    def loss(b):
        margins = side * (standard @ b)
        slope = -(weights * side * expit(-margins)) @ standard + 2 * ridge * np.r_[0, b[1:]]
        return weights @ np.logaddexp(0, -margins) + ridge * (b[1:] @ b[1:]), slope

    bounds = [(None, None)] + [(0, None) if s > 0 else (None, 0) if s < 0 else (None, None)
                               for s in signs]
    found = minimize(loss, np.zeros(standard.shape[1]), jac=True, bounds=bounds,
                     method="L-BFGS-B").x
    slopes = found[1:] / spread
    return found[0] - slopes @ mean, slopes


def area_under_roc(score, right, weights=None):
    """The probability that a right one scores higher than a wrong one."""
    weights = np.ones(len(score)) if weights is None else weights
    order = np.argsort(score, kind="stable")
    score, right, weights = score[order], right[order], weights[order]
    below = np.cumsum(np.where(right, 0, weights))
    first = np.searchsorted(score, score, "left")
    last = np.searchsorted(score, score, "right") - 1
    lower = np.where(first > 0, below[first - 1], 0)
    mean = (lower + below[last]) / 2
    return (weights * mean)[right].sum() / (weights[right].sum() * below[-1])


def never_falling(score, right, weights):
    """The isotonic regression of right on score: a function of scores."""
    order = np.argsort(score)
    blocks = []
    for at, value, weight in zip(score[order], right[order].astype(float), weights[order]):
        blocks.append([at, value, weight])
        while len(blocks) > 1 and blocks[-2][1] >= blocks[-1][1]:
            _, value, weight = blocks.pop()
            total = blocks[-1][2] + weight
            blocks[-1][1:] = [(blocks[-1][1] * blocks[-1][2] + value * weight) / total, total]
    starts, values, _ = np.array(blocks).T
    return lambda scores: values[np.maximum(np.searchsorted(starts, scores, "right") - 1, 0)]
