"""Arrays of the host that others hand in: NumPy's, and those of any library that speaks DLPack or NumPy's interface.

Nothing is copied where type, order and place fit. An array on a GPU is not fetched in silence: a copy through the host
is a cost that its owner should see, so it is an error that says how to make one. device.py has what a GPU engine takes.
"""

import numpy as np

from .device import is_on_gpu
from .errors import BadInput


def host_array(value, what):
    """A NumPy array over value's memory where it is on the host. `what` names it in errors."""
    if isinstance(value, np.ndarray):
        return value
    if is_on_gpu(value):
        raise BadInput(f"{what}: it is on a GPU, and the host's memory is read here; "
                       "copy it yourself, such as cupy.asnumpy(x) or x.cpu()")
    return np.from_dlpack(value) if hasattr(value, "__dlpack__") else np.asarray(value)


def fitted(value, dtype, what):
    """The same numbers as `dtype`, packed; `value` itself where it already is. Whole numbers must fit."""
    array, dtype = host_array(value, what), np.dtype(dtype)
    if array.dtype == dtype:
        return np.ascontiguousarray(array)
    if array.size == 0:
        return np.zeros(array.shape, dtype)
    if dtype.kind in "iu":
        if array.dtype.kind not in "iub":
            raise BadInput(f"{what}: it is of type {array.dtype}; give whole numbers, {dtype}")
        low, high = np.iinfo(dtype).min, np.iinfo(dtype).max
        if int(array.min()) < low or int(array.max()) > high:
            raise BadInput(f"{what}: it holds {array.min()} to {array.max()}; give numbers from {low} to {high}")
    elif array.dtype.kind not in "fiub":
        raise BadInput(f"{what}: it is of type {array.dtype}; give numbers, {dtype}")
    return np.ascontiguousarray(array, dtype)
