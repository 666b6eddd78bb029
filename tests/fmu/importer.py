"""An importer of FMUs of the tests' own, over the C interface of both versions of the standard."""

import ctypes as c
import os
import xml.etree.ElementTree as ElementTree
import zipfile
from platform import machine

OK, WARNING, DISCARD, ERROR = range(4)
# Folders of libraries: version 2 names those of x86 its own way only.
PLATFORMS = {2: "linux64", 3: "x86_64-linux"} if machine() == "x86_64" else dict.fromkeys((2, 3), f"{machine()}-linux")


def column_of(file, name):
    """What a results file has under the name of an FMU's output: `a.b.c`, a component by its label or place: `a.b.x`, `a.b[3]`."""
    name, _, place = name.rstrip("]").partition("[")
    path = name.replace(".", "/")
    if path in file:
        return file[path][:, int(place) - 1] if place else file[path][:]
    path, _, label = path.rpartition("/")
    labels = [text.decode() for text in file[path].dims[1][0][:]]
    return file[path][:, labels.index(label)]


class Fmu:
    """An unpacked FMU: description and library."""

    def __init__(self, path, folder):
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        self.folder = folder
        self.description = ElementTree.parse(os.path.join(folder, "modelDescription.xml")).getroot()
        self.version = int(self.description.get("fmiVersion")[0])
        self.token = self.description.get("guid" if self.version == 2 else "instantiationToken")
        identifier = self.description.find("CoSimulation").get("modelIdentifier")
        self.library_path = os.path.join(folder, "binaries", PLATFORMS[self.version], identifier + ".so")
        self.library = c.CDLL(self.library_path)
        self.references = {}
        self.variables = {}
        self.sizes = {}
        for variable in self.description.find("ModelVariables"):
            self.references[variable.get("name")] = int(variable.get("valueReference"))
            self.variables[variable.get("name")] = variable
            dimension = variable.find("Dimension")
            self.sizes[variable.get("name")] = 1 if dimension is None else int(dimension.get("start"))

    def names(self, causality, arrays=False):
        """The variables of a role that are one number, or that are arrays."""
        return [name for name, variable in self.variables.items() if variable.get("causality") == causality
                and (variable.find("Dimension") is not None) == arrays]

    def start_of(self, name):
        variable = self.variables[name]
        return float((variable[0] if self.version == 2 else variable).get("start"))


LOGGER_2 = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p)
LOGGER_3 = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)


UPDATE_3 = c.CFUNCTYPE(None, c.c_void_p, c.c_double, c.c_bool, c.c_bool, c.c_bool, c.c_bool, c.POINTER(c.c_bool),
                       c.POINTER(c.c_double))


class Callbacks2(c.Structure):
    _fields_ = [("logger", LOGGER_2), ("allocate", c.c_void_p), ("free", c.c_void_p), ("finished", c.c_void_p),
                ("environment", c.c_void_p)]


