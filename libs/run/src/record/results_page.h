#pragma once

namespace hersey::run {

/// What stands before the tables of the reference page docs/results-file.md.
inline constexpr const char* results_page_introduction = R"md(# Results file

The tables of this page are made by `hersey schema --results --markdown` from those that the program writes results by;
`hersey schema --results` gives them [as JSON](schema/results.json), for programs that read results.

A run leaves one HDF5 file. Everything in it is SI; every dataset carries the attributes `units` (`1` for a pure number)
and `long_name`, and names its dimensions. The file is an ordinary HDF5 file without compression or filters: h5py, MATLAB, Julia, HDFView and
ParaView's HDF5 tools read it as it is. [Other programs](exchange.md) get a copy as netCDF by the CF conventions, or the films over time as surfaces.

```python
import h5py
import matplotlib.pyplot as plt

with h5py.File("results.h5") as f:
    print(f.attrs["title"], "-", f.attrs["status"])
    h = f["bearings/big_end/h_min"]
    plt.plot(f["time"][:], h[:])
    plt.ylabel(f"{h.attrs['long_name']} [{h.attrs['units']}]")
    plt.show()
```

[xarray](https://docs.xarray.dev) opens each group with its coordinates, through h5netcdf:

```python
import xarray

film = xarray.open_dataset("results.h5", group="bearings/big_end/fields", engine="h5netcdf")
film["pressure"].sel(time=0.01, method="nearest").plot()  # over phi and z
bearing = xarray.open_dataset("results.h5", group="bearings/big_end", engine="h5netcdf")
bearing["force"].sel(xyz="x").plot()                      # over time
```

Dimensions are HDF5 dimension scales. A scale stands in every group that uses it, as a link to one and the same dataset, whose
attribute `path` is the path of the table below. The rows of what grows together have the first such series as their dimension:
`time` of instants, fields and the machine's cycles, `begin` of a bearing's cycles, `frequency` of modes. Scales keep no lists of
the datasets that use them (`REFERENCE_LIST`), which grow with the number of bodies.

In C++, `hersey::results::Reader` (`hersey/results/reader.h`) gives datasets with unit and description;
`hersey report results.h5 ...` turns one file, or several, into an HTML page. Several that one study has made are shown over its
parameters. Others are compared under their names, in every table and figure: the file's, or its folder's where the file is called
`results.h5` as those of `hersey run` are, with as many folders before it as tell the runs apart. Parameters in which they differ stand
beside. `--names before,after` gives them names of your own. The page lays up to eight runs over each other over the last cycle (over the whole
run where there is none), with what they differ by and a table of changes. A page is never written over what it is made from.

[`hersey rotor --results FILE.h5`](rotors.md) writes another kind of file, whose rows are speeds in place of instants: its root has the
attribute `kind`, `rotor over its speeds`. `status` is `failed` where a speed has no answer; `message` says which and why, all others have their row.
`hersey report` takes files of runs only.

The section *Spectra and orders* of a run's page shows the amplitudes of any of its series: over frequency, under Hann's window, of the last
cycle or the second half, or of the whole run; or over the orders of what turns (the crank, else a hinge, else a body) over whole turns,
where the lines of what repeats are exact. A sine of amplitude 1 has a peak of 1. Where the speed changes by more than a fifth there are a waterfall
and order tracks too (windows of up to 8 turns), and curves can be drawn over the speed, its mean over one turn.

A page holds at most 4 MB of the films' fields. Where more are stored it shows every k-th instant, and a button loads all of a film from the folder
beside it (`report_fields` beside `report.html`, up to 256 MB); move both together. Pages work without the folder.

## Layout

`n` is the number of stored instants, `m` that of stored fields, `c` that of cycles; `<...>` stands for a name. Vectors of bodies and joints are in ground or joint
axes, those of bearings in the bearing's axes: z along the axis, angle φ from x towards y
([definitions and signs](conventions.md)).
)md";

/// The text after the tables.
inline constexpr const char* results_page_end = R"md(
Cycles are made of every accepted step, whether its row is stored or not. Energies and means are by the trapezoidal rule.

## What the report's summary says

Extremes run over all stored instants: the *minimum film thickness (MOFT)* is the smallest `h_min`, the *peak film
pressure (POFP)* the largest `p_max`, the *largest load* the longest `force`. Means are over time by the trapezoidal
rule. Values *at the end* are the last row. The *worst* balance error is the one largest in size; the *residual power of the
equations of motion* is also given as a share of the largest of all powers in the run. *Unexplained energy* is that at the end of the run, its share one of `available`; *energy from nowhere* has been gained by steps without anything that put it in;
of a film, the integral of `power_error` over that of `power_film` and `power_asperity`. A page thins long series and many fields (it says so), and shows a
field to 1/131068 of its range at each instant; the
summary never does.

## Status, crashes, full disks

| `status` | |
|---|---|
| `completed` | the run reached its end (or settled) |
| `stopped` | ended on request (Ctrl-C); everything up to then is valid |
| `failed` | ended without an answer; `message` gives the reason, and what is in the file up to then is valid |
| `running` | under way; or the program was killed, or the disk was full, before it could say more |

Rows are flushed together, at most every half second while a run goes on, less often where a flush of thousands of series would take
more than 3 % of the time, and by a thread of their own where the program may use more than one. What was flushed stays readable whatever
happens to the program: it may be killed (`SIGKILL`) at any instant, a flush included, without `h5clear` or any other
repair. HDF5 by itself does not promise that; the writer's own file driver (`libs/results/src/reserving_driver.h`) holds
metadata back until a flush is complete, writes it in an order that is consistent at every moment, and reserves disk
space before using it. A kill in the middle of a flush may leave some series a few rows longer than others: count the
rows that all have, as `Reader` and Python's `hersey.open_results` do.

When a run ends in order, whatever its status, the file gets a seal behind the end of its HDF5 part, one line of text with its length and checksum
(as in [reduced bodies](reduced-body-file.md)): a sealed file whose bytes have changed since is refused as damaged. The file of a run that was killed
has none and is read as it is.

A results file appears under its name when the model and all that is written before the first step are in it; until then it is called
`results.h5.unfinished`, and results that it replaces stay. A program started with its output or messages closed (`>&-`, `2>&-`) opens them on
nothing, so that they do not end up in a file.

Stopped, killed and failed runs can go on: [long runs](long-runs.md).

When the disk is full the program says so with the file's name and the system's reason, and stops; rows flushed before
stay. An existing file is never touched unless asked (`--force`), and then replaced by a new one, so that a program
that still reads the old file keeps it. While a run writes it, no other run replaces or goes on with it, whatever is asked: the
file is locked (the system's `flock`, on `FILE.lock` beside it, which goes with the run; what a killed run leaves of it locks nothing),
and the other one ends with 2 and the writing process's number. Reading is free for all.

| claim | test |
|---|---|
| what is written is read back exactly | `libs/results/test/writer_test.cpp: WhatIsWritten_IsReadBackExactly` |
| one run writes a file; locks of killed runs block nobody | `libs/results/test/output_lock_test.cpp`, `python/tests/test_run.py` |
| flushed rows survive `SIGKILL`, also for h5py | `libs/results/test/crash_test.cpp: FlushedRows_SurviveSigkill` |
| a kill inside a flush leaves a readable file | `crash_test.cpp: KilledAtAnyMoment_LeavesAReadableFile`, `KilledInTheFirstFlush_HasNoCompleteRow`, `IndexNodes_LieInOneMemoryPageEach` |
| a flush reads nothing back, however many series | `writer_test.cpp: Flush_ReadsNothingBack` |
| units, names, dimensions, xarray; this page lists every dataset | `tests/results_file/results_file_test.py` |
| every dataset and attribute is in the tables with its unit, and every line of them in some run | `results_file_test.py: test_every_dataset_is_in_the_tables_with_its_unit_and_text`, `test_every_line_of_the_tables_is_in_some_run` |
| this page is made from the tables | `libs/run/test/quantities_test.cpp: CommittedReferenceOfResults_IsFresh` |
| the same bits for any number of threads, of the program and of BLAS | `results_file_test.py: test_results_are_the_same_for_any_number_of_..._threads` |
| a full disk is reported and costs the unflushed rows only | `crash_test.cpp: FullDisk_IsReportedAndKeepsFlushedRows` |
| results appear with their model; a run that could not begin leaves nothing | `libs/run/test/resume_test.cpp: ResultsAppear_WithTheirModel` |
| closed standard streams leave results alone | `tests/cli/cli_test.py: test_closed_standard_streams_leave_results_alone` |
| compared runs have names of their own | `libs/report/test/run_names_test.cpp`, `cli_test.py: test_compared_runs_stand_under_their_own_names` |
| losses, extremes and maps of cycles | `libs/run/test/cycle_maps_test.cpp` |
| the summary's numbers | `libs/report/test/summary_test.cpp` |
)md";

}  // namespace hersey::run
