"""Files that hold surfaces and solutions: what each holds, and which hold what is wanted.

What a file holds is in its name, and nothing else is: ``seeds1-8_p0.01_0.065.nc`` holds seeds 1 to
8, each at both loads. Jobs read from it what they have to make, and a run finds what is solved
without opening a file, whichever case it was solved for. Of what is wanted, files on disk keep what
they hold, and new files hold the rest.
"""

import os
from collections import defaultdict
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import product

SEEDS_A_FILE = 8  #: fine seeds: few enough to spread over cores, enough to outweigh a start
COARSE_SEEDS_A_FILE = 64
LONGEST = 200  #: characters for loads; file systems allow 255 a name, temporary endings included
NO_LOAD = (None,)  #: loads of what has none, such as a surface

Load = float | None


@dataclass(frozen=True)
class Part:
    """What one file holds: consecutive seeds, every one of them at the same loads."""

    first: int
    last: int
    loads: tuple[Load, ...] = NO_LOAD

    @classmethod
    def of(cls, text: str) -> "Part":
        """Read a part from its text; a ValueError says that it is none."""
        seeds, _, loads = text.partition("_p")
        first, last = map(int, seeds.split("-"))
        part = cls(first, last, tuple(map(float, loads.split("_"))) if loads else NO_LOAD)
        if str(part) != text:
            raise ValueError(f"{text!r} does not name seeds and loads")
        return part

    # Snakemake hands values of wildcards on as text: no comma, colon or equals sign in it.
    def __str__(self) -> str:
        seeds = f"{self.first}-{self.last}"
        return seeds if self.loads == NO_LOAD else f"{seeds}_p{join_loads(self.loads)}"

    @property
    def seeds(self) -> list[int]:
        """Seeds, counted from 1."""
        return list(range(self.first, self.last + 1))

    @property
    def size(self) -> int:
        """Surfaces or solutions that it holds."""
        return len(self.seeds) * len(self.loads)


#: Text of a part, for the constraint of a wildcard.
PATTERN = r"\d+-\d+(_p[\d.e+_-]+)?"


class Store:
    """The files of one kind in one folder that hold what is wanted, whether they exist or not.

    Parameters
    ----------
    folder
        Folder of the files, as rules name it.
    names
        Names of the files that it holds (see `list_names`); names of other kinds do not matter.
    kind
        Word that the names of the files begin with.
    wanted
        Blocks of seeds and loads; each load of a block is wanted of each of its seeds.
    seeds_a_file
        Largest number of seeds in a new file.
    """

    def __init__(
        self,
        folder: str,
        names: Iterable[str],
        kind: str,
        wanted: Iterable[tuple[Iterable[int], Iterable[Load]]],
        seeds_a_file: int = SEEDS_A_FILE,
    ):
        self.folder = folder
        self.kind = kind
        self.wanted: dict[int, set[Load]] = defaultdict(set)
        for seeds, loads in wanted:
            for seed in seeds:
                self.wanted[seed].update(loads)

        # Where files overlap, the larger one counts, whatever else there is. So a job that runs
        # while others make or replace their files finds those that the run has planned for it.
        held = sorted(find_parts(names, kind), key=lambda part: (-part.size, str(part)))
        self.held_by: dict[tuple[int, Load], Part] = {}
        for part in held:
            for pair in product(part.seeds, part.loads):
                self.held_by.setdefault(pair, part)
        missing = {
            seed: {load for load in loads if (seed, load) not in self.held_by}
            for seed, loads in self.wanted.items()
        }
        loads = sorted(set().union(*self.wanted.values()), key=lambda load: load or 0)
        for part in divide(missing, chunk_loads(loads), seeds_a_file):
            self.held_by.update(dict.fromkeys(product(part.seeds, part.loads), part))

    def find_parts(self, seeds: Iterable[int], loads: Iterable[Load] = NO_LOAD) -> list[Part]:
        """Return what the files hold that have each of some seeds at each of some loads.

        A LookupError names a pair that nothing asks for.
        """
        pairs = list(product(seeds, tuple(loads)))
        for seed, load in pairs:
            if (seed, load) not in self.held_by:
                at_load = "" if load is None else f" at load {load!r}"
                raise LookupError(f"{self.folder}: nothing asks for seed {seed}{at_load}")
        return list(dict.fromkeys(self.held_by[pair] for pair in pairs))

    def find(self, seeds: Iterable[int], loads: Iterable[Load] = NO_LOAD) -> list[str]:
        """Return the paths of the files that have each of some seeds at each of some loads."""
        parts = self.find_parts(seeds, loads)
        return [f"{self.folder}/{self.kind}{part}.nc" for part in parts]

    @property
    def used(self) -> list[Part]:
        """What the files hold that have something that is wanted."""
        pairs = ((seed, load) for seed, loads in self.wanted.items() for load in loads)
        return list(dict.fromkeys(map(self.held_by.get, pairs)))


def list_names(folder: str) -> list[str]:
    """Return the names of the files in a folder, none if there is no such folder."""
    with suppress(FileNotFoundError, NotADirectoryError), os.scandir(folder) as entries:
        return [entry.name for entry in entries]
    return []


def find_parts(names: Iterable[str], kind: str) -> list[Part]:
    """Return what the files of one kind hold, by their names; others are left out."""
    parts = []
    for name in names:
        if name.startswith(kind) and name.endswith(".nc"):
            with suppress(ValueError):
                parts.append(Part.of(name.removeprefix(kind).removesuffix(".nc")))
    return parts


def divide(
    missing: Mapping[int, set[Load]], chunks: Iterable[tuple[Load, ...]], seeds_a_file: int
) -> list[Part]:
    """Divide what no file holds into new files.

    A file holds consecutive seeds that miss the same loads of a chunk. It ends with the chunk and
    with the block of `seeds_a_file` seeds, both of which do not depend on what is missing: once a
    file is made, the others stay as they are.
    """
    parts: list[Part] = []
    for chunk in chunks:
        for seed in sorted(missing):
            loads = tuple(load for load in chunk if load in missing[seed])
            begins_block = (seed - 1) % seeds_a_file == 0
            if parts and not begins_block and parts[-1] == Part(parts[-1].first, seed - 1, loads):
                parts[-1] = replace(parts[-1], last=seed)
            elif loads:
                parts.append(Part(seed, seed, loads))
    return parts


def chunk_loads(loads: Iterable[Load]) -> list[tuple[Load, ...]]:
    """Divide loads into chunks, in their order, each short enough for the name of a file."""
    chunks: list[tuple[Load, ...]] = []
    for load in loads:
        if chunks and len(join_loads((*chunks[-1], load))) <= LONGEST:
            chunks[-1] += (load,)
        else:
            chunks.append((load,))
    return chunks


def join_loads(loads: Iterable[Load]) -> str:
    """Write loads, such that they are read as the same numbers."""
    return "_".join(map(repr, loads))
