"""check: every law that applies to a trace, with its limit and where the limit comes from."""

from __future__ import annotations

import html
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from . import native
from .errors import error_of


@dataclass(frozen=True)
class Verdict:
    """What one law found. outcome: pass, fail, inconclusive or not applicable."""

    law: str
    outcome: str
    measured: float  # the worst value, in `unit`
    limit: float  # what it may be at most, or at least: the origin says
    unit: str
    origin: str  # where the limit comes from
    explanation: str  # what was checked, or what failed, or why the law does not apply
    says: str  # what holds, in a sentence
    kind: str  # trace, method or mechanics
    step: int | None  # where it was worst
    bodies: tuple  # faces of the domain as 0xFFFFFFF0 + k
    field: str
    checked: int  # how many things were judged
    violations: int
    baseline: str  # label of the trace that this was judged against; empty = alone
    parts: tuple = field(default=())

    def __bool__(self) -> bool:
        """True where the law was not broken and not in doubt."""
        return self.outcome in ("pass", "not applicable")


def _verdict(facts):
    return Verdict(**{**facts, "parts": tuple(_verdict(part) for part in facts["parts"])})


class Verdicts(Sequence[Verdict]):
    """The verdicts of one or more traces. verdicts["ballistic"] is that of a law, verdicts[k] the k-th.

    str() is the table that the command line prints; in a notebook it is a table of HTML.
    """

    def __init__(self, judgements):
        self._judgements = judgements
        self._all = [_verdict(facts) for judgement in judgements for facts in judgement.verdicts()]

    def __len__(self) -> int:
        return len(self._all)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            named = [verdict for verdict in self._all if verdict.law == key]
            if not named:
                raise KeyError(f"no verdict of '{key}'; broadside.laws() names the laws")
            return named[0]
        return self._all[key]

    @property
    def exit_code(self) -> int:
        """0 good; 1 a law is broken; 3 inconclusive, or nothing was judged. As `broadside check` exits."""
        codes = {judgement.exit_code for judgement in self._judgements}
        return next(code for code in (1, 3, 0) if code in codes or code == 0)

    @property
    def ok(self) -> bool:
        """Whether laws were judged and every one of them holds."""
        return self.exit_code == 0

    @property
    def failed(self) -> list[Verdict]:
        """The verdicts of broken laws."""
        return [verdict for verdict in self._all if verdict.outcome == "fail"]

    @property
    def lines(self) -> str:
        """For each broken or inconclusive law a line: what was measured, the limit, where, and the limit's origin."""
        return native.failure_lines(self._judgements)

    def table(self) -> str:
        """The table for a terminal of 100 columns."""
        return native.verdict_table(self._judgements)

    def require(self) -> Verdicts:
        """Self; LawBroken, or Missing where nothing could be said, with the lines as text."""
        if not self.ok:
            raise error_of(self.lines.strip() or f"{self._judgements[0].trace_file}: no law was judged; "
                           "see why in the table of broadside.check", self.exit_code)
        return self

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the rows as JSON, as `broadside report` reads them: a folder's verdicts.json."""
        native.write_verdicts(os.fspath(path), self._judgements)

    def junit(self, path: str | os.PathLike[str]) -> None:
        """Writes JUnit XML."""
        native.write_junit(os.fspath(path), self._judgements)

    def page(self, path: str | os.PathLike[str], title: str = "", command: str = "") -> None:
        """Writes the report of these verdicts, one HTML file that needs no network."""
        native.write_page(self._judgements, os.fspath(path), title, command)

    def __str__(self) -> str:
        lines = self.lines
        return self.table() + ("\n" + lines if lines else "")

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = []
        for judgement in self._judgements:
            rows.append(f'<tr><th colspan="6" style="text-align:left">{html.escape(judgement.label)} on '
                        f"{html.escape(judgement.scene)}</th></tr>")
            rows += [_html_row(_verdict(facts)) for facts in judgement.verdicts()]
        head = "".join(f"<th>{name}</th>" for name in ("law", "outcome", "measured", "limit", "where", "why"))
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _number(value, unit):
    text = "" if math.isnan(value) else f"{value:.3g}"
    return html.escape(f"{text} {unit}".strip())


def _html_row(verdict):
    weight = "font-weight:bold" if verdict.outcome in ("fail", "inconclusive") else ""
    judged = verdict.outcome != "not applicable"
    where = [] if verdict.step is None else [f"step {verdict.step}"]
    where += [f"bodies {', '.join(map(str, verdict.bodies))}"] if verdict.bodies else []
    cells = (html.escape(verdict.law), verdict.outcome, _number(verdict.measured, verdict.unit) if judged else "",
             _number(verdict.limit, verdict.unit) if judged else "", ", ".join(where),
             html.escape(verdict.origin if judged else verdict.explanation))
    return f'<tr style="{weight}">' + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def check(traces: Any, laws: Sequence[str] = (), against: Any = None) -> Verdicts:
    """Judges a trace, or several, each a Trace or a path. laws: names of those to judge; () = all that apply.

    against: a second trace of the same scene, for the laws that compare two.
    """
    many = traces if isinstance(traces, (list, tuple)) else [traces]
    baseline = "" if against is None else _path(against)
    return Verdicts([native.judge(_path(trace), baseline, list(laws)) for trace in many])


def _path(trace):
    return os.fspath(getattr(trace, "path", trace))


def laws() -> list[dict[str, str]]:
    """Every law: name, what it says, what it must reject, and its kind."""
    return native.laws()
