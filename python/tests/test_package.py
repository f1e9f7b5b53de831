# SPDX-License-Identifier: BSD-3-Clause
"""What is installed."""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import pytest

import pcl_kss_icp
from pcl_kss_icp import _core

FOLDER = pathlib.Path(pcl_kss_icp.__file__).parent


def test_needs_nothing_but_the_languages_own_libraries():
    listed = subprocess.run(["ldd", _core.__file__], check=True, capture_output=True,
                            text=True).stdout
    names = {pathlib.Path(line.split()[0]).name for line in listed.splitlines()}
    needed = {re.sub(r"\.so.*", "", name) for name in names}
    assert needed <= {"linux-vdso", "ld-linux-x86-64", "ld-linux-aarch64", "libOpenCL",
                      "libstdc++", "libm", "libgcc_s", "libc", "libpthread", "libdl"}
    if (FOLDER / "libOpenCL.so.1").exists():
        assert str(FOLDER / "libOpenCL.so.1") in listed
        assert "Redistribution" in (FOLDER / "libOpenCL.copyright").read_text()


def test_offers_no_symbols():
    nm = subprocess.run(["nm", "-D", "--defined-only", _core.__file__], check=True,
                        capture_output=True, text=True)
    assert [line.split()[-1] for line in nm.stdout.splitlines()] == ["PyInit__core"]


def test_imports_nothing_but_numpy():
    code = ("import sys, pcl_kss_icp; print([m for m in ('scipy', 'laspy', 'pye57', "
            "'trimesh', 'open3d', 'argparse', 'json') if m in sys.modules])")
    before = "import sys, numpy; " + code.replace("pcl_kss_icp", "numpy")
    run = [subprocess.run([sys.executable, "-c", c], check=True, capture_output=True,
                          text=True).stdout for c in (before, code)]
    assert run[0] == run[1]


def test_all_is_documented():
    for name in pcl_kss_icp.__all__:
        item = getattr(pcl_kss_icp, name)
        assert name in ("SETTINGS", "__version__") or item.__doc__, name


TYPED = """
import numpy as np
import pcl_kss_icp

result: pcl_kss_icp.Result = pcl_kss_icp.register(
    np.zeros((9, 3)), [[0.0, 1.0, 2.0]], rigid=True, scale_range=(0.5, 2.0), clean=False,
    progress=lambda stage, share: print(stage.upper(), share + 1.0))
scale: float = result.scale
placed = result @ np.zeros((9, 3))
places: float = placed.sum() + result.transformation[0, 0]
reveal_type(result.alternatives[0].score)
"""


def test_types(tmp_path):
    if not importlib.util.find_spec("mypy"):
        pytest.skip("mypy is not installed")
    assert (FOLDER / "py.typed").exists()
    environment = {**os.environ, "MYPY_CACHE_DIR": str(tmp_path)}
    own = subprocess.run([sys.executable, "-m", "mypy", "--strict", "-p", "pcl_kss_icp"],
                         capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert own.returncode == 0, own.stdout
    (tmp_path / "typed.py").write_text(TYPED)
    used = subprocess.run([sys.executable, "-m", "mypy", "--strict", "typed.py"],
                          capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert used.returncode == 0, used.stdout
    assert 'Revealed type is "float"' in used.stdout.replace("builtins.", "")
    (tmp_path / "wrong.py").write_text(TYPED.replace("rigid=True", "rigid=[]"))
    wrong = subprocess.run([sys.executable, "-m", "mypy", "--strict", "wrong.py"],
                           capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert wrong.returncode != 0 and '"rigid"' in wrong.stdout
