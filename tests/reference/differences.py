"""How two results of one command differ, to the bit; sentences, hashes of states and what was added are told apart."""
import csv
import json
import math
import re
import tomllib

# Keys, columns and values in words that are called otherwise now on purpose, as old: new. They are no differences.
RENAMED = {
    "courses": "rollouts",
    "course": "rollout",
    "parting": "onset",
    "goals yellow": "goals.yellow",
    "goals blue": "goals.blue",
}
# Files likewise.
RENAMED_FILES = {"courses.csv": "rollouts.csv"}
# Keys and columns that say which program ran, where and how it was called.
ORIGIN = {"program", "command_line", "command", "path", "recording", "results"}
# Hashes of states change with what a state is made of, though all that moves is the same.
HASHES = {"world_hash"}
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


class Differences:
    def __init__(self):
        self.compared = self.numbers = self.texts = 0
        self.first = self.first_text = ""
        self.added, self.hashes = set(), 0

    def differ(self, where, old, new):
        self.numbers += 1
        self.first = self.first or f"{where}: {old} is now {new}"

    def word(self, where, old, new):
        self.texts += 1
        self.first_text = self.first_text or f"{where}: \"{short(old)}\" is now \"{short(new)}\""

    def leaf(self, where, key, old, new):
        self.compared += 1
        if key in ORIGIN or same(old, new) or (isinstance(old, str) and RENAMED.get(old) == new):
            return
        if key in HASHES:
            self.hashes += 1
        elif same_but_for_words(old, new):
            self.word(where, old, new)
        else:
            self.differ(where, short(old), short(new))

    def tree(self, old, new, where="", key=""):
        if isinstance(old, dict) and isinstance(new, dict):
            renamed = {RENAMED.get(name, name): value for name, value in old.items()}
            self.added |= {f"{where}.{name}".strip(".") for name in new.keys() - renamed.keys() - ORIGIN}
            for name, value in renamed.items():
                if name in new:
                    self.tree(value, new[name], f"{where}.{name}".strip("."), name)
                elif name not in ORIGIN:
                    self.differ(f"{where}.{name}".strip("."), "there", "missing")
        elif isinstance(old, list) and isinstance(new, list):
            if len(old) != len(new):
                self.differ(where, f"{len(old)} elements", f"{len(new)}")
            for i, (a, b) in enumerate(zip(old, new)):
                self.tree(a, b, f"{where}[{i}]", key)
        else:
            self.leaf(where, key, old, new)

    def table(self, old, new):
        """Lists of rows, the first of them the names of columns."""
        names, others = [RENAMED.get(name, name) for name in old[0]], new[0]
        self.added |= {f"column {name}" for name in others if name not in names}
        for name in names:
            if name not in others:
                self.differ(f"column {name}", "there", "missing")
        if len(old) != len(new):
            self.differ("table", f"{len(old) - 1} rows", f"{len(new) - 1}")
        places = [(i, others.index(name), name) for i, name in enumerate(names) if name in others]
        for row, (a, b) in enumerate(zip(old[1:], new[1:]), 1):
            if a == b and names == others:
                self.compared += len(a)
                continue
            label = f"tick {cell(a, names.index('tick')):g}" if "tick" in names else f"row {row}"
            for i, j, name in places:
                self.leaf(f"{label}, {name}", name, cell(a, i), cell(b, j))


def cell(row, place):
    text = row[place] if place < len(row) else ""
    try:
        return float(text)
    except ValueError:
        return text


def same(a, b):
    numbers = [isinstance(value, (int, float)) and not isinstance(value, bool) for value in (a, b)]
    if all(numbers):
        return (a == b and math.copysign(1, a) == math.copysign(1, b)) or (a != a and b != b)
    return type(a) is type(b) and a == b


def same_but_for_words(a, b):
    """Whether two sentences say the same numbers. Shorter texts are names, of which another one is another result."""
    sentences = all(isinstance(text, str) and len(text.split()) > 3 for text in (a, b))
    return sentences and NUMBER.findall(a) == NUMBER.findall(b)


def short(value):
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def between(old_text, new_text, kind):
    """Of two files' texts; `kind` is how their names end."""
    found = Differences()
    if kind == "json":
        found.tree(json.loads(old_text), json.loads(new_text))
    elif kind == "net":
        found.tree(tomllib.loads(old_text), tomllib.loads(new_text))
    elif kind == "csv":
        found.table(*(list(csv.reader(text.splitlines())) for text in (old_text, new_text)))
    else:
        old, new = old_text.splitlines(), new_text.splitlines()
        found.compared = 1  # that nothing is said is something, too
        for line, (a, b) in enumerate(zip(old, new), 1):
            found.leaf(f"line {line}", "", a, b)
        if len(old) != len(new):
            found.word("text", f"{len(old)} lines", f"{len(new)}")
    return found
