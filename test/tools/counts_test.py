"""tools/counts must read what ctest, pytest and node have left. A test that did not start has failed."""
import os
import sys
import tempfile

import scripts

CTEST = '''<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="(empty)" tests="6" failures="1" disabled="1" skipped="2">
  <testcase name="a" status="run"><system-out></system-out></testcase>
  <testcase name="b" status="run"/>
  <testcase name="c" status="fail"><failure message=""/></testcase>
  <testcase name="d" status="notrun"><skipped message="SKIP_RETURN_CODE=4"/></testcase>
  <testcase name="e" status="disabled"/>
  <testcase name="f" status="notrun"><skipped message="Unable to find executable"/></testcase>
</testsuite>
'''
PYTEST = '''<?xml version="1.0" encoding="utf-8"?>
<testsuites><testsuite name="pytest" errors="1" failures="1" skipped="1" tests="5">
  <testcase name="a"/><testcase name="b"/>
  <testcase name="c"><failure message="x">x</failure></testcase>
  <testcase name="d"><error message="x">x</error></testcase>
  <testcase name="e"><skipped message="x"/></testcase>
</testsuite></testsuites>
'''
NODE = '''\u2714 a view that may pass 7
\u2139 tests 3
\u2139 pass 2
\u2139 fail 1
\u2139 cancelled 0
\u2139 skipped 0
\u2139 todo 0
\x1b[34m\u2139 pass 4\x1b[39m
\x1b[34m\u2139 fail 0\x1b[39m
\x1b[34m\u2139 skipped 1\x1b[39m
explorer: 1 of 2 files failed
'''


def line(tool, files):
    with tempfile.TemporaryDirectory() as build:
        for name, text in files.items():
            os.makedirs(os.path.dirname(os.path.join(build, name)), exist_ok=True)
            with open(os.path.join(build, name), 'w', encoding='utf-8') as file:
                file.write(text)
        return tool.line(build)


def all_parts_are_counted(tool):
    files = {'ctest.xml': CTEST, 'python/tests.xml': PYTEST, 'web-test.log': NODE, 'rotation/ctest.xml': CTEST, 'rotation/slice': '7'}
    assert line(tool, files) == ('ctest 2 passed, 2 failed, 2 skipped; Python 2 passed, 2 failed, 1 skipped; '
                                 'web 6 passed, 1 failed, 1 skipped; slice 7: 2 passed, 2 failed, 2 skipped')


def what_has_left_nothing_was_not_run(tool):
    assert line(tool, {}) == 'ctest not run; Python not run; web not run; no slice was run'


def a_file_that_broke_off_does_not_count(tool):
    assert line(tool, {'ctest.xml': CTEST[:200], 'rotation/slice': 'all'}).startswith('ctest not run; ')


def a_page_that_does_not_build_has_no_tests(tool):
    assert 'web not run' in line(tool, {'web-test.log': 'error TS2304: Cannot find name\n'})


sys.exit(scripts.run([all_parts_are_counted, what_has_left_nothing_was_not_run, a_file_that_broke_off_does_not_count,
                      a_page_that_does_not_build_has_no_tests], scripts.load(sys.argv[1])))
