"""Figures of a series that swings: period, amplitude, what it loses in a period."""

import math


def middle(values):
    """Half way between the largest and the smallest value: the mean of Turek & Hron (2006)."""
    return (max(values) + min(values)) / 2


def amplitude(values):
    """Half the distance between the largest and the smallest value: the amplitude of Turek & Hron (2006)."""
    return (max(values) - min(values)) / 2


def crossings(times, values, level):
    """Times at which the series rises through `level`, linear between its rows. One counts only after the series was a
    quarter of its amplitude below: noise about the level does not."""
    depth = level - 0.25 * amplitude(values)
    found, armed = [], False
    for k in range(1, len(values)):
        armed = armed or values[k - 1] < depth
        if armed and values[k - 1] < level <= values[k]:
            share = (level - values[k - 1]) / (values[k] - values[k - 1])
            found.append(times[k - 1] + share * (times[k] - times[k - 1]))
            armed = False
    return found


def period(times, values, level=None):
    """Mean time between rises through `level` (default: the middle) or between falls, of which there are more; nan with
    fewer than two of either."""
    level = middle(values) if level is None else level
    rises = crossings(times, values, level)
    falls = crossings(times, [-v for v in values], -level)
    best = max(rises, falls, key=len)
    return (best[-1] - best[0]) / (len(best) - 1) if len(best) > 1 else math.nan


def swings(times, values, level):
    """(time, height above or depth below `level`) of the extreme of each half swing between two crossings; that of the
    parabola through the three rows about it."""
    mirrored = [-v for v in values]
    rises, falls = crossings(times, values, level), crossings(times, mirrored, -level)
    ends = sorted([(t, values, level) for t in rises] + [(t, mirrored, -level) for t in falls], key=lambda end: end[0])
    found = []
    for (begin, seen, at), (end, _, _) in zip(ends, ends[1:]):
        top = max((k for k, t in enumerate(times) if begin <= t <= end), key=seen.__getitem__)
        found.append((times[top], _height(seen, top) - at))
    return found


def _height(values, k):
    if k in (0, len(values) - 1):
        return values[k]
    a, b, c = values[k - 1:k + 2]
    bend = a - 2 * b + c
    return b - (c - a) ** 2 / (8 * bend) if bend < 0 else b


def amplitude_loss(times, values, level=None):
    """Share of the amplitude that is lost in a period: the straight line through the logarithm of the extremes over
    time, least squares; below 0 where it grows, nan with fewer than two half swings."""
    level = middle(values) if level is None else level
    tops = [(t, math.log(h)) for t, h in swings(times, values, level) if h > 0]
    length = period(times, values, level)
    if len(tops) < 2 or not math.isfinite(length):
        return math.nan
    return 1 - math.exp(slope(tops) * length)


def slope(points):
    """Of the straight line through (x, y) by least squares; nan if all x are the same."""
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    square = sum((x - mean_x) ** 2 for x, _ in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / square if square > 0 else math.nan
