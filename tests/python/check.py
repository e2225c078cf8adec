"""Opens a plane's archive and store as their users do, and holds both against the table of fields.

Arguments: plane.npz, plane.zarr, and a JSON file with what is expected. Any warning is an error.
"""

import json
import sys
import warnings

warnings.simplefilter("error")

import numpy
import xarray
import zarr

npz_path, zarr_path, expected_path = sys.argv[1:]
expected = json.load(open(expected_path))
kinds = {"u8": "uint8", "u16": "uint16", "u32": "uint32", "f32": "float32", "f64": "float64"}

archive = numpy.load(npz_path, allow_pickle=False)
store = xarray.open_zarr(zarr_path)
group = zarr.open_group(zarr_path, mode="r")

rows, columns = expected["rows"], expected["columns"]
assert set(archive.files) == {field["name"] for field in expected["fields"]} | {"x", "y", "config"}, archive.files
assert set(store.data_vars) == {field["name"] for field in expected["fields"]}, set(store.data_vars)
assert dict(store.sizes)["y"] == rows and dict(store.sizes)["x"] == columns, store.sizes

for field in expected["fields"]:
    name = field["name"]
    ours, theirs = archive[name], store[name]
    assert list(theirs.dims) == ["y", "x"] + field["dimensions"], (name, theirs.dims)
    assert ours.shape == theirs.shape == (rows, columns, *field["sizes"]), (name, ours.shape, theirs.shape)
    assert str(ours.dtype) == str(theirs.dtype) == kinds[field["kind"]], (name, ours.dtype, theirs.dtype)
    assert numpy.array_equal(ours, theirs.values, equal_nan=field["kind"].startswith("f")), name
    assert theirs.attrs["description"] == field["meaning"], name
    assert theirs.attrs["long_name"] == field["title"], name
    assert theirs.attrs.get("units", "") == field["unit"], name
    if field["names"] is not None:
        assert list(theirs.attrs["names"]) == field["names"], name
    # One shard for every tile.
    side = expected["tile"]
    assert group[name].shards == (side, side, *field["sizes"]), (name, group[name].shards)

regime = store["regime"]
assert list(regime.attrs["flag_values"]) == [0, 1, 2, 3, 4, 5, 6, 7, 8, 255]
assert len(regime.attrs["flag_meanings"].split()) == 10
assert set(numpy.unique(regime.values)) <= set(range(8))

for axis in ["x", "y"]:
    assert numpy.array_equal(archive[axis], store[axis].values)
    assert numpy.array_equal(store[axis].values, numpy.array(expected[axis]["values"])), axis
    assert store[axis].attrs["quantity"] == expected[axis]["quantity"]
assert store.sel(x=expected["x"]["values"][1], method="nearest")["regime"].shape == (rows,)

config = json.loads(str(archive["config"]))
assert json.loads(store.attrs["config"]) == config
for name in ["version", "backend", "adapter"]:
    assert store.attrs[name] == config[name] == expected[name], name
assert store.attrs["parameters"] == config["parameters"]
assert store.attrs["tile"] == expected["tile"]
print("both files hold", len(expected["fields"]), "fields of", rows * columns, "cells")
