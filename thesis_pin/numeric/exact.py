"""Correctly rounded functions of doubles, for numbers that are written into files.

The mathematics library and NumPy choose their code by the processor and differ in
the last bit between two of them; a generated file would then differ too. Here the
result is the double next to the true value, whatever the machine. Slow (about
0.1 ms), so only for generating.
"""

from __future__ import annotations

from decimal import Context, Decimal, localcontext

# Doubles hardest to round need about 40 digits; large angles lose some more.
_DIGITS = Context(prec=120)

PI = Decimal(
    "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899"
    "862803482534211706798214808651328230664709384460955058223172535940812848111745"
)


def cosine(angle: float) -> float:
    """Cosine of an angle [rad] below 1e12."""
    with localcontext(_DIGITS):
        return float(_sine_cosine(angle)[1])


def sine(angle: float) -> float:
    """Sine of an angle [rad] below 1e12."""
    with localcontext(_DIGITS):
        return float(_sine_cosine(angle)[0])


def atan2(y: float, x: float) -> float:
    """Angle of a vector (x, y) in (−π, π] [rad]; 0 of the zero vector."""
    with localcontext(_DIGITS):
        a, b = Decimal(float(y)), Decimal(float(x))
        if not a:
            return float(PI) if b < 0 else 0.0
        if abs(a) > abs(b):
            quarter = PI / 2 if a > 0 else -PI / 2
            return float(quarter - _arctangent(b / a))
        turned = _arctangent(a / b)
        return float(turned if b > 0 else turned + (PI if a > 0 else -PI))


def norm(*components: float) -> float:
    """Length of a vector."""
    with localcontext(_DIGITS):
        return float(sum((Decimal(float(x)) ** 2 for x in components), Decimal(0)).sqrt())


def _sine_cosine(angle: float) -> tuple[Decimal, Decimal]:
    value = Decimal(float(angle))
    quarters = int((value / (PI / 2)).to_integral_value())
    x = value - quarters * (PI / 2)
    sine_x, cosine_x = _series(x, x, 2), _series(Decimal(1), x, 1)
    for _ in range(quarters % 4):
        sine_x, cosine_x = cosine_x, -sine_x
    return sine_x, cosine_x


def _series(first: Decimal, x: Decimal, n: int) -> Decimal:
    """Taylor's series of the sine (from x, n = 2) or the cosine (from 1, n = 1)."""
    total = term = first
    while term and abs(term) > abs(total).scaleb(-110):
        term = -term * x * x / (n * (n + 1))
        total += term
        n += 2
    return total


def _arctangent(t: Decimal) -> Decimal:
    """Arctangent for |t| ≤ 1: halved four times, then its series."""
    for _ in range(4):
        t = t / (1 + (1 + t * t).sqrt())
    total = power = t
    n = 3
    while power and abs(power) > abs(total).scaleb(-110):
        power = -power * t * t
        total += power / n
        n += 2
    return 16 * total
