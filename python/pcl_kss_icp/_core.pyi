# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

version: str

def settings_table() -> List[Tuple[str, Union[bool, int, float, str], str, str]]: ...
def take_warnings() -> List[str]: ...
def device_names() -> List[str]:
    """The names of all OpenCL devices of this machine, as "device (platform)"."""

class Registration:
    def __init__(self, settings: Mapping[str, object], iterations: int) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, *raised: object) -> None: ...
    def align(
        self,
        source: NDArray[np.float64],
        source_normals: NDArray[np.float32],
        target: NDArray[np.float64],
        target_normals: NDArray[np.float32],
        guess: Optional[NDArray[np.float64]],
        progress: Optional[Callable[[str, float], object]],
    ) -> Dict[str, Any]: ...
    def cancel(self) -> None: ...
