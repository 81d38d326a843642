#!/usr/bin/python3
"""Mutation testing of rooms by their own tests.

A mutant is the program with one small fault: an operator swapped, a constant off by one, a statement
left out. If no test fails with it, the tests do not see what the operator is for, or the mutant is
the same program: what equivalent.txt says of it, with the reason.

All mutants are compiled at once: each place calls a function of mutant.hpp, which asks whether it is
the one that is wanted. A first run of each test program tells which test reaches which mutant, so
that for each mutant only those run that may notice, the quickest first.
"""

import argparse
import bisect
import collections
import concurrent.futures
import itertools
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
CALL = "::lantern::mutant::"

# Where `wide`: names of what is halved (a step), and of what stands in pairs and is taken for the other.
HALVED = {"h", "seconds", "step_seconds", "sub_step"}
PAIRED = {"a": "b", "at_a": "at_b", "arm_a": "arm_b", "body_a": "body_b", "x": "y",
          "position": "velocity", "linear": "angular", "lo": "hi", "kick": "drift"}
PAIRED |= {other: one for one, other in PAIRED.items()}

# The rooms whose tests are to notice: folders of src/ and of tests/.
ROOMS = ("geometry", "atlas", "spatial", "physics")

# One way to change one place. A place is named by (function, kind, text, occurrence): a list of
# mutants stays true when lines move, and when functions move to other files, folders and rooms.
# Occurrences are counted within one definition, so that an overload more or less changes none.
Mutant = collections.namedtuple("Mutant", "room file function kind text occurrence line edits")
# At `at`, `removed` bytes go and `text` comes. `begin` and `end` say around what, so that those that
# lie around others are opened before them and closed after them.
Edit = collections.namedtuple("Edit", "at removed text begin end closes")

BINARY = {
    "<": "less", "<=": "less_equal", ">": "greater", ">=": "greater_equal", "==": "equal",
    "!=": "unequal", "+": "plus", "-": "minus", "*": "times", "/": "over", "+=": "plus_to",
    "-=": "minus_to", "*=": "times_to", "/=": "over_to"}
SWAPPED = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+",
    "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "&&": "||", "||": "&&"}
EXTREMES = {
    "std::min": ("least", "std::max"), "std::max": ("most", "std::min"),
    "glm::min": ("least_parts", "glm::max"), "glm::max": ("most_parts", "glm::min")}


def stop(text):
    print(f"mutate: {text}", file=sys.stderr)
    sys.exit(2)


def load_clang():
    sys.path.append("/usr/lib/python3/dist-packages")  # for a python3 that is not Debian's
    try:
        from clang import cindex
    except ImportError:
        stop("packages are missing: apt-get install python3-clang-14 libclang-14-dev")
    libraries = sorted(Path("/usr/lib").glob("llvm-*/lib/libclang*.so*"))
    libraries = [p for p in libraries if re.fullmatch(r"libclang(-\d+)?\.so(\.1)?", p.name)]
    version = getattr(sys.modules.get("clang"), "__file__", "")
    same = [p for p in libraries if str(p).split("/")[3].split("-")[1] in version]
    for path in same + libraries[::-1]:
        cindex.Config.set_library_file(str(path))
        try:
            cindex.Index.create()
            return cindex
        except cindex.LibclangError:
            cindex.Config.loaded = False
    stop("the library of clang is missing: apt-get install libclang-14-dev")


