#!/usr/bin/env python3
"""commits.py ROOT [SINCE]: subjects of the commits after SINCE read `area: verb ...`, as CONTRIBUTING.md has it.

At most 60 characters; an area in front; then an imperative: a word in lower case, no article, and none that ends as `adds`,
`added` and `adding` do. Status 77 where the history does not reach back that far, as in a shallow clone, or is not there.
"""
import re
import subprocess
import sys

SINCE = "b0fb1ab" # subjects before it were written otherwise
# Stood in the history when this was first run.
EXCUSED = {"raster: rows of one sample a pixel have no kernel of own", "readme: the program writes the table of techniques",
           "frame, app: items, alpha modes, depth rule, min and max"}
MOST = 60
SKIPPED = 77
FORM = re.compile(r"[\w./+-]+(?:, [\w./+-]+)*: (\S+)( .+)?$")
ARTICLES = {"a", "an", "the", "no", "all", "each", "every", "its", "their", "this", "that", "these", "those"}
NOT_THIRD_PERSON = {"bias", "alias", "canvas", "focus"}
NOT_PAST = {"need", "embed", "feed", "seed", "speed", "shed", "heed", "weed", "proceed", "exceed", "succeed"}
NOT_PROGRESSIVE = {"bring", "ring", "string", "swing", "cling", "sing", "ping"}


def not_imperative(verb):
    """Why this is no imperative; None where nothing speaks against it."""
    if not re.fullmatch(r"[a-z][a-z-]*[a-z]", verb):
        return f"'{verb}' is no verb in lower case"
    if verb in ARTICLES:
        return f"it begins with '{verb}'"
    if verb.endswith("s") and not verb.endswith("ss") and verb not in NOT_THIRD_PERSON:
        return f"'{verb}' is no imperative"
    if verb.endswith("ed") and verb not in NOT_PAST or verb.endswith("ing") and verb not in NOT_PROGRESSIVE:
        return f"'{verb}' is no imperative"
    return None


def fault(subject):
    """What is wrong with a subject; None where it is sound."""
    if subject in EXCUSED:
        return None
    if len(subject) > MOST:
        return f"{len(subject)} characters; at most {MOST}"
    form = FORM.match(subject)
    if not form:
        return "the form is `area: verb ...`"
    if subject.endswith("."):
        return "a subject ends without a full stop"
    return not_imperative(form[1])


def git(root, *words):
    """What git says, or None where it fails or is not installed."""
    try:
        done = subprocess.run(["git", "-c", "safe.directory=*", "-C", root, *words], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return done.stdout if done.returncode == 0 else None


def main():
    root, since = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else SINCE
    if git(root, "merge-base", "--is-ancestor", since, "HEAD") is None:
        print(f"skipped: the history does not reach back to {since}")
        sys.exit(SKIPPED)
    subjects = git(root, "log", "--no-merges", "--format=%h %s", f"{since}..HEAD").splitlines()
    wrong = [(line, fault(line.partition(" ")[2])) for line in subjects]
    wrong = [f"{line}: {why}" for line, why in wrong if why]
    print("\n".join(wrong) or f"{len(subjects)} subjects after {since}")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
