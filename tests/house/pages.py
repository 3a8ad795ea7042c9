#!/usr/bin/env python3
"""pages.py ROOT: what the pages about the code name is there.

Every path in backticks exists, from the root, from src/ or from the page's own folder, or, a file's bare name, anywhere among
the sources; so does every target of a link. Every name in backticks (a type, a function, a constant) stands in the sources.
The lines of a block of code that names its file (```cpp PATH) stand in that file, in this order; `...` leaves some out. Every
term of TERMS, which newcomers search for, is found in src/ or has an entry in docs/GLOSSARY.md. CONTRIBUTING.md says of every
stage of ./test what it is for.
"""
import pathlib
import re
import sys

PAGES = ("docs/*.md", "src/README.md", "CONTRIBUTING.md")
NOT_READ = {"docs/REFERENCES.md", "docs/HARD-CASES.md"} # house.citations holds these
SOURCES = ("src", "platform", "tests", "bench", "scripts", "cmake")
SUFFIXES = {".h", ".cpp", ".py", ".sh", ".cmake", ".txt"}
ENDINGS = ("", ".h", ".cpp", "-inl.h")
GLOSSARY, CONTRIBUTING, STAGES = "docs/GLOSSARY.md", "CONTRIBUTING.md", "scripts/stages.sh"
TERMS = ("hierarchical", "Hi-Z", "occlusion", "occluded", "spatial order", "Morton", "binning", "frustum", "back-face", "rasteriser",
         "multisampling", "order-independent transparency", "transmittance", "PCSS", "receiver plane", "barycentric", "watertight",
         "manifold", "connected component", "union-find", "cache line", "branch misprediction", "temporal", "structure of arrays",
         "prefetch", "guard band", "visibility buffer", "edge function", "early depth test", "meshlet", "vertex cache", "fragment",
         "coverage mask", "tile bin", "micro-triangle", "quad", "G-buffer", "reconstruction filter", "tone mapping", "mip level")

FENCE = re.compile(r"^ *```.*?^ *```", re.M | re.S)
EXCERPT = re.compile(r"^ *```cpp (\S+)\n(.*?)^ *```", re.M | re.S)
TICKED = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
BRACES = re.compile(r"\{([^{}]*,[^{}]*)\}")
PATH = re.compile(r"[\w.{},*+-]+(?:/[\w.{},*+-]*)+|\w[\w-]*\.(?:h|cpp|py|sh|md|txt|cmake)")
NAME = re.compile(r"(?:\w+::)*(?=\w*[a-z])(?:[A-Z]\w*[a-z]\w*|k[A-Z]\w*|[a-z]\w*_|SIMD_\w+|SCANOUT_\w+|[a-z]\w*(?=\())[\w]*(?:::\w+)*(?:\(\))?")
ENTRY = re.compile(r"^- \*\*([^*]+)\*\*", re.M)


def spread(path):
    """{a,b}.cpp -> a.cpp, b.cpp"""
    braces = BRACES.search(path)
    if not braces:
        return [path]
    return [one for choice in braces[1].split(",") for one in spread(path[:braces.start()] + choice.strip() + path[braces.end():])]


def exists(root, page, path):
    """Does it name a file or a folder, an ending of the sources left out?"""
    for folder in (root, root / "src", page.parent):
        for ending in ENDINGS:
            if "*" in path:
                if any(folder.glob((path + ending).strip("/"))):
                    return True
            elif (folder / (path + ending)).exists():
                return True
    return "/" not in path and any(any((root / folder).rglob(path)) for folder in SOURCES)


def words_of_sources(root):
    files = [p for folder in SOURCES for p in (root / folder).rglob("*") if p.suffix in SUFFIXES or p.name == "CMakeLists.txt"]
    return {word for p in files if p.is_file() and p.parent.name != "house"
            for word in re.findall(r"\w+", p.read_text(errors="replace"))}


