"""The build backend of `pip install .` (PEP 517): CMake builds the extension module, the wheel is zipped here.

The build folder is build/python; compiled objects come from ccache where `make` has built them before.
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "python"
NAME = "hersey"
# What a fixed moment gives: the same sources make the same wheel.
MOMENT = (2020, 1, 1, 0, 0, 0)


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(hersey VERSION ([0-9.]+)", text)[1]


def metadata():
    return "\n".join([
        "Metadata-Version: 2.1", f"Name: {NAME}", f"Version: {version()}",
        "Summary: Oil-film journal bearings inside moving machines", "License: BSD-3-Clause", "Requires-Python: >=3.9",
        # h5py is needed too, but Debian's has another name for pip, which would look for it on the network.
        "Requires-Dist: numpy", "Requires-Dist: xarray", "Requires-Dist: pandas", "Provides-Extra: plot", 'Requires-Dist: matplotlib; extra == "plot"',
        "Provides-Extra: progress", 'Requires-Dist: tqdm; extra == "progress"', ""])


def tag():
    version_tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version_tag}-{version_tag}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def wheel_text():
    return f"Wheel-Version: 1.0\nGenerator: hersey\nRoot-Is-Purelib: false\nTag: {tag()}\n"


def call(*command):
    if subprocess.run(command, cwd=ROOT, check=False).returncode != 0:
        raise SystemExit(f"hersey: this failed: {' '.join(map(str, command))}\n"
                         "Debian's packages for it: scripts/setup build python")


def compile_module():
    """Builds the extension module and returns its path."""
    for file in (BUILD / "python" / NAME).glob("_core*.so"):
        file.unlink()
    call(os.path.join(ROOT, "scripts/compiler"), "cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
         "-DHERSEY_WERROR=ON", "-DHERSEY_UNITY=ON", "-DHERSEY_PYTHON_PACKAGE=ON", f"-DPython3_EXECUTABLE={sys.executable}")
    call("cmake", "--build", BUILD, "--target", "hersey_python", "-j", os.environ.get("JOBS", str(os.cpu_count() or 1)))
    return next((BUILD / "python" / NAME).glob("_core*.so"))


class Wheel:
    """A wheel as it is written: what goes in is recorded."""

    def __init__(self, path):
        self.file = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.record = []

    def add(self, name, content, mode=0o644):
        content = content.encode() if isinstance(content, str) else content
        entry = zipfile.ZipInfo(name, MOMENT)
        entry.external_attr = (0o100000 | mode) << 16
        entry.compress_type = zipfile.ZIP_DEFLATED
        self.file.writestr(entry, content)
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(content)}")

    def close(self, info):
        self.add(f"{info}/METADATA", metadata())
        self.add(f"{info}/WHEEL", wheel_text())
        for name in ("LICENSE", "THIRD_PARTY.md"):
            self.add(f"{info}/{name}", (ROOT / name).read_bytes())
        record = f"{info}/RECORD"
        self.file.writestr(zipfile.ZipInfo(record, MOMENT), "\n".join([*self.record, f"{record},,", ""]))
        self.file.close()


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info = Path(metadata_directory) / f"{NAME}-{version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(metadata(), encoding="utf-8")
    (info / "WHEEL").write_text(wheel_text(), encoding="utf-8")
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    module = compile_module()
    name = f"{NAME}-{version()}-{tag()}.whl"
    wheel = Wheel(Path(wheel_directory) / name)
    for file in sorted((ROOT / "python" / NAME).iterdir()):
        if file.suffix in (".py", ".pyi") or file.name == "py.typed":
            wheel.add(f"{NAME}/{file.name}", file.read_bytes())
    wheel.add(f"{NAME}/{module.name}", module.read_bytes(), 0o755)
    wheel.close(f"{NAME}-{version()}.dist-info")
    return name


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    compile_module()
    name = f"{NAME}-{version()}-{tag()}.whl"
    wheel = Wheel(Path(wheel_directory) / name)
    wheel.add(f"{NAME}.pth", f"{BUILD / 'python'}\n")  # there every .py file is a link into python/hersey
    wheel.close(f"{NAME}-{version()}.dist-info")
    return name


def build_sdist(sdist_directory, config_settings=None):
    """All files of the repository that git keeps."""
    name = f"{NAME}-{version()}"
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\n")
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in filter(None, files):
            archive.add(ROOT / file, f"{name}/{file}")
    return f"{name}.tar.gz"
