"""Builds the wheel (PEP 517): the package and the library that it calls, for every Python 3 of this machine.

libhysteron.so is taken from the environment variable HYSTERON_LIBRARY, else from the build folder of the sources, else
from where pkg-config says that it is installed. It lies inside the wheel, with what exported FMUs run, so that package and
library belong together whatever else is installed; the libraries that it stands on (SUNDIALS, KLU, udunits) are those of the system.
"""

from __future__ import annotations

import base64
import ctypes
import hashlib
import os
import platform
import subprocess
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
SONAME = "libhysteron.so.0"
FMU = "libhysteron_fmu.so"
CURE = "build it (cmake --build build --target libhysteron) or say where it is: HYSTERON_LIBRARY=/path/libhysteron.so"


def _installed() -> Path | None:
    try:
        folder = subprocess.run(["pkg-config", "--variable=libdir", "hysteron"], capture_output=True, text=True)
    except OSError:
        return None
    return Path(folder.stdout.strip()) / SONAME if folder.returncode == 0 else None


def _library() -> Path:
    asked = os.environ.get("HYSTERON_LIBRARY")
    places: list[Path | None] = [Path(asked)] if asked else [HERE.parent.parent / "build" / "interop" / SONAME, _installed()]
    for place in places:
        if place is not None and place.exists():
            return place.resolve()
    raise SystemExit(f"libhysteron.so was not found; {CURE}")


def _fmu_runtime(library: Path) -> Path:
    for place in (library.parent / FMU, library.parent / "hysteron" / FMU):
        if place.exists():
            return place
    cure = "build it: cmake --build build --target hysteron_fmu"
    raise SystemExit(f"{FMU}, which exported FMUs run, was not found beside {library}; {cure}")


def _version(library: Path) -> str:
    loaded = ctypes.CDLL(str(library))
    loaded.hy_version.restype = ctypes.c_char_p
    version: bytes = loaded.hy_version()
    return version.decode()


def _metadata(version: str) -> str:
    return (
        "Metadata-Version: 2.1\nName: hysteron\n"
        f"Version: {version}\n"
        "Summary: Block diagrams of actuators: simulate, compare with recordings, find what is missing\n"
        "Requires-Python: >=3.9\nRequires-Dist: numpy>=1.20\n"
        "Provides-Extra: plots\nRequires-Dist: matplotlib; extra == 'plots'\n"
        "Provides-Extra: tables\nRequires-Dist: pandas; extra == 'tables'\n"
    )


def _record_line(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def get_requires_for_build_wheel(config_settings: object = None) -> list[str]:
    return []


def build_wheel(wheel_directory: str, config_settings: object = None, metadata_directory: str | None = None) -> str:
    library = _library()
    version = _version(library)
    tag = f"py3-none-linux_{platform.machine()}"
    info = f"hysteron-{version}.dist-info"
    files = {f"hysteron/{path.name}": path.read_bytes() for path in sorted((HERE / "hysteron").iterdir()) if path.is_file()}
    files[f"hysteron/{SONAME}"] = library.read_bytes()
    files[f"hysteron/{FMU}"] = _fmu_runtime(library).read_bytes()
    files[f"{info}/METADATA"] = _metadata(version).encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: hysteron\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = "".join(_record_line(name, content) for name, content in files.items()) + f"{info}/RECORD,,\n"
    files[f"{info}/RECORD"] = record.encode()
    name = f"hysteron-{version}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path, date_time=(1980, 1, 1, 0, 0, 0))  # the same bytes from the same files
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            wheel.writestr(entry, content)
    return name


def build_sdist(sdist_directory: str, config_settings: object = None) -> str:
    raise SystemExit("the package is built from the sources of hysteron: pip install interop/python")
