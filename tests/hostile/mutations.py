"""What a hostile file says: the scalars of a text file by their positions, and what each is replaced by."""

import re

NUMBERS = ["1e20", "-1e20", "1e-300", "-1e-300", "nan", "inf", "-0", "1e308", "", "9" * 30, '"text"', "[]", "0", "TIMES_1e6", "TIMES_1e-6", "NEGATED"]
PARSED = ["1e20", "-1e20", "1e-300", "0", "TIMES_1e6", "TIMES_1e-6", "NEGATED"]  # what a reader may take
STRINGS = ["\x1b[31mred", "\u009b31m", "\u202etxt", "two\nlines", "", "x" * 5000, "NUMBER"]
ESCAPED = {"\x1b[31mred": "\\u001b[31mred", "\u009b31m": "\\u009b31m", "\u202etxt": "\\u202etxt", "two\nlines": "two\\nlines"}

JSON_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?|true|false|null|[{}\[\],:]')
WORD = re.compile(r"[^\s,;=<>\"']+")


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def json_scalars(text):
    """(begin, end, kind, path) of every scalar and key; indices of arrays are * in the path."""
    stack, found, tokens = [], [], list(JSON_TOKEN.finditer(text))
    key = None
    for i, token in enumerate(tokens):
        word = token.group()
        if word in "{[":
            stack.append((word, key))
            key = "*" if word == "[" else None
        elif word in "}]":
            stack.pop()
            key = "*" if stack and stack[-1][0] == "[" else None
        elif word in ",:":
            continue
        else:
            path = ".".join([str(k) for _, k in stack if k] + [key or ""])
            if word[0] == '"' and i + 1 < len(tokens) and tokens[i + 1].group() == ":":
                key = word[1:-1]
                found.append((token.start(), token.end(), "string", path + key + " (key)"))
                continue
            kind = "string" if word[0] == '"' else "number" if is_number(word) else "word"
            found.append((token.start(), token.end(), kind, path))
            if stack and stack[-1][0] == "{":
                key = None
    return found


def table_scalars(text):
    """The same of lines of words: a path is the line's first word and the position in the line."""
    found, at = [], 0
    for line in text.split("\n"):
        words = list(WORD.finditer(line))
        first = words[0].group() if words and not is_number(words[0].group()) else "row"
        for k, word in enumerate(words):
            kind = "number" if is_number(word.group()) else "string"
            found.append((at + word.start(), at + word.end(), kind, f"{first} {k}"))
        at += len(line) + 1
    return found


def thinned(scalars, most):
    """Of the scalars of one path, at most `most`: the first, the last and those between."""
    by_path = {}
    for scalar in scalars:
        by_path.setdefault((scalar[2], scalar[3]), []).append(scalar)
    out = []
    for group in by_path.values():
        if len(group) <= most:
            out += group
        else:
            out += [group[k * (len(group) - 1) // max(most - 1, 1)] for k in range(most)]
    return out


def replaced(word, value):
    if value.startswith("TIMES_"):
        return repr(float(word) * float(value[6:]))
    return repr(-float(word)) if value == "NEGATED" else value


def mutations(text, is_json, most, all_values):
    """(what was done, a function that gives the text) for every scalar and every value, then for every column of a table as a whole. Without
    `all_values` only numbers that a reader may take, for the commands that read the same by the same function."""
    scalars = json_scalars(text) if is_json else table_scalars(text)
    # What a simulation and the settings of a result say of themselves is shown at most: one of a kind.
    scalars = [s for s in scalars if not re.search(r"extra\.simulation|(^|\.)config\.|\.problems", s[3]) or "hand.speed" in s[3]]
    if not all_values:
        scalars = [s for s in scalars if not s[3].endswith("(key)")]
    def put(begin, end, new):
        return lambda: text[:begin] + new + text[end:]

    for begin, end, kind, path in thinned(scalars, most):
        word = text[begin:end]
        if kind == "string":
            for value in STRINGS:
                new = "7" if value == "NUMBER" else ('"%s"' % ESCAPED.get(value, value) if is_json else value.replace("\n", " "))
                yield f"{path} = {value[:20]!r}", put(begin, end, new)
            if is_json:  # as they are, not escaped
                yield f"{path} = raw U+202E", put(begin, end, '"\u202eraw"')
        elif kind == "number":
            for value in NUMBERS if all_values else PARSED:
                yield f"{path} = {value[:20]}", put(begin, end, replaced(word, value))
        else:
            for value in ["7", '"text"', "null", "{}"]:
                yield f"{path} = {value}", put(begin, end, value)
    if is_json:
        return
    columns = {}
    for begin, end, kind, path in scalars:
        if kind == "number":
            columns.setdefault(path, []).append((begin, end))
    for path, cells in columns.items():
        if len(cells) < 3:
            continue
        for value in ["1e20", "1e12", "-1e20", "1e-300", "0", "nan", "1e308", "TIMES_1e6", "TIMES_1e-6", "NEGATED", ""]:
            yield f"column {path} = {value}", lambda cells=cells, value=value: with_column(text, cells, value)


def with_column(text, cells, value):
    pieces, at = [], 0
    for begin, end in cells:
        pieces += [text[at:begin], replaced(text[begin:end], value)]
        at = end
    return "".join(pieces) + text[at:]
