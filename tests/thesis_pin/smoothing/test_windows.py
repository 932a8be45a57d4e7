"""Sliding windows against SciPy's."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.ndimage import maximum_filter1d, median_filter

from thesis_pin.smoothing.windows import greatest, medians


@pytest.mark.parametrize("count", [1, 3, 8, 30, 20_000])
@pytest.mark.parametrize("width", [1, 8, 17, 25])
def test_windows_are_scipys(count: int, width: int) -> None:
    values = np.random.default_rng(count).standard_normal(count)
    np.testing.assert_array_equal(greatest(values, width), maximum_filter1d(values, width))
    if width % 2:
        some = np.flatnonzero(values > 0.3)
        expected = median_filter(values, width, mode="reflect")[some]
        np.testing.assert_array_equal(medians(values, width, some), expected)


def test_smoothing_needs_little_of_scipy() -> None:
    code = (
        "import sys, numpy as np\n"
        "from thesis_pin.smoothing.corners import in_pieces\n"
        "from thesis_pin.smoothing.curve import generator\n"
        "from thesis_pin.smoothing.outliers import outliers\n"
        "t = np.linspace(0.0, 3.0, 400); y = np.round(np.sin(t) + abs(t - 1), 3)\n"
        "assert not outliers(y, 1e-3); assert in_pieces(t, y, 1e-3, generator(1))[1]\n"
        "print([m for m in ('interpolate', 'ndimage') if f'scipy.{m}' in sys.modules])"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "[]\n"
