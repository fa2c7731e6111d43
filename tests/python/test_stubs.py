# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""The type stubs have the names and signatures of the module."""
import ast
import inspect
import os
import subprocess
import sys
import unittest

import pcl_als

ROOT = os.environ["PCL_ALS_ROOT"]
STUBS = os.path.join(os.path.dirname(pcl_als.__file__), "__init__.pyi")


def members(node):
    """Names of the functions, classes and annotated values in a node of the stubs."""
    return {getattr(each, "name", None) or each.target.id for each in node.body
            if isinstance(each, (ast.FunctionDef, ast.ClassDef, ast.AnnAssign))}


class StubTest(unittest.TestCase):
    def setUp(self):
        with open(STUBS) as file:
            self.text = file.read()
        self.tree = ast.parse(self.text)

    def test_names(self):
        names = members(self.tree) - {"__version__", "__all__"}
        self.assertEqual(names, set(pcl_als.__all__))
        for node in self.tree.body:
            if not isinstance(node, ast.ClassDef):
                continue
            value = getattr(pcl_als, node.name)
            public = {name for name in vars(value) if not name.startswith("_")}
            found = {name for name in members(node) if not name.startswith("_")}
            self.assertEqual(found, public, node.name)

    def test_types_of_all_properties_are_known(self):
        for node in ast.walk(self.tree):
            if isinstance(node, ast.FunctionDef):
                self.assertIsNotNone(node.returns, node.name)
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(STUBS), "py.typed")))

    @unittest.skipUnless(hasattr(pcl_als, "orient"), "SKIPPED: built without Ceres Solver")
    def test_signatures_are_those_of_the_module(self):
        made = subprocess.run([sys.executable, os.path.join(ROOT, "share/dev/python_stubs.py")],
                              capture_output=True, text=True, check=True).stdout
        self.assertEqual(made, self.text, "write them anew with share/dev/python_stubs.py")

    def test_every_function_is_documented(self):
        for name in set(pcl_als.__all__) - {"POINT"}:
            self.assertTrue(inspect.getdoc(getattr(pcl_als, name)), name)


if __name__ == "__main__":
    unittest.main()
