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
        tables = [_html_table(judgement, [_verdict(facts) for facts in judgement.verdicts()])
                  for judgement in self._judgements]
        return "<div>" + "".join(tables) + "</div>"


FIRST_FACE = 0xFFFFFFF0  # faces of the domain are bodies from here on

# Rows are tinted and no text has a color of its own, so that the table is read on light pages and on dark ones.
_TINTS = {"pass": "rgba(0,150,70,.10)", "fail": "rgba(225,30,30,.20)", "inconclusive": "rgba(235,160,0,.20)"}
_CELL = 'style="text-align:left;vertical-align:top;padding:2px 8px"'
_SHORT = _CELL[:-1] + ';white-space:nowrap"'


def _html_table(judgement, verdicts):
    judged = [verdict for verdict in verdicts if verdict.outcome in _TINTS]
    counts = [(sum(v.outcome == outcome for v in judged), word)
              for outcome, word in (("fail", "broken"), ("inconclusive", "in doubt"), ("pass", "kept"))]
    said = ", ".join(f"{count} {word}" for count, word in counts if count) or "no law was judged"
    title = f"<b>{html.escape(judgement.label)}</b> on {html.escape(judgement.scene)}: {said}"
    head = "".join(f"<th {_CELL}>{name}</th>" for name in ("law", "outcome", "measured", "limit", "where", "why"))
    rows = "".join(_html_row(verdict) for verdict in judged)
    table = f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>" if judged else ""
    return f"<p>{title}</p>{table}{_html_rest([v for v in verdicts if v.outcome not in _TINTS])}"


def _html_rest(verdicts):
    """Laws that do not apply, folded."""
    if not verdicts:
        return ""
    lines = "".join(f"<li>{html.escape(v.law)}: {html.escape(v.explanation)}</li>" for v in verdicts)
    what = "law does" if len(verdicts) == 1 else "laws do"
    return f"<details><summary>{len(verdicts)} {what} not apply</summary><ul>{lines}</ul></details>"


def _number(value, unit):
    text = "" if math.isnan(value) else f"{value:.3g}"
    return html.escape(f"{text} {unit}".strip())


def _body(number):
    return str(number) if number < FIRST_FACE else f"face {number - FIRST_FACE}"


def _html_row(verdict):
    where = [] if verdict.step is None else [f"step {verdict.step}"]
    if verdict.bodies:
        where.append(f"bodies {', '.join(map(_body, verdict.bodies))}")
    limit = html.escape(verdict.origin)
    why = limit if verdict.outcome == "pass" else f"{html.escape(verdict.explanation)} <i>(limit: {limit})</i>"
    outcome = verdict.outcome if verdict.outcome == "pass" else f"<b>{verdict.outcome}</b>"
    short = (html.escape(verdict.law), outcome, _number(verdict.measured, verdict.unit),
             _number(verdict.limit, verdict.unit))
    cells = "".join(f"<td {_SHORT}>{cell}</td>" for cell in (*short, ", ".join(where)))
    return f'<tr style="background:{_TINTS[verdict.outcome]}">{cells}<td {_CELL}>{why}</td></tr>'


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
