"""Prints the content of a trace with h5py and pandas: python3 reading_a_trace.py octree-cpu.h5"""
import sys
import h5py
import pandas as pd

trace = h5py.File(sys.argv[1])
print(dict(trace["/provenance"].attrs)["engine"].decode(), "on", trace["/scene"].attrs["name"].decode())
contact = trace["/trace/contact"]
offsets = contact["offsets"][:]
frames = pd.DataFrame({"step": trace["/trace/step"], "contacts": offsets[1:] - offsets[:-1]})
depth = pd.Series(contact["depth"][:]).groupby(frames.index.repeat(frames.contacts)).max()
frames["deepest_m"] = depth.reindex(frames.index)
print(frames.tail().to_string(index=False))
