"""Run by pvpython: goes through all time steps of a file and prints facts of each as JSON on the last line."""

import json
import sys

from paraview.simple import OpenDataFile

reader = OpenDataFile(sys.argv[1])
seen = []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    data = reader.GetDataInformation()
    cells = reader.CellData
    seen.append({
        "time": time,
        "cells": data.GetNumberOfCells(),
        "points": data.GetNumberOfPoints(),
        "bounds": data.GetBounds(),
        "body": list(cells["body"].GetRange()) if "body" in cells.keys() else None,
        "velocity_y": list(cells["velocity"].GetRange(1)) if "velocity" in cells.keys() else None,
    })
print(json.dumps(seen))
