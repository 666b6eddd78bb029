"""How a study is getting on, on standard error: a table that stays in place, or a line now and then."""

import os
import sys
import time

LINES_EVERY = 10.0
FRAMES_EVERY = 0.2


class Table:
    """Counts, speed, what is left, and the figures of the last runs."""

    def __init__(self, total, done, names, units, out=sys.stderr):
        self.total, self.done, self.reused = total, done, done
        self.names, self.units, self.out = names, units, out
        self.failed, self.last, self.reasons = 0, [], {}
        self.is_live = out.isatty() and os.environ.get("TERM", "dumb") != "dumb"
        self.began = time.monotonic()
        self.shown, self.height = 0.0, 0
        if done:
            self._print(f"{done} runs are done already\n")

    def add(self, record):
        self.done += 1
        if record["status"] == "completed":
            self.last = [*self.last[-4:], record]
        else:
            self.failed += 1
            reason = record.get("error", "")
            self.reasons[reason] = self.reasons.get(reason, 0) + 1
        now = time.monotonic()
        if now - self.shown > (FRAMES_EVERY if self.is_live else LINES_EVERY):
            self.shown = now
            self.show()

    def line(self):
        elapsed = max(time.monotonic() - self.began, 1e-6)
        rate = (self.done - self.reused) / elapsed
        text = f"{self.done}{f'/{self.total}' if self.total else ''} runs, {rate:.3g} per second"
        if self.failed:
            text += f", {self.failed} failed"
        if self.total and rate > 0 and self.done < self.total:
            text += f", {(self.total - self.done) / rate:.0f} s left"
        return text

    def show(self):
        if not self.is_live:
            self._print(self.line() + "\n")
            return
        rows = [self.line()]
        for record in self.last:
            values = ", ".join(text for _, text in record["values"])
            figures = []
            for name in self.names[:3]:
                unit = self.units.get(name, {"si": 1, "unit": ""})
                value = record["figures"].get(name)
                figures.append("-" if value is None else f"{name.split('.')[-1]} {value / unit['si']:.4g} {unit['unit']}")
            rows.append(f"  {values}: {', '.join(figures)}")
        width = os.get_terminal_size(self.out.fileno()).columns
        erase = f"\x1b[{self.height}A" if self.height else ""
        self._print(erase + "".join(f"\x1b[2K{row[:width - 1]}\n" for row in rows))
        self.height = len(rows)

    def close(self):
        if self.done > self.reused:
            self.show()
        for reason, count in sorted(self.reasons.items(), key=lambda item: -item[1])[:10]:
            self._print(f"failed, {count} run{'s' if count > 1 else ''}: {reason}\n")

    def _print(self, text):
        try:
            self.out.write(text)
            self.out.flush()
        except OSError:
            pass  # nobody reads it; the folder is the truth
