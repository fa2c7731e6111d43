# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""A PEP 517 backend that builds the package with CMake and Ninja; it needs no other Python package.

Setting: build-dir=FOLDER, a build of the sources that is used and brought up to date; a relative
path is that from the top folder of the sources. Without it the sources are built anew in a temporary
folder, which takes some minutes.
"""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def _version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(pcl_als VERSION ([\d.]+)", text).group(1)


def _run(*command):
    subprocess.run([str(part) for part in command], check=True)


def _build(folder, given):
    if not given:
        _run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DBUILD_TESTING=OFF", "-DPCL_ALS_WITH_VTK=OFF", f"-DPCL_ALS_PYTHON={sys.executable}")
    _run("cmake", "--build", folder, "--target", "pcl_als_python", "pcl_als_libraries")


def _libraries_of(extension, stage):
    """The libraries below the stage that an extension module needs."""
    listed = subprocess.run(["ldd", str(extension)], capture_output=True, text=True, check=True).stdout
    paths = [pathlib.Path(path) for path in re.findall(r"=> (/.*) \(0x", listed)]
    return [path for path in paths if stage in path.parents or stage in path.resolve().parents]


def _stage(build, stage):
    """Installs into the stage and returns the folder of the package, with its libraries inside."""
    for component in ("python", "libraries"):
        _run("cmake", "--install", build, "--prefix", stage, "--component", component)
    extension, = stage.glob("lib/python3*/dist-packages/pcl_als/_pcl_als*.so")
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if extension.name != "_pcl_als" + suffix:
        raise SystemExit(f"{build} has the package for another Python ({extension.name}); this one needs {suffix}: "
                         f"configure it with -DPCL_ALS_PYTHON={sys.executable}")
    for library in _libraries_of(extension, stage):
        _copy(library, extension.parent)
    return extension.parent


def _copy(library, folder):
    """A library that is also built for newer processors: both, the other in the loader's folder."""
    parts = library.parts
    if "glibc-hwcaps" in parts:
        newer = folder.joinpath(*parts[parts.index("glibc-hwcaps"):])
        newer.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(library, newer)
        library = library.parents[2] / library.name
    shutil.copy(library, folder / library.name)


def _metadata(tag):
    metadata = (f"Metadata-Version: 2.1\nName: pcl_als\nVersion: {_version()}\n"
                "Summary: Airborne LiDAR calibration and quality control for the Point Cloud Library\n"
                "License: BSD-3-Clause\nRequires-Python: >=3.9\nRequires-Dist: numpy\n")
    wheel = f"Wheel-Version: 1.0\nGenerator: pcl_als\nRoot-Is-Purelib: false\nTag: {tag}\n"
    return {"METADATA": metadata, "WHEEL": wheel, "LICENSE": (ROOT / "LICENSE").read_text(encoding="utf-8")}


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-" + re.sub(r"[-.]", "_", sysconfig.get_platform())


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"pcl_als-{_version()}.dist-info"
    folder.mkdir()
    for file, text in _metadata(_tag()).items():
        (folder / file).write_text(text, encoding="utf-8")
    return folder.name


def _write_wheel(path, files, texts):
    """A wheel (PEP 427) of files, by their name in it, and of the texts of its dist-info folder."""
    info = f"pcl_als-{_version()}.dist-info"
    entries = [(name, file.read_bytes(), file.stat().st_mode) for name, file in sorted(files.items())]
    entries += [(f"{info}/{name}", text.encode("utf-8"), 0o100644) for name, text in texts.items()]
    record = ""
    for name, content, _ in entries:
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode("ascii")
        record += f"{name},sha256={digest},{len(content)}\n"
    entries.append((f"{info}/RECORD", (record + f"{info}/RECORD,,\n").encode("utf-8"), 0o100644))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, content, mode in entries:
            entry = zipfile.ZipInfo(name)
            entry.external_attr = mode << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    given = (config_settings or {}).get("build-dir")
    name = f"pcl_als-{_version()}-{_tag()}.whl"
    # Beside other builds, where ccache finds their objects.
    beside = ROOT if os.access(ROOT, os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix="build-wheel-", dir=beside) as temporary:
        folder = pathlib.Path(temporary).resolve()
        build = (ROOT / given).resolve() if given else folder
        _build(build, given)
        package = _stage(build, folder / "stage")
        files = {f"pcl_als/{path.relative_to(package)}": path for path in package.rglob("*") if path.is_file()}
        _write_wheel(os.path.join(wheel_directory, name), files, _metadata(_tag()))
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the sources of the package are those of the whole project")


def get_requires_for_build_wheel(config_settings=None):
    return []
