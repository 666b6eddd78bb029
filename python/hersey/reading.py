"""Groups of a results file as xarray: short series at once, fields where they are used, the file never left open."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator, Optional

import numpy as np

from . import _core

# Datasets of more are read where they are used [bytes].
_AT_ONCE = 1 << 20

# What HDF5 itself says of scales.
_HIDDEN = {"DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME", "_Netcdf4Dimid"}


class SolversLock:
    """HDF5 serves one thread at a time: a run in another thread waits while this one reads."""

    def __enter__(self) -> None:
        _core.lock_hdf5()

    def __exit__(self, *_: Any) -> None:
        _core.unlock_hdf5()


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """A results file to read from. @raises OSError with the path and the reason where that cannot be done"""
    import h5py

    with SolversLock():
        try:
            file = h5py.File(path, "r")
        except OSError as error:
            raise _refusal(path, error) from None
        with file:
            if _text(file.attrs.get("format")) != "hersey-results":
                raise OSError(f"{path}: an HDF5 file that is no results file of hersey: expected results.h5 of a run")
            try:
                yield file
            except OSError as error:
                raise _refusal(path, error) from None


def _refusal(path: Path, error: OSError) -> OSError:
    """The error in words that name the file."""
    message = str(error)
    if str(path) in message and "errno" not in message:
        return error
    if not Path(path).exists():
        return FileNotFoundError(f"{path}: no such results file")
    if Path(path).is_dir():
        return IsADirectoryError(f"{path}: a folder: expected the results file in it, {Path(path) / 'results.h5'}")
    for sign, reason in (("signature not found", "no HDF5 file"), ("truncated file", "cut off: the file is shorter than it says"),
                         ("Permission denied", "it may not be read"), ("unable to lock", "another program writes it"),
                         ("checksum", "damaged"), ("read data", "damaged")):
        if sign in message:
            return OSError(f"{path}: {reason} ({message})")
    return OSError(f"{path}: {message}")


def _content(dataset: Any, rows: Any) -> np.ndarray:
    import h5py

    if h5py.check_string_dtype(dataset.dtype):
        return np.asarray(dataset.asstr()[rows], dtype=object)
    return dataset[rows]


def _lazy(path: Path, name: str, shape: tuple[int, ...], dtype: Any) -> Any:
    """The dataset as an array that xarray reads piece by piece."""
    from xarray.backends import BackendArray
    from xarray.core import indexing

    class Stored(BackendArray):
        def __init__(self) -> None:
            self.shape, self.dtype = shape, dtype

        def __getitem__(self, key: Any) -> np.ndarray:
            return indexing.explicit_indexing_adapter(key, shape, indexing.IndexingSupport.OUTER_1VECTOR, self._read)

        def _read(self, key: tuple[Any, ...]) -> np.ndarray:
            if shape and isinstance(key[0], slice):  # rows that a kill left behind these do not count
                key = (slice(*key[0].indices(shape[0])), *key[1:])
            with opened(path) as file:
                return file[name][key]

    return indexing.LazilyIndexedArray(Stored())


def _dimensions(dataset: Any, scales: dict[Any, str], file: Any) -> tuple[str, ...]:
    """Names of a dataset's dimensions: of a scale its own, of others those of their scales in the group."""
    if "DIMENSION_LIST" not in dataset.attrs:
        own = dataset.name.rpartition("/")[2]
        return (own,) if dataset.ndim == 1 else tuple(f"{own}_{axis}" for axis in range(dataset.ndim))
    names = []
    for references in dataset.attrs["DIMENSION_LIST"]:
        scale = file[references[0]]
        names.append(scales.get(scale.id) or scale.name.rpartition("/")[2])
    return tuple(names)


def _grows(dataset: Any) -> bool:
    return bool(dataset.ndim) and dataset.maxshape[0] is None


def _grows_with(path: str) -> str:
    """What all series that get their rows together have in common: the group of a film's fields, else the file."""
    return f"/{path}".rpartition("/fields/")[0]


def complete_rows(file: Any, group: str) -> Optional[int]:
    """Rows that all series which grow with those of the group have: a kill in the middle of a flush leaves some a few
    rows longer. None, for all of them, where the file was ended in order."""
    import h5py

    if _text(file.attrs.get("status")) != "running":
        return None
    rows: list[int] = []

    def visit(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and _grows(item) and _grows_with(name) == _grows_with(f"{group}/"):
            rows.append(item.shape[0])

    file.visititems(visit)
    return min(rows, default=0)


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def read_group(path: Path, group: str):
    """The group as `xarray.Dataset`. @raises KeyError where there is none."""
    import h5py
    import xarray

    coordinates: dict[str, Any] = {}
    data: dict[str, Any] = {}
    with opened(path) as file:
        if group not in file or not isinstance(file[group], h5py.Group):
            raise KeyError(group)
        place = file[group]
        found = {name: item for name, item in place.items() if isinstance(item, h5py.Dataset)}
        scales = {item.id: name for name, item in found.items() if h5py.h5ds.is_scale(item.id)}
        rows = complete_rows(file, group)
        for name, item in found.items():
            attributes = {key: _text(value) for key, value in item.attrs.items() if key not in _HIDDEN}
            is_text = h5py.check_string_dtype(item.dtype) is not None
            is_cut = rows is not None and _grows(item)
            shape, part = ((rows, *item.shape[1:]), slice(rows)) if is_cut else (item.shape, ())
            values = (_content(item, part) if is_text or item.nbytes <= _AT_ONCE
                      else _lazy(path, item.name, shape, item.dtype))
            dimensions = _dimensions(item, scales, file) if item.ndim else ()
            target = coordinates if dimensions == (name,) else data
            target[name] = xarray.Variable(dimensions, values, attributes)
        attributes = {key: _text(value) for key, value in place.attrs.items() if key not in _HIDDEN}
    return xarray.Dataset(data, coordinates, attributes)
