"""Runs from Python: the program's numbers, progress, interruptions, failures."""

import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import time

import h5py
import numpy as np
import pytest
from conftest import EXAMPLES

import hersey


def test_run_has_the_bits_of_the_program(machine, tmp_path, program):
    model = hersey.Model.from_dict(machine)
    results = model.run(tmp_path / "python")
    file = tmp_path / "model.yaml"
    file.write_text(model.text)
    subprocess.run([program, "run", file, "--output", tmp_path / "program"], check=True, capture_output=True)
    with h5py.File(tmp_path / "program" / "results.h5") as other:
        for name in ("h_min", "force", "p_max"):
            assert np.array_equal(results["bearings/main"][name].values, other[f"bearings/main/{name}"][:]), name
    assert results.status == "completed" and results.summary["steps"] == 50


def numbers(file):
    found = {}
    with h5py.File(file) as content:
        content.visititems(lambda name, item: found.__setitem__(name, item[()])
                           if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and "wall" not in name else None)
    return found


def test_bodies_of_earlier_runs_do_not_show_in_later_ones(tmp_path, program):
    """A process keeps reduced meshes: each run still has the bits of the program, which has reduced nothing before."""
    file, rod = EXAMPLES / "flexible_slider_crank" / "model.yaml", "bodies.rod.flexible."
    short = {"simulation.duration": "1 ms"}
    changes = [{}, {rod + "modes": "3"}, {rod + "form": "nodal"}, {rod + "form": "nodal", rod + "modes": "3"},
               {rod + "damping.stiffness": "9 us"}, {rod + "length_unit": "1.01 mm"}]
    for turn, change in enumerate(2 * changes):
        hersey.Model.load(file).set(short | change).run(tmp_path / f"python-{turn}")
    for turn, change in enumerate(changes):
        values = [word for key, value in (short | change).items() for word in ("--set", f"{key}={value}")]
        subprocess.run([program, "run", file, *values, "--output", tmp_path / "alone"], check=True, capture_output=True)
        alone = numbers(tmp_path / "alone" / "results.h5")
        assert len(alone) > 50
        for again in (turn, turn + len(changes)):
            here = numbers(tmp_path / f"python-{again}" / "results.h5")
            off = [name for name in alone if not np.array_equal(alone[name], here.get(name), equal_nan=True)]
            assert not off, (change, off)
        shutil.rmtree(tmp_path / "alone")


def test_existing_results_are_kept(machine, tmp_path):
    model = hersey.Model.from_dict(machine)
    model.run(tmp_path)
    with pytest.raises(FileExistsError, match="overwrite=True"):
        model.run(tmp_path)
    model.run(tmp_path, overwrite=True)


def test_results_do_not_replace_what_the_model_reads(machine, tmp_path):
    file = tmp_path / "rig.h5"  # a model file, whatever its name
    text = hersey.Model.from_dict(machine).text
    file.write_text(text)
    model = hersey.Model.load(file)
    for run in (lambda: model.run(file, overwrite=True), lambda: hersey.Simulation(model, file, overwrite=True)):
        with pytest.raises(hersey.InputError, match="output: .*which is read as"):
            run()
    assert file.read_text() == text


def test_progress_is_reported_at_the_start_and_after_every_step(machine, tmp_path):
    times = []
    results = hersey.Model.from_dict(machine).run(tmp_path, progress=lambda progress: times.append(progress.t))
    assert len(set(times)) == results.summary["steps"] + 1 and times == sorted(times)


def test_bar_counts_to_its_end(machine, tmp_path, capsys):
    pytest.importorskip("tqdm")
    hersey.Model.from_dict(machine).run(tmp_path, progress=True)
    assert "100%" in capsys.readouterr().err


def test_exception_of_a_progress_function_comes_out_and_results_stay(machine, tmp_path):
    def listen(progress):
        if progress.t > 5e-3:
            raise ValueError("enough")

    with pytest.raises(ValueError, match="enough"):
        hersey.Model.from_dict(machine).run(tmp_path, progress=listen)
    results = hersey.open_results(tmp_path)
    assert results.status == "stopped" and float(results.bearing()["time"][-1]) == pytest.approx(5.2e-3)


