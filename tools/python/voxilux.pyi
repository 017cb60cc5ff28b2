"""Type hints of the module voxilux; docs/python.md shows how to use it."""

from os import PathLike
from typing import Any, TypedDict, Union

from numpy import float32, uint8
from numpy.typing import NDArray

Path = Union[str, PathLike[str]]
Channels = dict[str, NDArray[Any]]
Report = dict[str, Any]

class Error(RuntimeError):
    code: int

class _Voxels(TypedDict):
    voxels: NDArray[uint8]

class Voxels(_Voxels, total=False):
    palette: NDArray[uint8]
    low: tuple[int, int, int]
    materials: dict[int, dict[str, str]]

Picture = Union[Path, NDArray[float32], Channels]

def render(scene: Union[Path, Voxels], **flags: Any) -> tuple[Channels, Report]: ...
def voxelize(mesh: Path, **flags: Any) -> tuple[Voxels, Report]: ...
def compare(ref: Picture, test: Picture, *, mask: Union[Picture, None] = None,
            box: Union[tuple[int, int, int, int], None] = None) -> dict[str, Any]: ...
def read_vox(path: Path) -> Voxels: ...
def write_vox(path: Path, voxels: Voxels) -> None: ...