class Finder:
    """All mutants of a room, from the syntax trees of its files."""

    def __init__(self, cindex, room, wide=False):
        self.ci, self.room, self.kinds, self.wide = cindex, room, cindex.CursorKind, wide
        self.folder = ROOT / "src" / room
        if not self.folder.is_dir():
            stop(f"there is no room {self.folder.relative_to(ROOT)}")
        self.files = sorted(p for p in self.folder.rglob("*") if p.suffix in (".cpp", ".hpp"))
        self.found = {}

    def run(self):
        # Headers by themselves: some are used by tests alone. Sources a few at a time, which saves
        # most of the time; those that may not be read together one by one.
        sources = [p for p in self.files if p.suffix == ".cpp"]
        headers = [p for p in self.files if p.suffix == ".hpp"]
        for chosen in [headers, *(sources[i:i + 8] for i in range(0, len(sources), 8))]:
            tu, problem = self.parsed(chosen)
            if not problem:
                self.read(tu, chosen)
                continue
            for path in chosen:
                tu, problem = self.parsed([path])
                if problem:
                    stop(f"clang does not understand {self.room}: {problem}")
                self.read(tu, [path])
        return self.named()

    def parsed(self, files):
        """The syntax tree, and the first error in our own files. One in a header of the system is
        clang's trouble with that library; our code around it is read all the same."""
        unit = "".join(f'#include "{p.relative_to(ROOT / "src").as_posix()}"\n' for p in files)
        options = self.ci.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD
        tu = self.ci.Index.create().parse(
            "all.cpp", ["-std=c++20", "-xc++", f"-I{ROOT}/src"], [("all.cpp", unit)], options)
        ours = (problem for problem in tu.diagnostics
                if problem.severity >= self.ci.Diagnostic.Error and (
                    problem.severity >= self.ci.Diagnostic.Fatal or not problem.location.file or
                    problem.location.file.name.startswith(f"{ROOT}/")))
        return tu, next(ours, None)

    def read(self, tu, files):
        self.paths = {str(p): p.relative_to(ROOT).as_posix() for p in files}
        self.tokens, self.macros = {}, collections.defaultdict(list)
        for path in files:
            file = tu.get_file(str(path))
            whole = self.ci.SourceRange.from_locations(
                self.ci.SourceLocation.from_offset(tu, file, 0),
                self.ci.SourceLocation.from_offset(tu, file, path.stat().st_size))
            self.tokens[str(path)] = [
                (t.extent.start.offset, t.extent.end.offset, t.spelling)
                for t in tu.get_tokens(extent=whole)
                if t.kind != self.ci.TokenKind.COMMENT]
        for cursor in tu.cursor.get_children():
            if not cursor.location.file or cursor.location.file.name not in self.paths:
                continue
            if cursor.kind == self.kinds.MACRO_INSTANTIATION:
                self.macros[cursor.location.file.name].append(self.span(cursor))
        for cursor in tu.cursor.get_children():
            if cursor.location.file and cursor.location.file.name in self.paths:
                self.file = cursor.location.file.name
                self.definition = None
                self.visit(cursor, [], None, ())

    # --- the tree ---

    def span(self, cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def children(self, cursor):
        return list(cursor.get_children())

    # Of a field, what it begins with is left alone: nearly all are written before they are read.
    # `above`: the kinds of the statements around; `result`: what the function around returns.
    def visit(self, cursor, names, result, above):
        k, kind = self.kinds, cursor.kind
        if not cursor.location.file or cursor.location.file.name != self.file:
            return
        if self.wide and kind == k.DECL_REF_EXPR and names and cursor.spelling in HALVED:
            begin, end = self.span(cursor)
            self.add(names, "halved", begin, end, self.around(begin, end, CALL + "halved<@>("))
        if kind in (k.STATIC_ASSERT, k.ENUM_DECL, k.TYPE_ALIAS_DECL, k.TYPEDEF_DECL, k.FRIEND_DECL,
                    k.TYPE_ALIAS_TEMPLATE_DECL, k.TEMPLATE_TYPE_PARAMETER, k.DECL_REF_EXPR,
                    k.TEMPLATE_NON_TYPE_PARAMETER, k.TEMPLATE_TEMPLATE_PARAMETER,
                    k.USING_DECLARATION, k.FIELD_DECL, k.MACRO_DEFINITION, k.MACRO_INSTANTIATION):
            return
        begin, end = self.span(cursor)
        if any(begin < high and low < end and not (begin < low and high < end)
               for low, high in self.macros[self.file]):
            return
        children = self.children(cursor)
        if kind in (k.FUNCTION_DECL, k.CXX_METHOD, k.FUNCTION_TEMPLATE, k.CONSTRUCTOR, k.DESTRUCTOR,
                    k.CONVERSION_FUNCTION):
            names, result = names + [cursor.spelling], cursor.result_type
            self.definition = begin
            owner = cursor.semantic_parent
            if owner and owner.kind in (k.CLASS_DECL, k.STRUCT_DECL, k.CLASS_TEMPLATE) and (
                    len(names) < 2 or names[-2] != owner.spelling):
                names = [owner.spelling, cursor.spelling]
        elif kind in (k.CLASS_DECL, k.STRUCT_DECL, k.CLASS_TEMPLATE):
            names = names + [cursor.spelling]
        elif kind in (k.VAR_DECL, k.PARM_DECL):
            before = [t for low, _, t in self.between(begin, cursor.location.offset)]
            if "constexpr" in before:
                return
            # What stands before the name belongs to the type, what is in brackets to its size.
            children = [c for c in children if self.span(c)[0] > cursor.location.offset and
                        self.token_before(self.span(c)[0]) != "["]
            if kind != k.VAR_DECL or not above:
                names = names + [cursor.spelling]
        elif kind == k.LAMBDA_EXPR:
            result = None
        elif kind == k.IF_STMT and [t for _, _, t in self.between(begin, end)][1:2] == ["constexpr"]:
            children = children[1:]
        elif kind == k.CASE_STMT:
            children = children[1:]
        elif kind == k.MEMBER_REF_EXPR:
            children = children[:1]
        self.mutate(cursor, children, names, result, above)
        for child in children:
            self.statement(child, cursor, children, names)
            self.visit(child, names, result, above + (kind,))

    def from_place(self, at):
        """The tokens of the file, and the first of them that begins at this place or later."""
        tokens = self.tokens[self.file]
        return tokens, bisect.bisect_left(tokens, (at,))

    def between(self, begin, end):
        tokens, i = self.from_place(begin)
        return list(itertools.takewhile(lambda t: t[1] <= end, itertools.islice(tokens, i, None)))

    def token_before(self, at):
        tokens, i = self.from_place(at)
        return next((t for _, high, t in reversed(tokens[:i][-2:]) if high <= at), "")

    def token_after(self, at):
        tokens, i = self.from_place(at)
        return tokens[i] if i < len(tokens) else (at, at, "")

    # --- mutants ---

    def add(self, names, kind, begin, end, edits):
        if not names:
            return  # a constant of a namespace
        text = " ".join(t for _, _, t in self.between(begin, end))
        key = (self.file, begin, end, kind)
        self.found.setdefault(key, ("::".join(names), text, edits, self.definition))

    def around(self, begin, end, before, after=")", replaced=()):
        edits = [Edit(begin, 0, before, begin, end, False), Edit(end, 0, after, begin, end, True)]
        return edits + [Edit(low, high - low, text, low, high, False)
                        for low, high, text in replaced]

    def mutate(self, cursor, children, names, result, above):
        k, kind = self.kinds, cursor.kind
        begin, end = self.span(cursor)
        if self.wide:
            self.wider(cursor, children, names, begin, end)
        after = self.token_after(end)[2]
        if kind in (k.BINARY_OPERATOR, k.COMPOUND_ASSIGNMENT_OPERATOR, k.CALL_EXPR) and len(
                children) >= 2:
            self.binary(children, names, begin, end)
        if kind in (k.UNARY_OPERATOR, k.CALL_EXPR) and children:
            low, high, sign = self.token_after(begin)
            if sign in ("!", "-") and high <= self.span(children[-1])[0] and self.span(
                    children[-1])[1] == end:
                call = {"!": "!" + CALL + "turned<@>(", "-": CALL + "negative<@>("}[sign]
                self.add(names, f"{sign} dropped", begin, end,
                         self.around(begin, end, call, ")", [(low, high, "")]))
        in_brackets = after == ">" and (not above or above[-1] != k.BINARY_OPERATOR)
        if kind == k.INTEGER_LITERAL and not in_brackets:
            for by in (1, -1):
                self.add(names, f"{by:+}", begin, end,
                         self.around(begin, end, f"{CALL}shifted<@, {by}>("))
        if kind == k.CXX_BOOL_LITERAL_EXPR and not in_brackets:
            self.add(names, "turned", begin, end, self.around(begin, end, CALL + "turned<@>("))
        if kind == k.CALL_EXPR:
            self.extreme(names, begin, end)
        if kind == k.RETURN_STMT and children and children[0].kind != k.CXX_BOOL_LITERAL_EXPR:
            types = [children[0].type.kind] + ([result.kind] if result else [])
            if self.ci.TypeKind.BOOL in types:
                low, high = self.span(children[0])
                self.add(names, "result turned", begin, end,
                         self.around(low, high, CALL + "turned<@>("))
        if kind in (k.BREAK_STMT, k.CONTINUE_STMT):
            loops = (k.FOR_STMT, k.WHILE_STMT, k.DO_STMT, k.CXX_FOR_RANGE_STMT)
            inner = next((x for x in reversed(above) if x in loops + (k.SWITCH_STMT,)), None)
            low, high, _ = self.token_after(end)
            if inner in loops:
                word = "break" if kind == k.CONTINUE_STMT else "continue"
                self.add(names, word, begin, end, self.around(
                    begin, high, f"{{ if ({CALL}on<@>()) {word}; ", " }"))

    def binary(self, children, names, begin, end):
        first, last = self.span(children[0]), self.span(children[-1])
        gap = [t for t in self.between(first[1], last[0])]
        if first[0] != begin or last[1] != end or len(gap) != 1 or gap[0][2] not in SWAPPED:
            return
        low, high, sign = gap[0]
        if sign in "*/" and any("glm::qua" in c.type.get_canonical().spelling for c in children):
            return  # quaternions have no quotient
        if sign in BINARY:
            edits = self.around(begin, end, f"{CALL}{BINARY[sign]}<@>(", ")", [(low, high, ",")])
        else:
            turned = CALL + "turned<@>("
            edits = self.around(begin, end, turned + turned, "))",
                                [(low, high, f") {sign} {turned}")])
        self.add(names, f"{sign} to {SWAPPED[sign]}", begin, end, edits)
        if self.wide and sign in "+-*/":
            for kept in ("first", "last"):
                self.add(names, f"{kept} of {sign}", begin, end, self.around(
                    begin, end, f"{CALL}{kept}_of_{BINARY[sign]}<@>(", ")", [(low, high, ",")]))

    # Faults of physics that no swapped operator is: another constant, the other of two, a choice that
    # is always made or never.
    def wider(self, cursor, children, names, begin, end):
        k, kind = self.kinds, cursor.kind
        if kind == k.FLOATING_LITERAL:
            for by in ("halved", "doubled"):
                self.add(names, by, begin, end, self.around(begin, end, f"{CALL}{by}<@>("))
        if kind == k.MEMBER_REF_EXPR and cursor.spelling in PAIRED and children:
            low, high = self.span(children[0])
            base = [t for _, _, t in self.between(low, high)]
            if len(base) == 1 and low == begin and high < end:
                other = f"({CALL}on<@>() ? {base[0]}.{PAIRED[cursor.spelling]} : "
                self.add(names, "the other", begin, end, self.around(begin, end, other))
        if kind == k.IF_STMT and children and children[0].kind not in (
                k.DECL_STMT, k.COMPOUND_STMT):
            low, high = self.span(children[0])
            if self.token_before(low) != "(":
                return
            for by in ("always", "never"):
                self.add(names, by, low, high, self.around(low, high, f"{CALL}{by}<@>("))

    def extreme(self, names, begin, end):
        head = self.between(begin, end)[:4]
        callee = "".join(t for _, _, t in head[:3])
        if callee not in EXTREMES or len(head) < 4 or head[3][2] not in "(<":
            return
        name, other = EXTREMES[callee]
        explicit = head[3][2] == "<"
        high = head[3][1] if explicit else head[2][1]
        text = f"{CALL}{name}<@" + (", " if explicit else ">")
        self.add(names, f"{callee} to {other}", begin, end,
                 [Edit(begin, high - begin, text, begin, high, False)])

    # An expression that stands as a statement, for what it does.
    def statement(self, child, parent, siblings, names):
        k = self.kinds
        if child.kind not in (k.BINARY_OPERATOR, k.COMPOUND_ASSIGNMENT_OPERATOR, k.UNARY_OPERATOR,
                              k.CALL_EXPR, k.UNEXPOSED_EXPR):
            return
        bodies = (k.FOR_STMT, k.WHILE_STMT, k.DO_STMT, k.CXX_FOR_RANGE_STMT)
        if parent.kind not in bodies + (k.COMPOUND_STMT, k.IF_STMT, k.CASE_STMT, k.DEFAULT_STMT):
            return
        if parent.kind in bodies and child != siblings[-1]:
            return
        begin, end = self.span(child)
        low, high, sign = self.token_after(end)
        if sign != ";" or self.token_before(begin) == "(":
            return
        self.add(names, "left out", begin, end,
                 self.around(begin, high, f"{{ if (!{CALL}on<@>()) ", " }"))

    def named(self):
        seen, mutants = collections.Counter(), []
        for (file, begin, end, kind), (function, text, edits, definition) in sorted(
                self.found.items(), key=lambda item: item[0]):
            path = Path(file)
            name = path.relative_to(ROOT).as_posix()
            place = (name, definition, function, kind, text)
            seen[place] += 1
            line = path.read_bytes()[:begin].count(b"\n") + 1
            mutants.append(Mutant(self.room, name, function, kind, text, seen[place], line, edits))
        return mutants


def key_of(mutant):
    again = f" #{mutant.occurrence}" if mutant.occurrence > 1 else ""
    return f"{mutant.function} | {mutant.kind} | {mutant.text}{again}"


def told(mutant):
    """The mutant for people: with its place of today."""
    return f"{key_of(mutant)}\n    {mutant.file}:{mutant.line}"


class Tree:
    """A copy of the sources with mutants in it, and its build."""

    def __init__(self, folder):
        self.folder, self.source, self.build = folder, folder / "tree", folder / "build"

    def write(self, mutants):
        self.source.mkdir(parents=True, exist_ok=True)
        for name in ("CMakeLists.txt", "shaders", "scenarios"):
            if not (self.source / name).exists():
                (self.source / name).symlink_to(ROOT / name)
        edits = collections.defaultdict(list)
        for number, mutant in mutants.items():
            for edit in mutant.edits:
                edits[mutant.file].append(edit._replace(text=edit.text.replace("@", str(number))))
        wanted = {}
        for top in ("src", "tests"):
            for path in (ROOT / top).rglob("*"):
                if path.is_file():
                    wanted[path.relative_to(ROOT).as_posix()] = path.read_bytes()
        for name, list_of_edits in edits.items():
            wanted[name] = b'#include "base/mutant.hpp"\n#line 1 "' + name.encode() + (
                b'"\n') + edited(wanted[name], list_of_edits)
        wanted["src/base/mutant.hpp"] = (HERE / "mutant.hpp").read_bytes()
        for room in {m.room for m in mutants.values()}:
            wanted[f"tests/{room}/mutants_reached.cpp"] = (HERE / "reached.cpp").read_bytes()
        for top in ("src", "tests"):
            for path in (self.source / top).rglob("*"):
                if path.is_file() and path.relative_to(self.source).as_posix() not in wanted:
                    path.unlink()
        for name, content in wanted.items():
            path = self.source / name
            if not path.exists() or path.read_bytes() != content:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)

    # The text of what went wrong, or nothing.
    def compile(self, targets, jobs):
        configure = ["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja",
                     "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_BUILD_TYPE=Release",
                     "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
                     "-DCMAKE_CXX_FLAGS=-w -Werror=vla -D_GLIBCXX_ASSERTIONS"]
        build = ["cmake", "--build", self.build, "-j", str(jobs), "--target",
                 *targets, "--", "-k", "0"]
        for command in (configure, build):
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, check=False)
            if done.returncode != 0:
                return done.stdout
        return None

    def program(self, room):
        return self.build / "tests" / f"tests_{room}"


