"""Names by which the numbers of a bearing are given in calls; which there are, the solver knows of every kind."""

from __future__ import annotations

from . import _core


class BearingNames:
    """Those of one bearing: short names, keys of its operating point, and its own keys.

    >>> names = BearingNames(_core.names_of_kind("plane_slider", "pad", "oil"), "pad")
    >>> names.path_of("speed"), names.path_of("viscosity"), names.path_of("width")
    ('bearings.pad.operating_point.speed', 'lubricants.oil.viscosity', 'bearings.pad.width')
    >>> names.load_or_position
    ('load', 'film_thickness')
    """

    def __init__(self, of_kind: "_core.BearingKindNames", bearing: str):
        self.kind, self.title = of_kind.kind, of_kind.title
        self.load_or_position = of_kind.load_or_position  #: of which one is given
        self._prefix = f"bearings.{bearing}."
        points = {key: f"{self._prefix}operating_point.{key}" for key in of_kind.point_keys}
        self._paths = {**points, **of_kind.paths}

    def path_of(self, name: str) -> str:
        """Key path of a name; one that is neither short nor of the operating point is the bearing's own key."""
        return self._paths.get(name, self._prefix + name)

    @property
    def known(self) -> list[str]:
        """Short names, and keys of the operating point."""
        return list(self._paths)
