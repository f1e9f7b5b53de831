# SPDX-License-Identifier: BSD-3-Clause
"""Registers two point clouds of one object without an initial guess, whatever their
positions, rotations, scales, densities and noise, complete or not.

    import pcl_kss_icp
    result = pcl_kss_icp.register(source, target)
    if result:
        placed = result @ source

Clouds are arrays of N x 3 numbers, N x 6 with normals, or objects of Open3D or trimesh:
see register(). `python -m pcl_kss_icp --help` does the same with files.
"""
from ._core import device_names, version as __version__
from ._registration import SETTINGS, Registration, Setting, register
from ._result import Alternative, Result

__all__ = ["SETTINGS", "Alternative", "Registration", "Result", "Setting", "__version__",
           "device_names", "register"]
