"""Three rules of MISRA C:2012 that emitted and runtime C keeps, checked on the syntax tree.

13.4: the value of an assignment is not used. 14.4: what controls an if or a loop is a comparison or
a logical operation. 15.6: the body of an if or a loop stands in braces.
"""

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from pycparser import c_ast, c_parser

_BOOLEAN = {"<", ">", "<=", ">=", "==", "!=", "&&", "||"}

_FAKE = Path(__file__).with_name("programs") / "fake_library.h"
_HEADERS = tuple(
    """
    math stddef stdint string stdio stdlib stdbool stdarg limits float errno immintrin time fenv
    assert ctype
""".split()
)


def violations(folder: Path, name: str, *words: str) -> list[str]:
    """`13.4 file:line` of each place of a C file and of the headers beside it.

    Args:
        folder: with the headers.
        name: of the C file there.
        words: more for the preprocessor.
    """
    fake = folder / "fake"
    fake.mkdir(exist_ok=True)
    for header in _HEADERS:
        shutil.copy(_FAKE, fake / f"{header}.h")
    done = subprocess.run(
        [
            *"""
                gcc -E -std=c99 -nostdinc -D__attribute__(x)= -D__inline=inline
                -D__restrict=restrict -D__extension__= -D__builtin_memset(a,b,c)=memset(a,b,c)
            """.split(),
            f"-I{fake}",
            f"-I{folder}",
            *words,
            name,
        ],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    text = re.sub(r"^#pragma.*$", "", done.stdout, flags=re.M)
    text = re.sub(r"\b(__asm__|asm)\b[^;]*;", ";", text)
    tree = c_parser.CParser().parse(text, name)
    broken = [(rule, at) for rule, at in _broken(tree) if "fake" not in at.file]
    return [f"{rule} {Path(at.file).name}:{at.line}" for rule, at in broken]


def _broken(node: c_ast.Node, stands: bool = False) -> Iterator[tuple[str, object]]:
    """(rule, place); `stands` where the node is a statement, whose value nobody reads."""
    if isinstance(node, c_ast.Assignment) and not stands:
        yield "13.4", node.coord
    if isinstance(node, c_ast.If | c_ast.While | c_ast.DoWhile | c_ast.For):
        if node.cond is not None and not _boolean(node.cond):
            yield "14.4", node.cond.coord
        bodies = (node.iftrue, node.iffalse) if isinstance(node, c_ast.If) else (node.stmt,)
        for k, body in enumerate(bodies):
            chained = k == 1 and isinstance(body, c_ast.If)
            if body is not None and not chained and not isinstance(body, c_ast.Compound):
                yield "15.6", body.coord or node.coord
    if isinstance(node, c_ast.Switch) and not isinstance(node.stmt, c_ast.Compound):
        yield "15.6", node.coord
    statement = isinstance(node, c_ast.Compound | c_ast.Case | c_ast.Default | c_ast.Label)
    for role, child in node.children():
        alone = statement or role in ("stmt", "iftrue", "iffalse", "init", "next")
        alone &= not (isinstance(node, c_ast.Decl) and role == "init")
        inner = stands and isinstance(node, c_ast.ExprList)
        yield from _broken(child, alone or inner)


def _boolean(node: c_ast.Node) -> bool:
    if isinstance(node, c_ast.BinaryOp):
        return node.op in _BOOLEAN
    return isinstance(node, c_ast.UnaryOp) and node.op == "!"