def edited(content, edits):
    def order(edit):
        length = edit.end - edit.begin
        if edit.closes:
            return (edit.at, 0, length)
        return (edit.at, 2 if edit.removed else 1, -length)
    # At one place: what ends there, the inner first; what begins there, the outer first; what goes.
    # Two around the same are told apart by their number: opened in its order, closed in reverse.
    ordered = sorted(enumerate(edits), key=lambda item: (
        order(item[1]), -item[0] if item[1].closes else item[0]))
    parts, at = [], 0
    for _, edit in ordered:
        parts += [content[at:edit.at], edit.text.encode()]
        at = edit.at + edit.removed
    return b"".join(parts) + content[at:]


def not_compiled(log, mutants):
    """Of the mutants those that the compiler complains of."""
    by_place = collections.defaultdict(set)
    for number, mutant in mutants.items():
        by_place[mutant.file, mutant.line].add(number)

    def named(lines):
        found = re.findall(r"\bN = (\d+)|mutant::\w+<(\d+)", "\n".join(lines))
        return {int(a or b) for a, b in found} & mutants.keys()

    def placed(lines):
        found = re.findall(r"(src/(?:\w+/)+\w+\.[ch]pp):(\d+)", "\n".join(lines))
        return {number for file, line in found for number in by_place[file, int(line)]}

    wrong, before = set(), []
    for line in log.splitlines():
        if ": error: " in line:
            # The mutant is named, or is on the line, or is where a template was needed.
            wrong |= named([line]) or named(before[-6:]) or placed([line]) or placed(before)
            before = []
        elif re.search(r"required from|In instantiation|In substitution", line):
            before.append(line)
    return wrong