class Check:
    def __init__(self, root):
        self.root, self.words, self.found, self.named = root, words_of_sources(root), [], 0

    def path(self, page, text, path):
        self.named += 1
        for one in spread(path):
            if not exists(self.root, page, one):
                self.fault(page, text, f"there is no {one}")

    def fault(self, page, part, what):
        line = page.read_text().count("\n", 0, page.read_text().find(part)) + 1
        self.found.append(f"{page.relative_to(self.root)}:{line}: {what}")

    def ticked(self, page, text):
        """What stands in backticks: a path, a name, or neither."""
        if PATH.fullmatch(text) and not text.startswith("build/"):
            self.path(page, f"`{text}`", text)
        elif NAME.fullmatch(text):
            self.named += 1
            for word in re.findall(r"\w+", text):
                if word not in self.words:
                    self.fault(page, f"`{text}`", f"no source says {word}")

    def excerpt(self, page, path, code):
        """Lines of code that stand in the file, one after the other but for those that `...` leaves out, however indented."""
        source = self.root / path
        if not source.is_file():
            return self.fault(page, f"```cpp {path}", f"there is no {path}")
        self.named += 1
        lines, at, free = [line.strip() for line in source.read_text().splitlines()], 0, True
        for line in (line.strip() for line in code.splitlines()):
            if line == "...":
                free = True
                continue
            found = next((i for i in range(at, len(lines) if free else min(at + 1, len(lines))) if lines[i] == line), None)
            if found is None:
                return self.fault(page, f"```cpp {path}", f"{path} has no line '{line}' there")
            at, free = found + 1, False

    def page(self, page):
        for path, code in EXCERPT.findall(page.read_text()):
            self.excerpt(page, path, code)
        text = FENCE.sub(lambda fence: "\n" * fence[0].count("\n"), page.read_text())
        for ticked in TICKED.findall(text):
            self.ticked(page, ticked)
        for target in LINK.findall(text):
            self.path(page, f"]({target}", target)

    def terms(self):
        glossary = self.root / GLOSSARY
        entries = {one.strip().lower() for key in ENTRY.findall(glossary.read_text() if glossary.is_file() else "") for one in key.split(",")}
        sources = "\n".join(" ".join(re.sub(r"\n\s*//", " ", p.read_text()).split()).lower()
                            for p in (self.root / "src").rglob("*") if p.suffix in (".h", ".cpp"))
        for term in TERMS:
            if term.lower() not in entries and term.lower() not in sources:
                self.found.append(f"{GLOSSARY}: '{term}' has neither an entry nor a hit in src/")

    def stages(self):
        page, script = self.root / CONTRIBUTING, self.root / STAGES
        there = set(re.findall(r"^stage_(\w+)\(\)", script.read_text(), re.M)) if script.is_file() else set()
        table = re.search(r"^\| stage \|.*\n\|[-|]+\n((?:\|.*\n)+)", page.read_text(), re.M) if page.is_file() else None
        named = set(re.findall(r"`(\w+)`", " ".join(row.split("|")[1] for row in table[1].splitlines()))) if table else set()
        for stage in sorted(there ^ named):
            self.found.append(f"{CONTRIBUTING}: {'says nothing of' if stage in there else 'there is no'} stage '{stage}'")

    def run(self):
        pages = [p for pattern in PAGES for p in sorted(self.root.glob(pattern)) if str(p.relative_to(self.root)) not in NOT_READ]
        for page in pages:
            self.page(page)
        self.terms()
        self.stages()
        if self.named == 0:
            self.found.append("the pages name nothing: has their form changed?")
        return pages


def faults(root):
    check = Check(pathlib.Path(root).resolve())
    check.run()
    return check.found


def main():
    check = Check(pathlib.Path(sys.argv[1]).resolve())
    pages = check.run()
    print("\n".join(check.found) or f"{len(pages)} pages: {check.named} paths and names are there, {len(TERMS)} terms are found")
    sys.exit(bool(check.found))


if __name__ == "__main__":
    main()
