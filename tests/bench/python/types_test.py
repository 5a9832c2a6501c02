"""native.pyi and the annotations describe exactly what the module has."""

import ast
import inspect
from pathlib import Path

import broadside
from broadside import native


def declared():
    """Name -> names of its members, of native.pyi; a function has none."""
    tree = ast.parse((Path(broadside.__file__).parent / "native.pyi").read_text(encoding="utf-8"))
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = set()
    return found


def test_the_types_file_names_what_the_module_has_and_nothing_else():
    theirs = {name for name in vars(native) if not name.startswith("_")}
    assert set(declared()) == theirs
    for name, members in declared().items():
        has = getattr(native, name)
        if inspect.isclass(has):
            own = {member for member in vars(has) if not member.startswith("_") or member == "__len__"}
            assert members - {"__init__"} == own, name


def test_what_users_call_has_types_and_a_docstring():
    for name in broadside.__all__:
        has = getattr(broadside, name)
        assert inspect.getdoc(has), name
        if inspect.isfunction(has) and name != "engine":
            signature = inspect.signature(has)
            assert signature.return_annotation is not inspect.Signature.empty, name
            assert all(p.annotation is not p.empty for p in signature.parameters.values()), name
        if inspect.isclass(has) and not issubclass(has, Exception) and has is not native.Scene:
            for member, method in vars(has).items():
                if not member.startswith("_") and inspect.isfunction(method):
                    assert inspect.getdoc(method), f"{name}.{member}"
                    assert method.__annotations__.get("return"), f"{name}.{member}"
    assert (Path(broadside.__file__).parent / "py.typed").is_file()
