#!/usr/bin/env python3
"""citations.py ROOT: what code, tests and pages cite stands in docs/REFERENCES.md or docs/HARD-CASES.md, and nothing else
stands there.

A citation has one form each:
    Blinn 1977                  a paper, a book, a standard: authors as the entry names them, year (and then a section)
    [Primer 9.4]                a textbook that is not in the repository: key and chapters
    HARD-CASES 33, R19, P7      entries of docs/HARD-CASES.md
Refused: a citation without an entry; an entry without a citation; an entry of a hard case without oracle, criterion or
tests; a test that does not exist; a page that does not exist; in what users see (strings of the program, README.md) a
textbook's key or a hard case; the card of a technique that names no paper.
"""
import pathlib
import re
import sys

FOLDERS = ("src", "platform", "tests", "bench", "cmake", "scripts", "docs", "models")
SUFFIXES = {".h", ".cpp", ".py", ".sh", ".cmake", ".md"}
TOP = ("CMakeLists.txt", "README.md", "CONTRIBUTING.md", "run", "test")
NOT_READ = re.compile(r"/data/|/seeds/|/citations(_test)?\.py$")
REFERENCES, HARD_CASES, SCENES = "docs/REFERENCES.md", "docs/HARD-CASES.md", "tests/effects/scenes.txt"

YEAR = r"(?:1[789]\d\d|20[0-4]\d)[a-z]?\b"
PAPER = re.compile(rf"[\w.'-]*[A-Z][\w.'-]*[^\S\n](?:et al\. )?{YEAR}|et al\. {YEAR}")
TITLED = re.compile(rf'"[A-Z][^"]* [^"]*"[,;]? {YEAR}')
OTHERWISE = re.compile(rf"([A-Z][\w-]+)(?:'s)?(?:,| \(|, \() ?({YEAR})")
BOOK = re.compile(r"(?<![\w\])])\[([A-Z][a-z]+[A-Za-z]*|[A-Z]'?)(?: (?:ch\.)?([\d., -]+))?\](?![(:\w])")
CASE_ID = r"[A-Z]?\d+(?:-[A-Z]?\d+)?"
CASES = re.compile(rf"HARD-CASES(?!\.md|[\\|])(?: ({CASE_ID}(?:, {CASE_ID})*))?")
PAGE = re.compile(r"(?<![\w*/])((?:docs/)?[A-Z][A-Z-]+\.md)\b")
OUTSIDE = re.compile(r"\b(DESIGN|TOPICS|PEERS|PROTOTYPE|SEEDS|HOUSE|STYLE) [A-Z]?\d")
ENTRY = re.compile(r"- \*\*([^*]+)\*\*")
TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+),\s*(\w+)", re.M)
CTEST = re.compile(r"add_test\(NAME ([\w.]+)")
CLI_TEST = re.compile(r"scanout_cli_test\((\w+)")
STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
FIELDS = ("Oracle:", "Passes:", "Tests:")


def joined(text):
    """Text whose comments run on from line to line, and whose strings do."""
    text = re.sub(r"\n[ \t]*(?://|#(?!include|define|if|endif))[ \t]*(?=\S)", " ", text)
    text = re.sub(r'"[ \t]*\n[ \t]*"', "", text)
    text = re.sub(r"find_package\([^)]*\)", "", text)
    return re.sub(r"[ \t]*\n[ \t]+(?=\S)", " ", text)


def files(root):
    """{path from the root: text}"""
    found = {}
    for path in sorted(p for folder in FOLDERS for p in (root / folder).rglob("*")) + [root / name for name in TOP]:
        name = str(path.relative_to(root))
        if path.is_file() and (path.suffix in SUFFIXES or path.name == "CMakeLists.txt" or name in (*TOP, SCENES)) and \
                not NOT_READ.search("/" + name):
            found[name] = path.read_text()
    return found


def entries(text):
    """{key: paragraph}"""
    found = {}
    for paragraph in re.split(r"\n\s*\n|\n(?=- \*\*)", text):
        key = ENTRY.match(paragraph)
        if key:
            found[key.group(1)] = " ".join(paragraph.split())
    return found


def spread(ids):
    """R1-R3, 7 -> R1 R2 R3 7"""
    for one in ids.split(", "):
        first, _, last = one.partition("-")
        letter = re.match(r"[A-Z]?", first).group()
        if last and not last.startswith(letter):
            yield one
            continue
        low, high = int(first[len(letter):]), int((last or first)[len(letter):])
        yield from (f"{letter}{n}" for n in range(low, high + 1))


def tests(texts):
    """Names of all tests: Suite.Name of GoogleTest, and those of tests/CMakeLists.txt."""
    found = set()
    for name, text in texts.items():
        if name.startswith("tests/") and name.endswith(".cpp"):
            found |= {f"{suite}.{case}" for suite, case in TEST.findall(text)}
    listing, scenes = texts.get("tests/CMakeLists.txt", ""), texts.get(SCENES, "")
    found |= {f"effects.{name}" for name in re.findall(r"^(\w+) *\|", scenes, re.M)}
    return found | set(CTEST.findall(listing)) | {f"cli.{name}" for name in CLI_TEST.findall(listing)}