def chosen(mutants, size, seed):
    """Places at even distances, each with one of the ways to change it; the rest, as reserve."""
    draw = random.Random(seed)
    if size == 0:
        return mutants, []
    places = collections.defaultdict(list)
    for mutant in mutants:
        places[mutant.file, mutant.edits[0].begin, mutant.edits[0].end].append(mutant)
    one_of_each = [draw.choice(ways) for ways in places.values()]
    size = min(size, len(one_of_each))
    step = len(one_of_each) / size
    first = draw.random() * step
    taken = {int(first + i * step) for i in range(size)}
    rest = [m for i, m in enumerate(one_of_each) if i not in taken]
    draw.shuffle(rest)
    return [one_of_each[i] for i in sorted(taken)], rest


def built(tree, mutants, reserve, targets, jobs, verbose=False):
    """Builds the targets with these mutants. Those that do not compile go, others of their room's
    reserve come under their numbers; gives how many went."""
    dropped = 0
    while True:
        tree.write(mutants)
        log = tree.compile(targets, jobs)
        if log is None:
            return dropped
        wrong = not_compiled(log, mutants)
        if not wrong:
            stop(f"the mutated sources do not compile:\n{log[-6000:]}")
        for number in sorted(wrong):
            dropped += 1
            mutant = mutants.pop(number)
            if verbose:
                print(f"not valid: {key_of(mutant)}")
            if reserve[mutant.room]:
                mutants[number] = reserve[mutant.room].pop()


