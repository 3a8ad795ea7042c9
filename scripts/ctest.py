#!/usr/bin/env python3
"""ctest.py JUNIT.xml - sums up a run of CTest: prints "PASSED FAILED SKIPPED". What did not run counts as failed,
except where the test itself said that it skips."""
import sys
import xml.etree.ElementTree


def outcome(case):
    status = case.get("status")
    skipped = case.find("skipped")
    said_so = skipped is not None and skipped.get("message", "").startswith("SKIP_")
    if status == "run":
        return "passed"
    return "skipped" if status == "disabled" or said_so else "failed"


outcomes = [outcome(c) for c in xml.etree.ElementTree.parse(sys.argv[1]).getroot().iter("testcase")]
print(*(outcomes.count(word) for word in ("passed", "failed", "skipped")))
