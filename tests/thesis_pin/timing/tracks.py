"""Tracks whose fastest laws are known by hand, or can be found another way."""

from dataclasses import dataclass, field

import numpy as np

from thesis_pin.timing.track import Values


def none(*shape):
    return np.zeros(shape)


@dataclass(frozen=True)
class Point:
    """A point without motors on a curve: position, first and second derivative over s."""

    curve: object
    length: float
    ends: np.ndarray = field(init=False)
    stops: np.ndarray = field(init=False)

    def __post_init__(self):
        object.__setattr__(self, "ends", np.array([0.0, self.length]))
        object.__setattr__(self, "stops", np.array([True, True]))

    def values(self, piece, at):
        _, first, second = self.curve(at)
        n = len(at)
        return Values(none(n, 3, 0), none(n, 0), none(n, 0), none(n, 3, 0, 3), first, second)


def straight(at):
    """Along x."""
    first = np.zeros((len(at), 3))
    first[:, 0] = 1.0
    return at[:, None] * first, first, np.zeros((len(at), 3))


@dataclass(frozen=True)
class Wheel:
    """One motor that turns an inertia by s, against a constant load."""

    inertia: float
    length: float
    load: float = 0.0
    ends: np.ndarray = field(init=False)
    stops: np.ndarray = field(init=False)

    def __post_init__(self):
        object.__setattr__(self, "ends", np.array([0.0, self.length]))
        object.__setattr__(self, "stops", np.array([True, True]))

    def values(self, piece, at):
        n = len(at)
        effort = np.zeros((n, 3, 1))
        effort[:, 0], effort[:, 2] = self.inertia, self.load
        return Values(effort, np.ones((n, 1)), none(n, 1), none(n, 3, 0, 3), none(n, 3), none(n, 3))


@dataclass(frozen=True)
class Arm:
    """Two masses on two axes with gravity, along a wavy joint path: q = (s, wave sin(k s))."""

    wave: float
    k: float
    length: float
    mass: tuple = (1.3, 0.7)
    ends: np.ndarray = field(init=False)
    stops: np.ndarray = field(init=False)

    def __post_init__(self):
        object.__setattr__(self, "ends", np.array([0.0, self.length]))
        object.__setattr__(self, "stops", np.array([True, True]))

    def values(self, piece, at):
        n, mass = len(at), np.array(self.mass)
        first = np.stack([np.ones(n), self.wave * self.k * np.cos(self.k * at)], axis=1)
        second = np.stack([np.zeros(n), -self.wave * self.k**2 * np.sin(self.k * at)], axis=1)
        gravity = np.stack([0.3 * np.cos(at), np.full(n, 0.2)], axis=1)
        effort = np.stack([mass * first, mass * second, gravity], axis=1)
        return Values(effort, first, second, none(n, 3, 0, 3), none(n, 3), none(n, 3))
