# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The package where cmake --install and pip put it."""
import importlib.util
import os
import re
import shutil
import site
import subprocess
import sys
import unittest

from support import STRIPS, TRAJECTORY, FolderTest

BUILD = os.environ["PCL_ALS_BUILD"]
ROOT = os.environ["PCL_ALS_ROOT"]
PYTHON_DIR = os.environ["PCL_ALS_PYTHON_DIR"]
# A job, and the folders of the package and of the libraries that are loaded.
PROGRAM = """
import os, sys, pcl_als
settings = pcl_als.CalibrationSettings(candidates=5000, estimate=["boresight_roll"])
pcl_als.calibrate(sys.argv[2:], sys.argv[1], settings=settings)
with open("/proc/self/maps") as maps:
    loaded = {line.split(maxsplit=5)[5].strip() for line in maps if "libpcl_als" in line}
print(os.path.dirname(pcl_als.__file__))
print(*sorted({os.path.dirname(path).split("/glibc-hwcaps/")[0] for path in loaded}), sep="\\n")
"""


def clean_environment(**more):
    kept = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "LD_LIBRARY_PATH")}
    return {**kept, **more}


def machine_without_index():
    """Nothing is downloaded, no setting of this machine's pip is used, and python3 is that of the build."""
    kept = {name: value for name, value in clean_environment().items() if not name.startswith("PIP_")}
    return {**kept, "PATH": os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"], "PIP_NO_INDEX": "1",
            "PIP_CONFIG_FILE": os.devnull}


class InstallTest(FolderTest):
    def folders(self, python, **environment):
        done = subprocess.run([python, "-c", PROGRAM, TRAJECTORY, *STRIPS[:2]], capture_output=True, text=True,
                              env=clean_environment(**environment))
        self.assertEqual(done.returncode, 0, done.stderr)
        return [os.path.relpath(os.path.realpath(path)) for path in done.stdout.splitlines()]

    @unittest.skipUnless(sys.executable == "/usr/bin/python3", "SKIPPED: not Debian's python3")
    def test_debian_finds_the_folder_below_its_prefixes(self):
        for prefix in ("/usr", "/usr/local"):
            self.assertIn(os.path.join(prefix, PYTHON_DIR), site.getsitepackages())

    def test_cmake_install(self):
        for component in ("python", "libraries"):
            subprocess.run(["cmake", "--install", BUILD, "--prefix", "first", "--component", component],
                           check=True, stdout=subprocess.DEVNULL)
        os.rename("first", "moved prefix")
        package, libraries = self.folders(sys.executable, PYTHONPATH=os.path.abspath("moved prefix/" + PYTHON_DIR))
        self.assertEqual(package, f"moved prefix/{PYTHON_DIR}/pcl_als")
        self.assertTrue(libraries.startswith("moved prefix/lib"))
        names = os.listdir(package)
        self.assertTrue({"__init__.py", "__init__.pyi", "py.typed"} <= set(names), names)

    @unittest.skipUnless(importlib.util.find_spec("ensurepip"), "SKIPPED: no python3-venv")
    def test_the_documented_commands_install_into_a_virtual_environment(self):
        with open(os.path.join(ROOT, "modules/python/README.md"), encoding="utf-8") as page:
            blocks = re.findall(r"^```sh\n(.*?)^```$", page.read(), re.MULTILINE | re.DOTALL)
        blocks = [block for block in blocks if "pip install" in block]
        self.assertEqual(len(blocks), 2)
        for name in ("CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md",
                     "HOWTORELEASE.md", "SECURITY.md"):
            shutil.copy(os.path.join(ROOT, name), name)
        for name in ("apps", "modules", "share"):
            shutil.copytree(os.path.join(ROOT, name), name)
        os.symlink(BUILD, "build")
        for block in blocks:
            done = subprocess.run(["sh", "-e", "-c", block], capture_output=True, text=True, env=machine_without_index())
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("Successfully installed pcl_als", done.stdout.replace("pcl-als", "pcl_als"))
            package, libraries = self.folders("venv/bin/python")
            self.assertTrue(package.startswith("venv/lib/python3"), package)
            self.assertEqual(libraries, package)
        shown = subprocess.run(["venv/bin/pip", "show", "--files", "pcl_als"], capture_output=True, text=True).stdout
        self.assertIn("License: BSD-3-Clause", shown)
        self.assertIn("pcl_als/__init__.pyi", shown)
        self.assertEqual([name for name in os.listdir(".") if name.startswith("build-")], [])
        self.assertFalse(os.path.exists("modules/python/build"))


if __name__ == "__main__":
    unittest.main()
