"""Tables of results (history.csv, meridians.csv, study.csv, ...) as columns."""

import csv
import io
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .errors import FileError

_units = {"s": "s", "mm": "mm", "mm2": "mm²", "N": "N", "MPa": "MPa", "mJ": "mJ", "deg": "deg", "t": "t"}


def unit_of(name):
    """The unit in a column's or array's name, after its last "_": "top.force_N" is in N. "" where it names none: a
    number without unit, or text."""
    return _units.get(name.rpartition("_")[2], "") if "_" in name else ""


def words_of(name):
    """A column's or array's name in words with its unit, for an axis: "top.force_N" is "top force (N)"."""
    unit = unit_of(name)
    words = name.rpartition("_")[0] if unit else name
    return words.replace("_", " ").replace(".", " ") + (f" ({unit})" if unit else "")


def _column(name, cells):
    """Numbers, nan where a cell is empty; text when a cell is neither, and of a study's digests (12e4... is none)."""
    try:
        if name == "case":
            return np.array(cells)
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


class Table(Mapping):
    """Columns by name, in the file's order: table["top.force_N"] is a NumPy array. A mapping, so that
    pandas.DataFrame(dict(table)) and the like take it as it is."""

    def __init__(self, path):
        """Lines that begin with # are skipped, and so is a last one without its end, which is being written. Raises
        FileError when the file cannot be read or is no table."""
        self.path = Path(path)
        try:
            text = self.path.read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"{path}: cannot be read ({error}); check the folder, or run again") from error
        reader = csv.reader(io.StringIO(text[: text.rfind("\n") + 1], newline=""))
        rows = [(reader.line_num, row) for row in reader if row and not row[0].startswith("#")]
        if not rows:
            raise FileError(f"{path}: has no heading; it was just begun, or is damaged: wait, or run again")
        self.columns = rows[0][1]
        for number, row in rows[1:]:
            if len(row) != len(self.columns):
                raise FileError(f"{path}:{number}: has {len(row)} cells, not {len(self.columns)}; run again")
        self._values = {name: _column(name, [row[k] for _, row in rows[1:]]) for k, name in enumerate(self.columns)}
        self.rows = len(rows) - 1

    @classmethod
    def of(cls, name, columns, values):
        """A table that lies in no file: `values` is (rows, columns); `name` stands for the file in messages."""
        table = cls.__new__(cls)
        table.path, table.columns, table.rows = Path(name), list(columns), len(values)
        table._values = {column: np.array(values[:, k]) for k, column in enumerate(table.columns)}
        return table

    def __getitem__(self, name):
        if name not in self._values:
            raise KeyError(f"{self.path.name} has no column '{name}'; it has {', '.join(self.columns)}")
        return self._values[name]

    def __iter__(self):
        return iter(self.columns)

    def __len__(self):
        return len(self.columns)

    @property
    def units(self):
        """Unit of each column, "" where it has none."""
        return {name: unit_of(name) for name in self.columns}

    def chart(self, x, y, file, **options):
        """Draws column(s) y over column x into a PNG or, with matplotlib, SVG or PDF file (see picture.chart)."""
        from .picture import chart

        return chart(self, x, y, file, **options)

    def __repr__(self):
        return f"<Table {self.path.name}: {self.rows} rows of {', '.join(self.columns)}>"
