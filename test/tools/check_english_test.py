"""tools/check_english must find a sentence that is too long, two on a line, a turn of phrase that is hard to read, and only such."""
import sys

import trees

LONG = 'One two three four five six seven eight nine ten ' * 3
CASES = [
    ('short sentences', {'README.md': '# A title. With two parts\n\nOne sentence.\nAnother one, with `code. Code` and 1.5 of it.\n'}, None),
    ('a long sentence', {'README.md': f'{LONG}and more.\n'}, 'README.md:1: 32 words'),
    ('a long sentence over three lines', {'docs/a.md': 'First.\n' + LONG.replace('ten ', 'ten\n') + 'and more.\n'}, 'docs/a.md:1: 32 words'),
    ('a list of parts', {'README.md': f'{LONG[:100]}: {LONG[:100]}; {LONG[:100]}.\n'}, None),
    ('a long cell', {'README.md': f'| a | {LONG}and more |\n'}, 'README.md:1: 32 words'),
    ('a heading within a paragraph', {'README.md': '**Heading.** One sentence.\n'}, None),
    ('two behind a heading', {'README.md': '**Heading.** First. Second.\n'}, 'README.md:1: a second sentence on the line'),
    ('two on a line', {'README.md': 'First. Second.\n'}, 'README.md:1: a second sentence on the line'),
    ('a journal', {'README.md': 'Shaw and Holmes, J. Sound Vib. 90 (1983), Fig. 2 of N. Hoffmann.\n'}, None),
    ('an item of a list', {'README.md': '1. First.\n2. Second.\n'}, None),
    ('a hard turn', {'README.md': 'We saw all but one.\n'}, 'README.md:1: "all but"'),
    ('code', {'README.md': f'```sh\n{LONG}and more. Two.\n```\n\n    {LONG}and more. Two.\n'}, None),
    ('a message', {'README.md': 'A.\n', 'apps/a.cpp': 'fail("there is none, or says so");\n'}, 'apps/a.cpp:1: message with "is none"'),
    ('a message over two literals', {'README.md': 'A.\n', 'src/a.cpp': f'fail("{LONG}"\n     "and more");\n'}, 'src/a.cpp:1: message of 32 words'),
    ('a message around a value', {'README.md': 'A.\n', 'src/a.cpp': f'fail("{LONG}" + f(x, y) + " and more");\n'}, 'src/a.cpp:1: message of 32 words'),
    ('two messages', {'README.md': 'A.\n', 'src/a.cpp': f'fail("{LONG}", "and more");\nfail("{LONG}");\n'}, None),
    ('a message that names nothing', {'README.md': 'A.\n', 'src/a.hpp': 'fail(name + ": it is wrong");\n'}, 'src/a.hpp:1: what is meant by "it"'),
    ('a message whose second part names nothing', {'README.md': 'A.\n', 'verify/a.cpp': 'fail("no end; that is wrong");\n'}, 'verify/a.cpp:1: what is meant by "that"'),
    ('an option of that name', {'README.md': 'A.\n', 'apps/a.cpp': 'add("--which", "the K-th that is met");\n'}, None),
    ('an example and a script', {'README.md': 'A.\n', 'apps/a.cpp': f'add("So:\\n  it {LONG} {LONG}\\n");\nR"({LONG} {LONG})";\n'}, None),
    ('a comment', {'README.md': 'A.\n', 'src/a.cpp': '// there is none\n'}, 'src/a.cpp:1: comment with "is none"'),
    ('a comment over two lines', {'README.md': 'A.\n', 'test/a.cpp': f'int a;  ///< {LONG}\n        ///< and more\n'}, 'test/a.cpp:1: comment of 32 words'),
    ('two comments', {'README.md': 'A.\n', 'src/a.cpp': f'/// {LONG}\nint a;  ///< {LONG}\n/// {LONG}\nint b;\n'}, None),
    ('a sentence that ends in a number', {'README.md': 'A.\n', 'src/a.cpp': f'/// {LONG[:99]} 12. {LONG}\n'}, None),
    ('a comment with a tag', {'README.md': 'A.\n', 'src/a.cpp': f'/// {LONG} @returns {LONG}\n'}, None),
    ('a formula in a comment', {'README.md': 'A.\n', 'src/a.cpp': f'///     {LONG} but for {LONG}\n'}, None),
    ('a comment that names nothing', {'README.md': 'A.\n', 'include/a.hpp': '/// Runs. It ends.\n'}, 'include/a.hpp:1: what is meant by "It"'),
    ('a comment that names what it is of', {'README.md': 'A.\n', 'include/a.hpp': '/// Which pixels are first.\n'}, None),
    ('no comment', {'README.md': 'A.\n', 'test/a.cpp': 'use("// but for", R"(\n// but for\n)");\n'}, None),
    ('no page', {'src/a.cpp': ''}, 'check_english: no page'),
]

sys.exit(trees.run(sys.argv[1], CASES))
