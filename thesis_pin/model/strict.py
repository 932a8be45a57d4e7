"""What is read from files, as immutable objects; pydantic checks them when there is need.

Importing pydantic and building its validators takes as long as importing Pinocchio. Numbers that
ship with the package were checked when they were generated (:mod:`thesis_pin.model.shipped`) and
are only put in place, so a class here is a plain one until something is read into it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    ClassVar,
    Literal,
    NoReturn,
    Self,
    TypeAlias,
    dataclass_transform,
    get_type_hints,
)

from thesis_pin.display.brief import ROOM, Brief
from thesis_pin.model.limits import LIMITS, Key

if TYPE_CHECKING:
    from pydantic import BaseModel, GetCoreSchemaHandler
    from pydantic.fields import FieldInfo


Schema: TypeAlias = dict[str, object]
"""How pydantic checks a value."""


class Held:
    """Bounds of a value in pydantic's words: ``gt``, ``ge``, ``min_length``, ``pattern``, …"""

    def __init__(self, **bounds: object) -> None:
        self.bounds = bounds

    def __get_pydantic_core_schema__(
        self, source: object, handler: Callable[[object], Schema]
    ) -> Schema:
        return handler(source) | self.bounds


class After:
    """A check of a value that has its type; it returns the value or raises a ValueError."""

    def __init__(self, check: Callable[..., object]) -> None:
        self.check = check

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> object:
        from pydantic import AfterValidator

        return AfterValidator(self.check).__get_pydantic_core_schema__(source, handler)


class _Fields:
    """``model_fields`` of a class, as pydantic knows them."""

    def __get__(self, instance: object, owner: type[Strict]) -> dict[str, FieldInfo]:
        return _schema(owner).model_fields


@dataclass_transform(kw_only_default=True, frozen_default=True)
class Strict(Brief):
    """Base of everything read from a file: no unknown keys, no NaN, immutable.

    Annotations of a class are its fields, in pydantic's terms; objects have pydantic's methods
    that their users need.

    Raises:
        ValidationError: Pydantic's, when made of values that aren't allowed.
    """

    model_fields: ClassVar[_Fields] = _Fields()
    _names: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls) -> None:
        cls._names = tuple(dict.fromkeys([*cls._names, *cls.__annotations__]))

    def __init__(self, **values: object) -> None:
        if values or not all(hasattr(type(self), name) for name in self._names):
            values = vars(_schema(type(self))(**values))
        _fill(self, values)

    @classmethod
    def made(cls, **values: object) -> Self:
        """An object of values that were checked before."""
        new = object.__new__(cls)
        _fill(new, values)
        return new

    @classmethod
    def field_names(cls) -> tuple[str, ...]:
        """Names of its fields, its bases' first."""
        return cls._names

    @classmethod
    def model_validate(cls, data: object, *, strict: bool | None = None) -> Self:
        """The object that data stand for, checked.

        Args:
            data: Nested mappings, or an object of this class.
            strict: Whether numbers and texts must be of the very type.
        """
        if isinstance(data, cls):
            return data
        return cls.made(**vars(_schema(cls).model_validate(data, strict=strict)))

    def model_dump(self, *, mode: Literal["python", "json"] = "python") -> dict[str, object]:
        """Its values as nested mappings; with lists for tuples in mode ``"json"``."""
        return {name: _plain(value, mode == "json") for name, value in self}

    def model_copy(self, *, update: Mapping[str, object] | None = None) -> Self:
        """The same with other values, which aren't checked."""
        return type(self).made(**dict(self) | dict(update or {}))

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Yield key, complaint and value of what is wrong between several keys."""
        yield from ()

    def __iter__(self) -> Iterator[tuple[str, object]]:
        values = vars(self)
        return ((name, values[name]) for name in self._names)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and dict(self) == dict(other)

    def __hash__(self) -> int:
        return hash((type(self), *(value for _, value in self)))

    def __repr__(self) -> str:
        whole = f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self)})"
        return whole if len(whole) <= ROOM else super().__repr__()

    def _shown(self) -> Iterator[tuple[str, object]]:
        return iter(self)

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is immutable; model_copy() makes another")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is immutable; model_copy() makes another")

    @classmethod
    def __get_pydantic_core_schema__(cls, source: object, handler: GetCoreSchemaHandler) -> object:
        """How pydantic checks an object of this class inside of another."""
        from pydantic import WrapValidator

        def validated(value: object, inner: Callable[[object], BaseModel]) -> Strict:
            return value if isinstance(value, cls) else cls.made(**vars(inner(value)))

        return WrapValidator(validated).__get_pydantic_core_schema__(_schema(cls), handler)


class Assumption(Strict):
    """A number the thesis leaves open; reports list it with its reason."""

    why: Annotated[str, Held(min_length=1)]


def _symmetric(matrix: tuple[tuple[float, ...], ...]) -> tuple[tuple[float, ...], ...]:
    if any(matrix[i][j] != matrix[j][i] for i in range(3) for j in range(i)):
        raise ValueError("must be symmetric")
    return matrix


def _not_tiny(value: float) -> float:
    if value < LIMITS.smallest:
        raise ValueError(f"must be at least {LIMITS.smallest:g}")
    return value


Positive = Annotated[float, Held(gt=0), After(_not_tiny)]
NotNegative = Annotated[float, Held(ge=0)]
Vector2 = tuple[float, float]
Vector3 = tuple[float, float, float]
SymmetricMatrix = Annotated[tuple[Vector3, Vector3, Vector3], After(_symmetric)]


_SCHEMAS: dict[type[Strict], type[BaseModel]] = {}


def _schema(cls: type[Strict]) -> type[BaseModel]:
    """The pydantic model with the fields of a class."""
    if (known := _SCHEMAS.get(cls)) is not None:
        return known
    from pydantic import ConfigDict, create_model

    hints = get_type_hints(cls, include_extras=True)
    fields: dict[str, Any] = {name: (hints[name], getattr(cls, name, ...)) for name in cls._names}
    config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
    made = create_model(cls.__name__, __config__=config, __module__=cls.__module__, **fields)
    return _SCHEMAS.setdefault(cls, made)


def _fill(new: Strict, values: Mapping[str, object]) -> None:
    """Put values in place, in the order of the fields; defaults stand in the class."""
    cls = type(new)
    for name in cls._names:
        vars(new)[name] = values[name] if name in values else getattr(cls, name)


def _plain(value: Any, lists: bool) -> Any:
    if isinstance(value, Strict):
        return {name: _plain(one, lists) for name, one in value}
    if isinstance(value, dict):
        return {key: _plain(one, lists) for key, one in value.items()}
    if isinstance(value, tuple | list):
        found = [_plain(one, lists) for one in value]
        return found if lists or isinstance(value, list) else tuple(found)
    return value
