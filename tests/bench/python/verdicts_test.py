"""check: the verdicts of the command line, as values."""

import math
import xml.etree.ElementTree as xml
from html.parser import HTMLParser

import pytest

import broadside


def test_values_are_those_of_the_command_line(falling, too_heavy, tmp_path):
    for trace, code in ((falling, 0), (too_heavy, 1)):
        answer = broadside.program.call("check", trace.path, "--json", tmp_path / "theirs.json", passes=(0, 1))
        verdicts = broadside.check(trace)
        verdicts.save(tmp_path / "ours.json")
        assert (tmp_path / "ours.json").read_bytes() == (tmp_path / "theirs.json").read_bytes()
        assert answer.exit_code == verdicts.exit_code == code
        assert answer.text.strip() == str(verdicts).strip()


def test_one_law_and_unknown_laws(falling):
    only = broadside.check(falling, laws=["ballistic"])
    assert [v.law for v in only] == ["ballistic"] and only.ok
    with pytest.raises(broadside.BadInput, match="did you mean 'ballistic'?"):
        broadside.check(falling, laws=["balistic"])
    with pytest.raises(KeyError, match="momentum"):
        only["momentum"]
    assert {"ballistic", "momentum"} <= {law["name"] for law in broadside.laws()}


def test_nothing_judged_is_not_good(falling):
    unjudged = broadside.check(falling, laws=["contraction"])
    assert unjudged.exit_code == 3 and not unjudged.ok
    with pytest.raises(broadside.Missing, match="no law was judged"):
        unjudged.require()


def test_a_broken_law_is_an_exception_with_its_line(falling, too_heavy):
    assert broadside.check(falling).require().ok
    with pytest.raises(broadside.LawBroken) as caught:
        broadside.check(too_heavy).require()
    assert caught.value.exit_code == 1
    assert "g h + F h / m = -0.125 m/s" in str(caught.value)


def test_several_traces(falling, too_heavy):
    both = broadside.check([falling, too_heavy.path])
    assert both.exit_code == 1
    assert len(both) == 2 * len(broadside.check(falling))


class Cells(HTMLParser):
    """Every open tag is closed; the text of each cell, and other text."""

    def __init__(self):
        super().__init__()
        self.open, self.cells, self.texts = [], [], []

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        if tag in ("td", "th"):
            self.cells.append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open[-1] in ("td", "th", "b", "i") and "table" in self.open:
            self.cells[-1] += data
        else:
            self.texts.append(data)


def test_html_for_notebooks(too_heavy):
    page = Cells()
    page.feed(broadside.check(too_heavy)._repr_html_())
    assert page.open == []
    at = page.cells.index("ballistic")
    assert page.cells[at + 1:at + 3] == ["fail", "0.0312 m/s"]
    assert page.cells[at + 4] == "step 1, bodies 0"
    assert "g h + F h / m = -0.125 m/s" in page.cells[at + 5], "a broken law shows the numbers that went in"
    said = "".join(page.texts)
    assert "heavy on falling: 2 broken, " in said and " do not apply" in said
    assert "color:" not in broadside.check(too_heavy)._repr_html_(), "text has the page's color, light or dark"


def test_files(too_heavy, tmp_path):
    verdicts = broadside.check(too_heavy)
    verdicts.junit(tmp_path / "junit.xml")
    cases = xml.parse(tmp_path / "junit.xml").iter("testcase")
    failures = [case for case in cases if case.find("failure") is not None]
    assert len(failures) == len(verdicts.failed)
    verdicts.page(tmp_path / "page.html", title="Too heavy")
    assert "Too heavy" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_numbers_are_finite_or_said(falling):
    for verdict in broadside.check(falling):
        assert verdict.outcome in ("pass", "fail", "inconclusive", "not applicable")
        assert verdict.origin if verdict.outcome == "pass" else verdict.explanation
        assert not math.isnan(verdict.limit) or verdict.outcome == "not applicable"
