"""Traces as pandas and xarray hold tables. Neither is needed for anything else."""

import numpy as np

from .errors import BadInput

# What the elements of a row are called, by its width.
ELEMENTS = {1: [""], 2: ["i", "j"], 3: ["x", "y", "z"], 4: ["w", "x", "y", "z"],
            6: ["min_x", "min_y", "min_z", "max_x", "max_y", "max_z"]}


def _imported(name):
    try:
        return __import__(name)
    except ImportError:
        raise BadInput(f"{name} is not installed; install it, or take the arrays: trace['body/position'][:]") from None


def _group_columns(trace, group):
    """(name within the group, column), without those that count rows."""
    found = [(path.rpartition("/")[2], column) for path, column in trace.columns.items()
             if path.rpartition("/")[0] == group and column.layout != "offsets"]
    if found:
        return found
    known = sorted({path.rpartition("/")[0] for path in trace.columns} - {""})
    raise BadInput(f"{trace.path}: it has no group '{group}'; one of: {', '.join(known)}")


def _named(name, width):
    elements = ELEMENTS.get(width, [str(k) for k in range(width)])
    if width == 2:
        return elements
    return [f"{name}_{element}" if element else name for element in elements]


def _step_of_rows(trace, group, rows):
    """The step of each row, from the offsets of the group that has these rows."""
    for path, column in trace.columns.items():
        if path.rpartition("/")[0] == group and column.layout == "offsets":
            offsets = np.asarray(column).astype(np.int64)
            if offsets[-1] == rows:
                return np.repeat(trace.steps, np.diff(offsets))
    raise BadInput(f"{trace.path}: {group} has {rows} rows that no offsets count; record it again")


def data_frame(trace, group):
    pandas = _imported("pandas")
    columns = _group_columns(trace, group)
    of_bodies = [(name, c) for name, c in columns if c.layout == "bodies"]
    arrays, units, rows = {}, {}, 0
    for name, column in of_bodies or [(name, c) for name, c in columns if c.layout in ("rows", "windows")]:
        values = np.asarray(column).reshape(-1, column.width)
        if values.shape[0] == 0 and arrays:
            continue  # the vertex stage was off: confirmed pairs without distances
        rows = values.shape[0]
        for k, label in enumerate(_named(name, column.width)):
            arrays[label], units[label] = values[:, k], column.unit
    if of_bodies:
        steps, bodies = trace.steps, np.arange(trace.scene.body_count)
        index = pandas.MultiIndex.from_product([steps, bodies], names=["step", "body"])
    elif group == "statistics":
        index = None
    else:
        index = pandas.Index(_step_of_rows(trace, group, rows), name="step")
    frame = pandas.DataFrame(arrays, index=index)
    frame.attrs["units"] = units
    return frame


def dataset(trace):
    xarray = _imported("xarray")
    variables, coordinates = {}, {"step": trace.steps, "time_s": ("step", trace.times_s)}
    for path, column in trace.columns.items():
        group, _, name = path.rpartition("/")
        if column.layout in ("offsets", "windows") or path in ("step", "time"):
            continue
        values = np.asarray(column)
        row = f"{group}_row"
        if column.layout == "rows" and path.startswith("confirmed/") and name != "pairs":
            row = "proximity_row"
        dimensions = {"frames": ["step"], "bodies": ["step", "body"], "rows": [row]}[column.layout]
        if values.ndim > len(dimensions):
            dimensions = [*dimensions, f"element_{column.width}"]
        variables[path.replace("/", "_")] = (dimensions, values, {"unit": column.unit})
        if column.layout == "rows" and f"{row}_step" not in coordinates and values.shape[0]:
            coordinates[f"{row}_step"] = (row, _step_of_rows(trace, group, values.shape[0]))
    return xarray.Dataset(variables, coordinates, {"engine": trace.label, "scene": trace.scene.name})