class Instance:
    """An instance of either version, under the names of neither.

    update: called in FMI 3 with the time of each intermediate update; returns the instant at which the step shall end early, or None.
    early: early returns are allowed."""

    def __init__(self, fmu, name="one", token=None, logging=False, resources=None, logger=True, update=None,
                 early=False, intermediate=()):
        self.fmu, self.version, self.log = fmu, fmu.version, []
        token = (token or fmu.token).encode()
        folder = resources or os.path.join(fmu.folder, "resources")
        if self.version == 2:
            self.callback = LOGGER_2(lambda _, __, status, category, text: self.log.append((status, text.decode()))) if logger else LOGGER_2()
            self.callbacks = Callbacks2(self.callback, None, None, None, None)
            create = fmu.library.fmi2Instantiate
            create.restype = c.c_void_p
            self.handle = create(name.encode(), 1, token, ("file://" + folder).encode(), c.byref(self.callbacks), 0,
                                 int(logging))
        else:
            self.callback = LOGGER_3(lambda _, status, category, text: self.log.append((status, text.decode()))) if logger else LOGGER_3()
            self.flags = []

            def updated(_, time, set_requested, get_allowed, finished, can_return, asks, at):
                self.flags.append((set_requested, get_allowed, finished, can_return))
                wanted = update(time)
                if wanted is not None:
                    asks[0], at[0] = True, wanted

            self.updated = UPDATE_3(updated) if update else UPDATE_3()
            listed = (c.c_uint32 * max(1, len(intermediate)))(*[fmu.references[n] for n in intermediate])
            create = fmu.library.fmi3InstantiateCoSimulation
            create.restype = c.c_void_p
            self.handle = create(name.encode(), token, (folder + "/").encode(), c.c_bool(False), c.c_bool(logging),
                                 c.c_bool(False), c.c_bool(early), listed, c.c_size_t(len(intermediate)), None,
                                 self.callback, self.updated)

    def call(self, name, *arguments):
        function = getattr(self.fmu.library, f"fmi{self.version}{name}")
        function.restype = c.c_int
        return function(c.c_void_p(self.handle), *arguments)

    def must(self, name, *arguments):
        status = self.call(name, *arguments)
        if status != OK:
            raise AssertionError(f"{name}: {status} {self.log}")

    def initialise(self, start=0.0, stop=4e-3, parameters=None):
        for name, value in (parameters or {}).items():
            assert self.set(name, value) == OK, self.log
        if self.version == 2:
            self.must("SetupExperiment", 0, c.c_double(0), c.c_double(start), 1, c.c_double(stop))
            self.must("EnterInitializationMode")
        else:
            self.must("EnterInitializationMode", c.c_bool(False), c.c_double(0), c.c_double(start), c.c_bool(True),
                      c.c_double(stop))
        self.must("ExitInitializationMode")
        return self

    def access(self, verb, names, values):
        references = (c.c_uint32 * len(names))(*[self.fmu.references[n] if isinstance(n, str) else n for n in names])
        numbers = (c.c_double * len(values))(*values)
        count = c.c_size_t(len(names))
        if self.version == 2:
            return self.call(verb + "Real", references, count, numbers), list(numbers)
        return self.call(verb + "Float64", references, count, numbers, c.c_size_t(len(values))), list(numbers)

    def array(self, name):
        status, values = self.access("Get", [name], [0] * self.fmu.sizes[name])
        assert status == OK, self.log
        return values

    def derivatives(self, verb, unknowns, knowns, seed, count):
        """GetDirectionalDerivative or GetAdjointDerivative, with a result of `count` numbers."""
        lists = [(c.c_uint32 * len(names))(*[self.fmu.references[n] if isinstance(n, str) else n for n in names])
                 for names in (unknowns, knowns)]
        seeds, found = (c.c_double * len(seed))(*seed), (c.c_double * count)()
        arguments = [lists[0], c.c_size_t(len(unknowns)), lists[1], c.c_size_t(len(knowns)), seeds]
        if self.version == 3:
            arguments.append(c.c_size_t(len(seed)))
        arguments.append(found)
        if self.version == 3:
            arguments.append(c.c_size_t(count))
        return self.call(f"Get{verb}Derivative", *arguments), list(found)

    def jacobian(self, unknowns, knowns):
        """d unknowns / d knowns by rows, a directional derivative for each known."""
        columns = []
        for k in range(len(knowns)):
            status, column = self.derivatives("Directional", unknowns, knowns, [float(j == k) for j in range(len(knowns))],
                                              len(unknowns))
            assert status == OK, self.log
            columns.append(column)
        return [list(row) for row in zip(*columns)]

    def restore(self, state):
        self.must("SetFMUstate" if self.version == 2 else "SetFMUState", state)

    def release(self, state):
        self.must("FreeFMUstate" if self.version == 2 else "FreeFMUState", c.byref(state))

    def get(self, name):
        status, values = self.access("Get", [name], [0])
        assert status == OK, self.log
        return values[0]

    def set(self, name, value):
        return self.access("Set", [name], [value])[0]

    def step(self, time, length):
        if self.version == 2:
            return self.call("DoStep", c.c_double(time), c.c_double(length), 1)
        self.events, self.ends, self.early = c.c_bool(True), c.c_bool(True), c.c_bool(True)
        self.reached = c.c_double(-1)
        return self.call("DoStep", c.c_double(time), c.c_double(length), c.c_bool(True), c.byref(self.events),
                         c.byref(self.ends), c.byref(self.early), c.byref(self.reached))

    def state(self):
        kept = c.c_void_p()
        self.must("GetFMUstate" if self.version == 2 else "GetFMUState", c.byref(kept))
        return kept

    def free(self):
        free = getattr(self.fmu.library, f"fmi{self.version}FreeInstance")
        free.restype = None
        free(c.c_void_p(self.handle))
