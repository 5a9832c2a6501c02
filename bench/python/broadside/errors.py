"""Exceptions. Their text is the line that the command line prints; exit_code is what it would exit with."""


class Error(Exception):
    """Whatever Broadside refuses or cannot do."""

    exit_code = 4


class LawBroken(Error):
    """A law does not hold, or a result got worse: exit code 1."""

    exit_code = 1


class BadInput(Error, ValueError):
    """What was given is wrong; the line says where, and what to do: exit code 2."""

    exit_code = 2


class Missing(Error):
    """Inconclusive, or a result that was asked for is not there: exit code 3."""

    exit_code = 3


class Internal(Error):
    """A fault of Broadside itself, or of the disk: exit code 4."""

    exit_code = 4


def error_of(line, exit_code):
    """The exception of this exit code, with this line."""
    kinds = {kind.exit_code: kind for kind in (LawBroken, BadInput, Missing, Internal)}
    return kinds.get(exit_code, Internal)(line)