def test_ctrl_c_ends_a_run_with_results_and_the_run_goes_on(machine, tmp_path):
    machine["simulation"]["duration"] = "200 ms"
    model = hersey.Model.from_dict(machine)

    def interrupt(progress):
        if progress.t > 5e-3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt) as caught:
        model.run(tmp_path, progress=interrupt)
    stopped = caught.value
    assert isinstance(stopped, hersey.Stopped) and stopped.summary["status"] == "stopped"
    assert 0 < stopped.summary["t_results"] < 0.1
    assert len(stopped.results.bearing()["time"]) > 1
    assert model.run(tmp_path, resume=True).status == "completed"


def test_ctrl_c_is_heard_without_progress(machine, tmp_path):
    """A process of its own, interrupted from outside while no Python function is called."""
    machine["simulation"]["duration"] = "1000 s"
    machine["output"] = {"fields_every": "100 s", "every": 10000}
    script = textwrap.dedent(f"""
        import hersey
        model = hersey.Model.from_dict({machine!r})
        print("begin", flush=True)
        try:
            model.run({str(tmp_path)!r})
        except hersey.Stopped as stopped:
            print(stopped.results.status, flush=True)
    """)
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "begin\n"
        timer = threading.Timer(1.5, child.send_signal, [signal.SIGINT])
        timer.start()
        out, _ = child.communicate(timeout=60)
    finally:
        child.kill()
    assert out == "stopped\n"


def test_other_threads_run_meanwhile(machine, tmp_path):
    machine["simulation"]["duration"] = "100 ms"
    model, counted, done = hersey.Model.from_dict(machine), [0], threading.Event()

    def count():
        while not done.wait(1e-3):
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    model.run(tmp_path)
    done.set()
    thread.join()
    assert counted[0] > 10  # a run of some tenths of a second


def test_failed_run_tells_when_and_why_with_results(machine, tmp_path):
    machine["forces"]["push"]["components"] = ["0 N", {"expression": "t < 0.004 ? -500 : log(-1)", "unit": "N"}, "0 N"]
    machine["simulation"]["smallest_step"] = "0.1 ms"
    with pytest.raises(hersey.HerseyError) as caught:
        hersey.Model.from_dict(machine).run(tmp_path)
    assert isinstance(caught.value, hersey.RunError), caught.value
    assert 3e-3 < caught.value.summary["t_results"] <= 4.2e-3
    assert len(caught.value.results.bearing()["time"]) > 10


def test_bearings_alone_are_no_run(alone):
    with pytest.raises(hersey.InputError, match="model.bearing"):
        alone.run()


def test_an_output_that_another_run_writes_is_locked_and_says_so(machine, tmp_path, program):
    model = hersey.Model.from_dict(machine)
    file = tmp_path / "model.yaml"
    file.write_text(model.text, encoding="utf-8")
    writing = hersey.Simulation(model, tmp_path / "out")  # one that goes on writing
    refusal = rf"results.h5: another run \(process {os.getpid()} on .*\) is writing this file"
    for options in ({}, {"overwrite": True}, {"resume": True}):
        with pytest.raises(BlockingIOError, match=refusal):
            model.run(tmp_path / "out", **options)
    with pytest.raises(BlockingIOError, match=refusal):
        hersey.Simulation(model, tmp_path / "out", overwrite=True)
    for option in ([], ["--force"], ["--resume"]):
        run = subprocess.run([program, "run", file, "--output", tmp_path / "out", *option], capture_output=True, text=True)
        assert run.returncode == 2 and re.search(refusal, run.stderr), run.stderr
    while writing.step():
        pass
    assert writing.finish().status == "completed"
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["results.h5"]
    assert model.run(tmp_path / "out", overwrite=True).status == "completed"


def test_the_lock_of_a_killed_run_blocks_nobody(machine, tmp_path, program):
    machine["simulation"]["duration"] = "1000 s"
    file = tmp_path / "model.yaml"
    file.write_text(hersey.Model.from_dict(machine).text, encoding="utf-8")
    run = subprocess.Popen([program, "run", file, "--output", tmp_path / "out"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
    while not (tmp_path / "out" / "results.h5").exists():
        assert run.poll() is None
        time.sleep(0.01)
    with pytest.raises(BlockingIOError, match=f"process {run.pid}"):
        hersey.Model.load(file).run(tmp_path / "out", overwrite=True)
    run.kill()
    run.wait()
    machine["simulation"]["duration"] = "1 ms"
    assert hersey.Model.from_dict(machine).run(tmp_path / "out", overwrite=True).status == "completed"
