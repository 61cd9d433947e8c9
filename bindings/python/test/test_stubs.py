"""The type stubs name what the package has, no more and no less."""

import ast
import pathlib

import asperity


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_stubs_name_what_there_is():
    stub = ast.parse((pathlib.Path(asperity.__file__).parent / "__init__.pyi").read_text())
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    assert public(asperity.__all__) == functions | set(classes)
    for name, node in classes.items():
        if name == "Error":
            continue
        stubbed = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        stubbed |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
        assert public(stubbed) == public(vars(getattr(asperity, name))), name


def test_everything_says_what_it_is():
    for name in asperity.__all__:
        if name != "__version__":
            assert getattr(asperity, name).__doc__, name
