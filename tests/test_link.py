"""Assembled sources made one: what they share once, what differs by number."""

from lightbench.assemble import UNIFORM, Source
from lightbench.link import link

HEAD = "#version 300 es\nprecision highp float;\n"
MAIN = "void main() {\n    light_0();\n}\n"


def source(text: str, name: str = "main") -> Source:
    """A source whose lines say that they are of a file `name`."""
    whole = HEAD + text
    lines = tuple(f"{name}:{number}" for number in range(1, whole.count("\n") + 1))
    uniforms = {given: kind for kind, given in UNIFORM.findall(whole)}
    return Source(whole, lines, (name, "lib"), (f"set_{name}", "set"), uniforms, {}, ())


def linked(*parts: str, main: str = MAIN, variables: tuple[str, ...] = ()) -> Source:
    made = [source(part, f"part{i}") for i, part in enumerate(parts)]
    return link(made, "light", source(main), variables)


def light(call: str) -> str:
    return f"float light() {{\n    return {call};\n}}\n"


def test_entries_are_numbered_and_stand_before_the_rest() -> None:
    found = linked(light("1.0"), light("2.0"))
    assert found.text == (
        HEAD
        + "float light_0() {\n    return 1.0;\n}\n"
        + "float light_1() {\n    return 2.0;\n}\n"
        + MAIN
    )


def test_entries_that_are_alike_are_two_all_the_same() -> None:
    found = linked(light("1.0"), light("1.0")).text
    assert found.count("float light_0()") == found.count("float light_1()") == 1


def test_what_is_shared_is_there_once() -> None:
    shared = "const float HALF = 0.5;\nfloat half(float x) {\n    return HALF * x;\n}\n"
    found = linked(shared + light("half(1.0)"), shared + light("half(2.0)"), main=shared + MAIN)
    assert found.text.count(shared) == 1
    assert found.text.index(shared) < found.text.index("light_0")
    assert "half_1" not in found.text


def test_what_differs_gets_the_number_of_its_part_and_what_mentions_it_follows() -> None:
    twice = "float twice(float x) {\n    return 2.0 * one(x);\n}\n"
    first, second = (f"float one(float x) {{\n    return {v};\n}}\n{twice}" for v in ("x", "-x"))
    found = linked(first + light("twice(1.0)"), second + light("twice(1.0)")).text
    assert first in found
    assert second.replace("one", "one_1").replace("twice", "twice_1") in found
    assert "float light_1() {\n    return twice_1(1.0);\n}\n" in found


def test_structs_defines_and_constants_that_differ_get_numbers_too() -> None:
    def part(size: int, fields: str) -> str:
        define = f"#define SIZE {size}\n"
        constant = f"const float WIDE = {size}.0;\n"
        return define + constant + f"struct M {{\n{fields}}};\n" + light("WIDE * float(SIZE)")

    found = linked(part(1, "    float a;\n"), part(2, "    float b;\n")).text
    for name in ("#define SIZE ", "const float WIDE ", "struct M "):
        assert found.count(name) == 1
    assert "#define SIZE_1 2\nconst float WIDE_1 = 2.0;\nstruct M_1 {\n    float b;\n};\n" in found
    assert "return WIDE_1 * float(SIZE_1);" in found


def test_what_main_means_otherwise_is_numbered_in_every_part() -> None:
    parts = [f"float own() {{\n    return {i}.0;\n}}\n" + light("own()") for i in (1, 2)]
    found = linked(*parts, main="float own() {\n    return 0.0;\n}\n" + MAIN).text
    assert [found.count(f"float own{n}()") for n in ("", "_0", "_1")] == [1, 1, 1]
    assert "    return own_0();" in found


def of(kind: str, value: str) -> str:
    return f"float of({kind} x) {{\n    return {value};\n}}\n"


def test_overloads_that_are_alike_keep_their_name() -> None:
    """A part may have one more: what it shares is called as before."""
    found = linked(
        of("float", "x") + light("of(1.0)"),
        of("float", "x") + of("vec3", "of(x.x)") + light("of(1.0) + of(vec3(1.0))"),
    ).text
    assert found.count(of("float", "x")) == found.count(of("vec3", "of(x.x)")) == 1
    assert "return of(1.0) + of(vec3(1.0));" in found


def test_overloads_of_which_one_differs_all_get_the_number() -> None:
    first = of("float", "x") + of("vec3", "x.x")
    second = of("float", "x") + of("vec3", "x.y")
    found = linked(first + light("of(1.0)"), second + light("of(1.0)")).text
    assert first in found
    assert second.replace("of(", "of_1(") in found
    assert "float light_1() {\n    return of_1(1.0);\n}\n" in found


def test_a_struct_follows_a_function_that_is_called_as_its_field() -> None:
    def part(value: str) -> str:
        struct = "struct M {\n    float tint;\n};\n"
        return struct + f"float tint(M m) {{\n    return {value};\n}}\n" + light("tint(M(1.0))")

    found = linked(part("m.tint"), part("-m.tint")).text
    assert part("m.tint").split("float light")[0] in found
    assert (
        "struct M_1 {\n    float tint_1;\n};\nfloat tint_1(M_1 m) {\n    return -m.tint_1;" in found
    )


def test_uniforms_that_main_sets_become_variables() -> None:
    both = "uniform float u_rough;\nuniform highp sampler2D u_map;\n"
    part = both + light("u_rough")
    main = both + "void main() {\n    u_rough = light_0();\n}\n"
    found = linked(part, part, main=main, variables=("u_rough",))
    assert found.text.count("float u_rough;\n") == 1
    assert "uniform float u_rough" not in found.text
    assert found.uniforms == {"u_map": "sampler2D"}


def test_every_line_says_where_it_is_from() -> None:
    found = linked(light("1.0"), light("2.0"))
    texts = found.text.splitlines()
    assert len(texts) == len(found.lines)
    where = dict(zip(texts, found.lines, strict=True))
    assert where["#version 300 es"] == "main:1"
    assert where["    return 1.0;"] == "part0:4"
    assert where["    return 2.0;"] == "part1:4"
    assert where["    light_0();"] == "main:4"


def test_files_and_settings_are_those_of_all_each_once() -> None:
    found = linked(light("1.0"), light("2.0"))
    assert found.files == ("part0", "lib", "part1", "main")
    assert found.settings == ("set_part0", "set", "set_part1", "set_main")
