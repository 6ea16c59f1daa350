"""Adds up JUnit files: one line a file, then `N passed, N failed, N skipped`. Exit 1 on a failure.

usage: count_tests.py FOLDER
"""

import pathlib
import sys
import xml.etree.ElementTree as xml


def count(path):
    """(passed, failed, skipped) of all test cases in one JUnit file."""
    passed = failed = skipped = 0
    for case in xml.parse(path).iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is not None:
            skipped += 1
            reason = case.find("skipped").get("message") or ""
            print(f"    skipped: {case.get('name')} {reason}".rstrip())
        else:
            passed += 1
    return passed, failed, skipped


def main():
    total = [0, 0, 0]
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.xml")):
        counts = count(path)
        print(f"{path.stem:12} {counts[0]:5} passed {counts[1]:4} failed {counts[2]:4} skipped")
        total = [a + b for a, b in zip(total, counts)]
    print("{} passed, {} failed, {} skipped".format(*total))
    return 1 if total[1] or not total[0] else 0


if __name__ == "__main__":
    sys.exit(main())
