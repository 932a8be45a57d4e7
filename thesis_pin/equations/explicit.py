"""What every thesis's explicit model has: D, V and C from its own printed equations."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar, get_args

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.equations.catalogue import Catalogue, Edition
from thesis_pin.equations.editions import EditionEnvironment
from thesis_pin.equations.evaluation import Movable
from thesis_pin.errors import UnknownName, WrongShape
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.numeric.arrays import finite_array

References = TypeVar("References", bound=Movable)


class ExplicitTerms(Generic[References]):
    """D q̈ + V q̇ + C for one state or a batch, in one edition.

    A thesis's model says what its symbols are at states (:meth:`references`) and how
    its D, V and C are called (:meth:`_term`).

    Args:
        catalogue: The equations.
        edition: "corrected" or "printed".
        inertia: Reading of the printed inertias.

    Attributes:
        edition: As given.
        substituted: After an evaluation: ids of lines that can't be followed as the
            edition asks, with the reason.
        columns: Number of coordinates, n below.
        coordinates: What the coordinates are called in messages.
        chunk: States evaluated at once: their ∂N/∂q_j stay below a few hundred MB.
    """

    columns: int
    coordinates = "q"
    chunk: int

    def __init__(self, catalogue: Catalogue, edition: Edition, inertia: Reading) -> None:
        for name, value, kind in (("edition", edition, Edition), ("inertia", inertia, Reading)):
            if value not in get_args(kind):
                raise UnknownName(name, value, get_args(kind))
        self.catalogue, self.edition = catalogue, edition
        self.substituted: dict[str, str] = {}

    def references(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> References:
        """What each symbol must equal at states, each argument ``(N, n)``."""
        raise NotImplementedError

    def environment(self, references: References) -> EditionEnvironment:
        """The thesis's symbols at some states, in this edition."""
        return EditionEnvironment(
            self.catalogue, references, self.edition, substituted=self.substituted
        )

    def _term(self, environment: EditionEnvironment, letter: str) -> np.ndarray:
        """D or V, shape ``(N or 1, n, n)``, or C, ``(N or 1, n)``."""
        raise NotImplementedError

    def _check(self, q: np.ndarray) -> None:
        """Refuse coordinates ``(N, n)`` at which the model has no value."""

    def D(self, q: ArrayLike) -> np.ndarray:
        """Mass matrix, shape ``(..., n, n)``.

        Source: Scout thesis, 4.7, (4.8), 4.2; Pollard thesis, (3.153), (3.68) … (3.134).
        """
        return self._terms("D", q)[0]

    def V(self, q: ArrayLike, v: ArrayLike) -> np.ndarray:
        """V(q, q̇) = Ṅ − ½ [q̇ᵀ ∂N/∂q_j]_j, shape ``(..., n, n)``; only V q̇ compares.

        Source: Scout thesis, 4.7, (4.8), (4.10); Pollard thesis, (3.153), (3.68) … (3.140).
        """
        return self._terms("V", q, v)[0]

    def C(self, q: ArrayLike) -> np.ndarray:
        """Gravity term [N], [N·m], shape ``(..., n)``.

        Source: Scout thesis, 4.7, (4.10); Pollard thesis, (3.153), (3.78) … (3.140).
        """
        return self._terms("C", q)[0]

    def terms(self, q: ArrayLike, v: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """D, V and C at once: what they share is worked out once."""
        mass, velocity, gravity = self._terms("DVC", q, v)
        return mass, velocity, gravity

    def generalized_force(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> np.ndarray:
        """D q̈ + V q̇ + C [N], [N·m], shape ``(..., n)``.

        Source: Scout thesis, (4.23); Pollard thesis, (3.153).
        """
        v, a = (finite_array(name, x, self.columns) for name, x in (("v", v), ("a", a)))
        mass, velocity, gravity = self.terms(q, v)
        return np.asarray((mass @ a[..., None] + velocity @ v[..., None])[..., 0] + gravity)

    def _terms(self, letters: str, q: ArrayLike, v: ArrayLike | None = None) -> list[np.ndarray]:
        """Some of D, V and C."""
        n = self.columns

        def columns(references: References) -> np.ndarray:
            environment = self.environment(references)
            found = [self._term(environment, letter) for letter in letters]
            count = max(map(len, found))
            parts = [x[..., None] if x.ndim == 2 else x for x in found]
            return np.concatenate([np.broadcast_to(x, (count, *x.shape[1:])) for x in parts], -1)

        stacked = self._batch(columns, q, v)
        return [
            stacked[..., n * k] if letter == "C" else stacked[..., n * k : n * (k + 1)]
            for k, letter in enumerate(letters)  # C is the last of them
        ]

    def _batch(
        self,
        of: Callable[[References], np.ndarray],
        q: ArrayLike,
        v: ArrayLike | None = None,
        a: ArrayLike | None = None,
    ) -> np.ndarray:
        """A function of references at any batch of states, chunk by chunk."""
        q = finite_array(self.coordinates, q, self.columns)
        flat = [q.reshape(-1, self.columns)]
        for name, value in (("v", v), ("a", a)):
            array = np.zeros(q.shape) if value is None else finite_array(name, value, self.columns)
            if array.shape != q.shape:
                raise WrongShape(name, array.shape, f"that of {self.coordinates}, {q.shape}")
            flat.append(array.reshape(-1, self.columns))
        self._check(flat[0])
        parts = []
        for start in range(0, max(len(flat[0]), 1), self.chunk):
            chosen = [x[start : start + self.chunk] for x in flat]
            found = of(self.references(chosen[0], chosen[1], chosen[2]))
            parts.append(np.broadcast_to(found, (len(chosen[0]), *found.shape[1:])))
        result = np.concatenate(parts)
        return result.reshape(*q.shape[:-1], *result.shape[1:])