# --- running ---

def limits(seconds=None):
    """For a child: of memory, and of its processor's time, however busy that is."""
    memory = 3 << 30
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if seconds is not None:
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))


def run(program, number, tests, seconds, folder):
    """True if the program passes these tests in this time."""
    environment = dict(os.environ, LANTERN_MUTANT=str(number))
    command = [program, "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + ":".join(tests)]
    with subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, preexec_fn=lambda: limits(seconds),
                          start_new_session=True) as process:
        try:
            return process.wait(timeout=60 + 30 * seconds) == 0
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.wait()
            return False


def reach(program, folder):
    """For each test its seconds, and for each mutant the tests that reach it, the quickest first."""
    log = folder / "reached.txt"
    environment = dict(os.environ, LANTERN_MUTANT_LOG=str(log))
    done = subprocess.run([program, "--gtest_brief=1"], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                          preexec_fn=limits)
    if done.returncode != 0:
        stop(f"{program.name} fails without any mutant:\n{done.stdout[-3000:]}")
    seconds, by_mutant = {}, collections.defaultdict(list)
    for line in log.read_text().splitlines():
        name, time_taken, *numbers = line.split()
        seconds[name] = float(time_taken)
        for number in numbers:
            by_mutant[int(number)].append(name)
    for tests in by_mutant.values():
        tests.sort(key=lambda name: seconds[name])
    return seconds, by_mutant


