# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=sh
# What the programs of the bundle need in the environment; read by run.sh, or, in the
# bundle's folder, by hand: . ./setup.sh

bundle=${bundle:-$PWD}
LD_LIBRARY_PATH=$bundle/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export LD_LIBRARY_PATH
# the machine's own C++ library, unless it is too old for the programs
if ! "$bundle/bin/pcl_kss_icp" --version > /dev/null 2>&1; then
  LD_LIBRARY_PATH=$bundle/lib/fallback:$LD_LIBRARY_PATH
fi
# containers with a GPU may have its driver and no file that names it
if [ -z "$OCL_ICD_VENDORS" ] && ! ls /etc/OpenCL/vendors/*.icd > /dev/null 2>&1 &&
   ldconfig -p 2> /dev/null | grep -q libnvidia-opencl.so.1; then
  OCL_ICD_VENDORS=libnvidia-opencl.so.1
  export OCL_ICD_VENDORS
fi
