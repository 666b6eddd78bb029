#!/usr/bin/python3
"""Studies on a real slurmctld and slurmd on loopback; skipped in words where there are none."""

import json
import os
import subprocess
import sys
import tempfile
import time
import unittest

import cluster

HERSEY = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
OK, FAILED, WRONG_INPUT = 0, 1, 2
WHY_NOT = cluster.is_possible()
LONGEST = 150  # [s] of a study; one takes 10 to 40

MODEL = """hersey: 1
parameters: {x1: 0, x2: 0, clearance: 34 um}
lubricants: {oil: {viscosity: 15 mPa.s}}
bearings:
  main:
    {diameter: 45 mm, width: 15.6 mm, radial_clearance: "${clearance}", lubricant: oil, grid: {circumferential: 24, axial: 5},
     supply: {line: widest_gap, pressure: 0 bar}, operating_point: {journal_speed: 3570 rpm, load: 2500 N}}
study:
  plan: halton
  samples: %d
"""
INPUTS = """  parameters: {x1: {distribution: uniform, low: 0, high: 1}, x2: {distribution: uniform, low: 0, high: 1}}
  outputs: [y]
"""


@unittest.skipIf(WHY_NOT, WHY_NOT)
class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="hersey-slurm-")
        cls.cluster = cluster.Cluster(os.path.join(cls.folder.name, "cluster"))

    @classmethod
    def tearDownClass(cls):
        cls.cluster.close()
        cls.folder.cleanup()

    def setUp(self):
        self.root = tempfile.mkdtemp(dir=self.folder.name)
        self.out = os.path.join(self.root, "out")
        self.log = os.path.join(self.root, "log")
        self.cluster.clear()

    def start(self, samples, *arguments, study=INPUTS, stand_in=0.05, environment=None):
        model = os.path.join(self.root, "model.yaml")
        with open(model, "w", encoding="utf-8") as file:
            file.write(MODEL % samples + study)
        command = [HERSEY, "study", model, "--out", self.out, "--on", "slurm", *arguments]
        if stand_in is not None:
            command += ["--runner", f"{sys.executable} {HERE}/ishigami.py {self.log} {stand_in}"]
        process = subprocess.Popen(command, env=environment or self.cluster.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
        self.addCleanup(self.stop, process)
        return process

    @staticmethod
    def stop(process):
        """Ends a study that a test has left behind."""
        if process.poll() is None:
            process.kill()
        process.communicate()

    def end(self, process, code=OK):
        out, err = process.communicate(timeout=LONGEST)
        self.assertEqual(process.returncode, code, err)
        return out, err

    def done(self):
        if not os.path.exists(self.log):
            return []
        with open(self.log, encoding="utf-8") as file:
            return file.read().split()

    def wait_for(self, count):
        end = time.monotonic() + 120
        while len(self.done()) < count:
            self.assertLess(time.monotonic(), end, "no runs from the cluster")
            time.sleep(0.1)

    def resume_until_the_end_of(self, process):
        """The administrator's part: looks after nodes that Slurm has drained."""
        end = time.monotonic() + LONGEST
        while process.poll() is None and time.monotonic() < end:
            if "drain" in self.cluster.call("sinfo", "-h", "-o", "%t"):
                self.cluster.resume_node()
            time.sleep(1)

    def completed(self):
        with open(os.path.join(self.out, "results.json"), encoding="utf-8") as file:
            return json.load(file)["completed"]

    def test_a_study_is_the_same_as_at_home_and_repeats_nothing(self):
        study = ("  parameters: {clearance: {distribution: uniform, low: 30 um, high: 40 um}}\n"
                 "  outputs: [bearings.main.h_min]\n")
        self.end(self.start(24, "--chunk", "6", study=study, stand_in=None))
        with open(os.path.join(self.out, "runs.csv"), encoding="utf-8") as file:
            there = file.read()
        _, err = self.end(self.start(24, study=study, stand_in=None))
        self.assertIn("24 runs are done already", err)
        home = os.path.join(self.root, "home")
        subprocess.run([HERSEY, "study", os.path.join(self.root, "model.yaml"), "--out", home], check=True,
                       capture_output=True)
        with open(os.path.join(home, "runs.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), there)

    def test_cancelled_tasks_are_sent_again(self):
        process = self.start(60, "--chunk", "10")
        self.wait_for(5)
        self.cluster.call("scancel", "-u", "root", "-t", "running")
        _, err = self.end(process)
        self.assertEqual(self.completed(), 60)
        self.assertIn("have no record", err)
        # What a cancelled task had finished is kept: of each of the two tasks at work one run is lost.
        self.assertLessEqual(len(self.done()), 60 + 2 * os.cpu_count())

    def test_a_dead_node_loses_runs_in_flight_only(self):
        process = self.start(60, "--chunk", "10")
        self.wait_for(5)
        self.cluster.kill_node()
        time.sleep(2)
        self.cluster.start_node()
        self.end(process)
        self.assertEqual(self.completed(), 60)
        self.assertLessEqual(len(self.done()), 60 + 2 * os.cpu_count())

    def test_a_controller_that_is_killed_is_waited_for(self):
        process = self.start(60, "--chunk", "10")
        self.wait_for(5)
        self.cluster.kill_controller()
        time.sleep(4)
        self.cluster.start_controller()
        self.resume_until_the_end_of(process)
        self.end(process)
        self.assertEqual(self.completed(), 60)
        self.assertLessEqual(len(self.done()), 60 + 2 * os.cpu_count())

    def test_a_study_that_is_killed_goes_on(self):
        process = self.start(60, "--chunk", "10")
        self.wait_for(10)
        process.kill()
        process.communicate()
        self.cluster.call("scancel", "-u", "root")
        time.sleep(3)
        self.end(self.start(60, "--chunk", "10"))
        self.assertEqual(self.completed(), 60)
        self.assertLessEqual(len(self.done()), 60 + 2 * os.cpu_count())

    def test_a_full_disk_keeps_what_is_written(self):
        # 200 runs in chunks of 10: a page of the file system for each list of runs and for each file of answers, 40 in
        # all; there is room for 32.
        os.mkdir(self.out)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={32 * 4096}", "none", self.out], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", self.out], check=True)
        process = self.start(200, "--chunk", "10", stand_in=0)
        _, err = process.communicate(timeout=LONGEST)
        self.assertEqual(process.returncode, FAILED, err)
        self.assertIn("the same command goes on", err)
        before = len(self.done())
        self.assertGreater(before, 10)
        subprocess.run(["mount", "-o", "remount,size=100m", self.out], check=True)
        self.end(self.start(200, "--chunk", "10", stand_in=0))
        self.assertEqual(self.completed(), 200)
        # Each of the 20 tasks has lost one answer at most: the one for which there was no room.
        self.assertLessEqual(len(self.done()), 200 + 20)

    def test_a_torn_record_is_done_again(self):
        self.end(self.start(20, "--chunk", "5"))
        shards = os.path.join(self.out, "shards")
        name = os.path.join(shards, sorted(os.listdir(shards))[0])
        os.truncate(name, os.path.getsize(name) - 30)  # as a write that found no room for its end
        self.end(self.start(20, "--chunk", "5"))
        self.assertEqual(self.completed(), 20)
        self.assertEqual(len(self.done()), 21)

    def test_tasks_that_nobody_starts_are_reported_with_the_reason(self):
        self.cluster.call("scontrol", "update", f"nodename={self.cluster.host}", "state=drain", "reason=swept")
        process = self.start(4, environment=dict(self.cluster.environment, HERSEY_STUDY_PATIENCE="2"))
        time.sleep(8)
        self.cluster.resume_node()
        _, err = self.end(process)
        self.assertIn("no task is at work", err)
        self.assertIn("DRAINED", err)

    def test_a_partition_that_does_not_exist_is_reported_with_those_that_do(self):
        _, err = self.end(self.start(4, "--partition", "nigth"), WRONG_INPUT)
        self.assertIn("--partition", err)
        self.assertIn("expected one of: main", err)

    def test_a_cluster_out_of_reach_is_reported(self):
        conf = os.path.join(self.root, "slurm.conf")
        with open(self.cluster.conf, encoding="utf-8") as file:
            text = file.read().replace("16817", "16999")
        with open(conf, "w", encoding="utf-8") as file:
            file.write(text + "MessageTimeout=2\n")
        _, err = self.end(self.start(4, environment=dict(self.cluster.environment, SLURM_CONF=conf)), WRONG_INPUT)
        self.assertIn("cannot be reached", err)
        self.assertIn("--on slurm", err)


if __name__ == "__main__":
    unittest.main()
