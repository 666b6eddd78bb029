"""Studies of a hersey model: plans, runs, statistics, optimisation, a cluster.

A study is what the section ``study`` of a model file says. Its folder is the truth: every finished run is one line of
``records.jsonl``, and whatever is missing there is what is left to do.

>>> from hersey_study import plan
>>> plan.unit_points("sobol", samples=4, dimensions=2, seed=1).shape
(4, 2)
"""

from .folder import Folder
from .study import Study, StudyError

__all__ = ["Folder", "Study", "StudyError"]
