"""What a check has found."""

import math


class Findings(list):
    """Pairs (invariant, text) of invariants that do not hold."""

    def require(self, invariant, holds, text):
        if not holds:
            self.append((invariant, text))

    def bound(self, invariant, size, allowed, text):
        """`size` must not exceed `allowed`; NaN is no size."""
        if math.isnan(size) or size > allowed:
            self.append((invariant, f"{size:.3g} (allowed {allowed:.3g}) {text}"))
