"""Correctly rounded functions, against literature, integers and extended precision."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.numeric import exact

angles = st.floats(-1e3, 1e3)
components = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-200)


def test_pi_is_what_machins_formula_gives_in_whole_numbers():
    one = 10**170

    def arctangent_of_inverse(k):
        total = term = one // k
        n = 3
        while term:
            term //= -k * k
            total += term // n
            n += 2
        return total

    pi = 4 * (4 * arctangent_of_inverse(5) - arctangent_of_inverse(239))
    assert str(exact.PI)[2:152] == str(pi)[1:151]


# Values of reference tables, more digits than a double has.
@pytest.mark.parametrize(
    ("function", "arguments", "value"),
    [
        (exact.sine, (1.0,), "0.84147098480789650665250232163029899962"),
        (exact.cosine, (1.0,), "0.54030230586813971740093660744297660373"),
        (exact.atan2, (1.0, 1.0), "0.78539816339744830961566084581987572104"),
        (exact.atan2, (1.0, -1.0), "2.35619449019234492884698253745962716314"),
        (exact.atan2, (0.0, -1.0), "3.14159265358979323846264338327950288419"),
        (exact.atan2, (-1.0, 0.0), "-1.5707963267948966192313216916397514420"),
        (exact.atan2, (1.0, 2.0), "0.46364760900080611621425623146121440202"),
        (exact.norm, (1.0, 1.0), "1.41421356237309504880168872420969807856"),
        (exact.norm, (3.0, 4.0, 12.0), "13"),
        (exact.norm, (1e-200, 0.0), "1e-200"),
        (exact.sine, (0.0,), "0"),
        (exact.atan2, (0.0, 0.0), "0"),
        # The distance of the double π/2 from the true one.
        (exact.cosine, (math.pi / 2,), "6.12323399573676588613032966137500529e-17"),
    ],
)
def test_tabulated_values_are_met_to_the_last_bit(function, arguments, value):
    assert function(*arguments) == float(value)


def near(found, libm):
    return abs(found - libm) <= math.ulp(libm)


@given(angles)
def test_sine_and_cosine_are_within_a_bit_of_the_mathematics_librarys(angle):
    assert near(exact.sine(angle), math.sin(angle))
    assert near(exact.cosine(angle), math.cos(angle))


@given(components, components)
def test_angle_and_length_are_within_a_bit_of_the_mathematics_librarys(x, y):
    assert near(exact.atan2(y, x), math.atan2(y, x)) or (x, y) == (0, 0) or y == 0
    assert near(exact.norm(x, y), math.hypot(x, y))


@pytest.mark.skipif(np.finfo(np.longdouble).nmant < 63, reason="no extended precision here")
@given(angles)
def test_the_nearest_double_is_taken_where_extended_precision_can_tell(angle):
    for found, long in (
        (exact.sine(angle), np.sin(np.longdouble(angle))),
        (exact.cosine(angle), np.cos(np.longdouble(angle))),
    ):
        assert abs(np.longdouble(found) - long) <= math.ulp(found) * 0.501