class Check:
    def __init__(self, root):
        self.root, self.texts, self.found, self.cited = root, files(root), [], set()
        self.references = entries(self.texts.get(REFERENCES, ""))
        self.cases = entries(self.texts.get(HARD_CASES, ""))
        self.authors = {word for key in self.references for word in re.findall(r"[A-Z][\w-]+", key)}

    def fault(self, where, what):
        self.found.append(f"{where}: {what}")

    def papers(self, name, text):
        """The keys of the papers that the text cites; what looks like one and is none is a fault."""
        known = []
        for match in PAPER.finditer(text):
            before = text[:match.end()]
            key = max((k for k in self.references if before.endswith(k)), key=len, default=None)
            known.append(key) if key else self.fault(name, f"'{match.group()}' has no entry in {REFERENCES}")
        return known

    def books(self, name, text):
        for match in BOOK.finditer(text):
            if match.group(1) in self.references:
                yield match.group(1)
            elif match.group(2) or re.search("[a-z][A-Z]", match.group(1)):
                self.fault(name, f"{match.group()} has no entry in {REFERENCES}")

    def hard_cases(self, name, text):
        for match in CASES.finditer(text):
            if not match.group(1):
                self.fault(name, f"'{text[match.start():match.end() + 12]}' names no entry: write HARD-CASES 33, R19, P7")
                continue
            for case in spread(match.group(1)):
                if case in self.cases:
                    yield case
                else:
                    self.fault(name, f"HARD-CASES {case} has no entry in {HARD_CASES}")

    def read(self, name):
        text = joined(self.texts[name])
        if name != REFERENCES:
            self.cited |= {*self.papers(name, text), *self.books(name, text)}
            if name != HARD_CASES:
                self.cited |= {f"HARD-CASES {case}" for case in self.hard_cases(name, text)}
        for match in OUTSIDE.finditer(text):
            self.fault(name, f"'{match.group()}' is not in the repository")
        for match in OTHERWISE.finditer(text):
            if match.group(1) in self.authors:
                self.fault(name, f"'{match.group()}': write {match.group(1)} {match.group(2)}, as {REFERENCES} does")
        for match in TITLED.finditer(text):
            self.fault(name, f"'{text[max(0, match.start() - 30):match.end()]}': write author and year, the title stands in {REFERENCES}")
        for page in PAGE.findall(text):
            if not any((self.root / folder / page).is_file() for folder in (".", "docs", pathlib.Path(name).parent)):
                self.fault(name, f"there is no {page}")

    def shown_to_users(self, name, text):
        if CASES.search(text) or any(book.group(1) in self.references or book.group(2) for book in BOOK.finditer(text)):
            self.fault(name, f"users see '{text}': name papers alone")

    def strings(self, name):
        text = joined(self.texts[name])
        code = re.sub(r"//[^\n]*", "", re.sub(r"^[ \t]*//[^\n]*|(?<=[;,{})]) +//[^\n]*", "", self.texts[name], flags=re.M))
        for string in STRING.findall(joined(code)):
            self.shown_to_users(name, string)
        for card in re.findall(r'\.source = "([^"]*)"', text):
            if not self.papers(name, card):
                self.fault(name, f"the card's source '{card}' names no paper of {REFERENCES}")

    def catalogue(self):
        known = tests(self.texts)
        for case, text in self.cases.items():
            for field in FIELDS:
                if field not in text:
                    self.fault(HARD_CASES, f"{case} has no '{field}'")
            named = re.findall(r"`([\w.]+)`", text.partition("Tests:")[2])
            if not named:
                self.fault(HARD_CASES, f"{case} is held by no test")
            for test in named:
                if test not in known:
                    self.fault(HARD_CASES, f"{case}: there is no test {test}")

    def run(self):
        for page, held in ((REFERENCES, self.references), (HARD_CASES, self.cases)):
            if not held:
                self.fault(page, "has no entries")
        for name in self.texts:
            self.read(name)
            if name.startswith(("src/", "platform/")) and name.endswith((".cpp", ".h")):
                self.strings(name)
        for line in self.texts.get("README.md", "").splitlines():
            self.shown_to_users("README.md", line)
        self.catalogue()
        for key in sorted(set(self.references) - self.cited):
            self.fault(REFERENCES, f"nothing cites {key}")
        for case in self.cases:
            if f"HARD-CASES {case}" not in self.cited:
                self.fault(HARD_CASES, f"nothing cites {case}")
        return self.found


def faults(root):
    return Check(pathlib.Path(root)).run()


def main():
    found = faults(sys.argv[1])
    print("\n".join(found) or "every citation has its entry, every entry its citation")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