def killed(program, number, tests, seconds, folder):
    """In three rounds: those of the first half second, those of the first five, all others."""
    at, total = 0, 0.0
    for budget in (0.5, 5.0, float("inf")):
        part, cost = [], 0.0
        while at < len(tests) and (total <= budget or not part):
            part.append(tests[at])
            cost += seconds[tests[at]]
            total += seconds[tests[at]]
            at += 1
        if part and not run(program, number, part, 2 + int(10 * cost), folder):
            return True
    return False


def read_equivalent(path):
    """What is known to be the same program: a line that names it, or with ... at its end all
    that begin so, then the reason, indented."""
    known, key = {}, None
    for line in path.read_text().splitlines() if path.exists() else []:
        if line.startswith(" ") and key:
            known[key] += " " + line.strip()
        elif line.strip() and not line.startswith("#"):
            key = line.strip()
            known[key] = ""
    return known


def reason_of(mutant, known):
    """The line of equivalent.txt that names the mutant, or nothing."""
    key = key_of(mutant)
    return next((line for line in known if line == key or (
        line.endswith("...") and key.startswith(line[:-3]))), None)


def add_options(parser, folder):
    """Those that each trial of mutants has; it is made in this folder of build/."""
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=60, help="mutants a room; 0: all there are")
    parser.add_argument("--least", type=float, default=90, help="percent that must be noticed")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / folder)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="", help="only mutants whose names have this in them")
    parser.add_argument("--list", action="store_true", help="print the mutants, and run nothing")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("rooms", nargs="*", default=list(ROOMS))
    add_options(parser, "mutants")
    parser.add_argument("--trust", action="store_true",
                        help="do not run what equivalent.txt has")
    parser.add_argument("--verbose", action="store_true", help="tell what does not compile")
    parser.add_argument("--check", action="store_true",
                        help="only see whether each line of equivalent.txt names one that is possible")
    parser.add_argument("--results", type=Path, help="a file for every mutant's fate")
    options = parser.parse_args()
    cindex = load_clang()
    began = time.monotonic()

    known = read_equivalent(HERE / "equivalent.txt")
    picked, reserve, names = [], {}, collections.Counter()
    for room in options.rooms:
        everything = Finder(cindex, room).run()
        names.update(reason_of(m, known) for m in everything)
        wanted = [m for m in everything if options.only in key_of(m)]
        taken, reserve[room] = chosen(wanted, options.size, options.seed)
        print(f"{room}: {len(everything)} possible mutants, {len(taken)} taken", flush=True)
        picked += taken
    stale = sorted(set(known) - set(names)) if set(ROOMS) <= set(options.rooms) else []
    for key in stale:
        print(f"equivalent.txt names what is not there: {key}")
    if options.check:
        print(f"equivalent.txt: {len(known)} lines, of which {len(stale)} name nothing")
        return 1 if stale else 0
    if options.list:
        for mutant in picked:
            print(told(mutant))
        return 0

    mutants = dict(enumerate(picked))
    tree = Tree(options.folder)
    dropped = built(tree, mutants, reserve, [f"tests_{room}" for room in options.rooms],
                    options.jobs, options.verbose)
    print(f"compiled in {time.monotonic() - began:.0f} s; {dropped} were not valid, and others "
          "taken in their place", flush=True)

    folder = options.folder / "run"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    tests = {room: reach(tree.program(room), folder) for room in options.rooms}
    results = options.results.open("w") if options.results else None

    def fate(number):
        room = mutants[number].room
        seconds, by_mutant = tests[room]
        reaching = by_mutant.get(number, [])
        start = time.monotonic()
        if options.trust and reason_of(mutants[number], known):
            return number, False, len(reaching), 0.0
        dead = bool(reaching) and killed(tree.program(room), number, reaching, seconds, folder)
        return number, dead, len(reaching), time.monotonic() - start

    survivors = []
    count = collections.defaultdict(collections.Counter)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for number, dead, reaching, took in pool.map(fate, sorted(mutants)):
            mutant = mutants[number]
            count[mutant.room]["mutants"] += 1
            reason = reason_of(mutant, known)
            same = reason is not None and not dead
            if reason is not None and dead and not reason.endswith("..."):
                print(f"killed, though equivalent.txt has it: {told(mutant)}")
            count[mutant.room]["killed" if dead else "same" if same else "alive"] += 1
            if not dead and not same:
                survivors.append((mutant, reaching))
            if results:
                results.write(json.dumps([key_of(mutant), mutant.line, dead, same, reaching,
                                          round(took, 2)]) + "\n")
                results.flush()

    for mutant, reaching in survivors:
        seen = f"{reaching} tests reach it" if reaching else "no test reaches it"
        print(f"survives: {told(mutant)}; {seen}")
    total = collections.Counter()
    print(f"{'room':10} {'mutants':>8} {'killed':>8} {'the same program':>18} {'survive':>8} "
          f"{'percent killed':>16}")
    for room in [*options.rooms, "all"]:
        c = count[room] if room != "all" else total
        total += c if room != "all" else collections.Counter()
        different = c["killed"] + c["alive"]
        percent = 100 * c["killed"] / different if different else 100
        print(f"{room:10} {c['mutants']:8} {c['killed']:8} {c['same']:18} {c['alive']:8} "
              f"{percent:16.1f}")
    print(f"{total['mutants']} mutants, {total['killed']} killed, {total['same']} the same program, "
          f"{total['alive']} survive: {percent:.1f} % of those that matter are found; "
          f"seed {options.seed}, {time.monotonic() - began:.0f} s")
    return 0 if percent >= options.least else 1


if __name__ == "__main__":
    sys.exit(main())
