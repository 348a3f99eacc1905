"""Several assembled sources made one, as a linker does it: what they share is there once.

GLSL ES compiles a stage from one text. Each part is whole by itself; a name that means something
else in another part gets the part's number.
"""

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

from lightbench.assemble import UNIFORM, Source

__all__ = ["link"]

# The lines of a declaration, and where each comes from.
Block = list[tuple[str, str]]
# The texts of every name, and of each of a function's signatures.
Meanings = dict[tuple[str, str], set[str]]

_NAME = re.compile(r"[A-Za-z_]\w*")
# The name that a declaration gives: of a macro, a struct, a function or a variable.
_GIVEN = re.compile(
    r"#define (\w+)|struct (\w+)"
    r"|(?:(?:const|uniform|out|in) )?(?:(?:high|medium|low)p )?\w+ (\w+)\s*[(;=\[]"
)
_HEAD = ("#version", "precision")


def link(parts: Sequence[Source], entry: str, main: Source, variables: Collection[str]) -> Source:
    """`parts` before `main`; the function `entry` of part i is called `entry`_i there.

    Uniforms that `variables` names become variables, which `main` sets.
    """
    head = [block for block in _blocks(main) if block[0][0].startswith(_HEAD)]
    own = _declared(main, variables)
    meanings: Meanings = {}
    _note(own, meanings)
    linked: dict[str, Block] = {}
    for number, part in enumerate(parts):
        blocks = _declared(part, variables)
        renamed = _renames(blocks, meanings, entry, number)
        made = [_renamed(block, renamed) for block in blocks]
        linked |= {_text(block): block for block in made if _text(block) not in linked}
        _note(made, meanings)
    linked |= {_text(block): block for block in own if _text(block) not in linked}
    lines = [line for block in (*head, *linked.values()) for line in block]
    text = "\n".join([*(text for text, _ in lines), ""])
    sources = (*parts, main)
    return replace(
        main,
        text=text,
        lines=tuple(where for _, where in lines),
        files=tuple(dict.fromkeys(file for source in sources for file in source.files)),
        settings=tuple(dict.fromkeys(s for source in sources for s in source.settings)),
        uniforms={name: kind for kind, name in UNIFORM.findall(text)},
    )


def _renames(blocks: list[Block], meanings: Meanings, entry: str, number: int) -> dict[str, str]:
    """New names for what means something else already, and so for all that mentions it."""
    renamed = {entry: f"{entry}_{number}"}
    while True:
        before = len(renamed)
        for block in blocks:
            name, signature = _given(block)
            known = meanings.get((name, signature))
            if name not in renamed and known and _text(_renamed(block, renamed)) not in known:
                renamed[name] = f"{name}_{number}"
        if len(renamed) == before:
            return renamed


def _note(blocks: list[Block], meanings: Meanings) -> None:
    for block in blocks:
        meanings.setdefault(_given(block), set()).add(_text(block))


def _declared(source: Source, variables: Collection[str]) -> list[Block]:
    """The declarations of a source but its head, some of its uniforms as variables."""
    blocks = [block for block in _blocks(source) if not block[0][0].startswith(_HEAD)]
    return [_with_variables(block, variables) for block in blocks]


def _blocks(source: Source) -> list[Block]:
    """The declarations of a source: each up to where no bracket is open and a statement ends."""
    blocks: list[Block] = [[]]
    depth = 0
    for text, where in zip(source.text.splitlines(), source.lines, strict=False):
        blocks[-1].append((text, where))
        depth += sum(text.count(c) for c in "{(") - sum(text.count(c) for c in "})")
        if depth == 0 and (text.startswith("#") or text.rstrip().endswith((";", "}"))):
            blocks.append([])
    return [block for block in blocks if block]


def _text(block: Block) -> str:
    return "\n".join(text for text, _ in block)


def _given(block: Block) -> tuple[str, str]:
    """The name that a declaration gives and, of a function, the types that it takes."""
    text = " ".join(text for text, _ in block)
    match = _GIVEN.match(text)
    assert match is not None, block[0]
    name = next(name for name in match.groups() if name)
    if not match[0].endswith("("):
        return name, ""
    arguments = text[match.end() : text.index(")")].split(",")
    return name, ",".join(argument.strip().rpartition(" ")[0] for argument in arguments)


def _renamed(block: Block, names: dict[str, str]) -> Block:
    return [(_NAME.sub(lambda m: names.get(m[0], m[0]), text), where) for text, where in block]


def _with_variables(block: Block, variables: Collection[str]) -> Block:
    text, where = block[0]
    if text.startswith("uniform ") and _given(block)[0] in variables:
        return [(text.removeprefix("uniform "), where)]
    return block
